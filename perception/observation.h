// What perception says of one room, and all that the rest of gramap gets to know of its scans.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "geometry/types.h"

namespace gramap {

/// A length with its standard deviation, both in metres.
struct Measured {
  double value_m = 0;
  double sigma_m = 0;
};

/// One straight piece of the room's outline, from corner `a` to corner `b` with the room on its left.
struct WallObservation {
  Vec2 a = Vec2::Zero();
  Vec2 b = Vec2::Zero();
  double sigma_m = 0;      ///< standard deviation of the wall's position across itself
  double seen_share = 0;   ///< share of the wall's length that points were measured on; 0: assumed, not seen
  double plane_rms_m = 0;  ///< root mean square distance of the wall's points from its plane
  int support = 0;         ///< points on the wall
};

struct OpeningObservation {
  std::string kind;    ///< "door" or "window"
  int wall = 0;        ///< index into RoomObservation::walls
  double start_m = 0;  ///< along the wall, from its corner `a`
  double width_m = 0;
  double sill_m = 0;      ///< above the floor
  double head_m = 0;      ///< above the floor
  double confidence = 0;  ///< share of the forest's votes, 0 to 1
};

struct FurnitureObservation {
  std::string type;  ///< "table", "chair" or "other"
  Polygon footprint;
  double bottom_m = 0;  ///< above the floor
  double top_m = 0;     ///< above the floor
  double confidence = 0;
};

/// Plan coordinates are in the frame that the poses are in: the building's or the room's own (the floor file
/// says which).
struct RoomObservation {
  std::string room;  ///< the scan folder's name
  Polygon outline;   ///< clear outline, wall face to wall face, counter-clockwise
  std::vector<WallObservation>
      walls;  ///< outline edge i runs from outline[i] to outline[i+1] and is walls[i]
  double floor_z_m = 0;
  double ceiling_z_m = 0;
  Measured height;
  Measured width;             ///< extent of the outline along `axis`
  Measured depth;             ///< extent across `axis`
  Vec2 axis = Vec2::UnitX();  ///< unit vector of the outline's main direction that `width` is measured along
  std::vector<OpeningObservation> openings;
  std::vector<FurnitureObservation> furniture;
  std::vector<Vec3> scanner_positions;  ///< one per scan
  std::size_t points = 0;               ///< points read, all scans together
  std::vector<std::string> remarks;     ///< what a user should know: a wall assumed, a scan set aside, …
};

/// Writes and reads the `room.json` of `gramap perceive`. Reading throws InputError with the place of the
/// fault.
std::string to_json(const RoomObservation& observation);
RoomObservation observation_from_json(const std::string& text, const std::filesystem::path& name);

}  // namespace gramap
