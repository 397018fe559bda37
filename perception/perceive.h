// From one room's scans to what they say of the room.
#pragma once

#include <functional>
#include <string>

#include "perception/furniture.h"
#include "perception/hough.h"
#include "perception/observation.h"
#include "perception/openings.h"
#include "perception/outline.h"
#include "perception/wall_lines.h"

namespace gramap {

struct Perception;

struct PerceptionOptions {
  HoughOptions hough;
  WallOptions walls;
  OutlineOptions outline;
  OpeningOptions openings;
  FurnitureOptions furniture;
  bool find_openings = true;
  bool find_furniture = true;
  /// Called after each stage with its name and seconds; may be empty.
  std::function<void(const std::string& stage, double seconds)> on_stage;
  /// Called with what the stages found, also when they found no room, and by `perceive` again with openings
  /// and furniture; may be empty.
  std::function<void(const Perception& found)> on_found;
};

/// What the stages found, each in the registered cloud's frame (relative to cloud.origin_m).
struct Perception {
  RegisteredCloud cloud;
  std::vector<PlanePatch> planes;
  Storey storey;
  std::vector<WallLine> walls;
  FreeSpace free;
  RoomOutline outline;
  RoomObservation observation;  ///< in the poses' frame
};

/// Planes, floor and ceiling, walls, outline and measures of the room; openings and furniture are found
/// afterwards from these. Throws InputError when the scans hold no room, saying what was found.
Perception perceive_structure(RegisteredCloud cloud, const std::string& room,
                              const PerceptionOptions& options = {});

/// The whole of perception: the structure, then doors and windows, then furniture, by the forests that ship.
Perception perceive(RegisteredCloud cloud, const std::string& room, const PerceptionOptions& options = {});
RoomObservation perceive_room(const RoomScans& scans, const PerceptionOptions& options = {});

/// The frame of a perceived wall: origin at corner `a` on the floor, x along the wall to `b`, y up, z into
/// the room.
struct WallFrame {
  Eigen::Isometry3d room_from_wall = Eigen::Isometry3d::Identity();
  double length_m = 0, height_m = 0;
};
WallFrame wall_frame(const RoomObservation& observation, std::size_t wall);

}  // namespace gramap
