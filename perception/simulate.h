// Scans of a building whose truth is known, as a person walking through it with a hand-held depth sensor
// would take them. Feeds training, tests, examples, and anyone who wants to try a grammar without a phone.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <string>
#include <vector>

#include "geometry/types.h"

namespace gramap {

/// A door or window on a wall face of a room; heights above the room's floor, metres.
struct BuildingOpening {
  std::string kind;  ///< "door" or "window"
  Vec2 a = Vec2::Zero();
  Vec2 b = Vec2::Zero();
  double sill_m = 0;
  double head_m = 0;
};

/// Types with a shape of their own, besides "table" and "chair".
inline constexpr const char* kSofa = "sofa";
inline constexpr const char* kShelf = "shelf";      ///< open to the front
inline constexpr const char* kClutter = "clutter";  ///< what lies on furniture
inline constexpr const char* kStairs = "stairs";

/// A piece of furniture; heights above the room's floor, metres. A "table" is simulated as a top on legs, a
/// "chair" as a seat on legs (with a back when it is taller than 0.6 m), a sofa by its seat, back and arms, a
/// shelf by its boards; anything else as a closed body. Sofas and shelves have their back at the outline's
/// first edge, stairs rise along the outline's longer side to a landing.
struct BuildingFurniture {
  std::string type;
  Polygon outline;
  double bottom_m = 0;
  double top_m = 0;
  bool closed = false;  ///< a table or chair with panels down to the floor

  /// Not what lies on furniture, and no part of the building.
  bool counts() const { return type != kClutter && type != kStairs; }
};

struct BuildingRoom {
  std::string id;
  Polygon outline;  ///< clear outline, counter-clockwise
  double floor_m = 0;
  double ceiling_m = 0;
  std::vector<BuildingOpening> openings;
  std::vector<BuildingFurniture> furniture;
};

struct Building {
  std::vector<BuildingRoom> rooms;
};

/// What the sensor, the person and the day are like. Lengths in metres, angles in degrees (they are options
/// of the command), shares from 0 to 1.
struct SimulateOptions {
  std::uint64_t seed = 1;

  // The walk.
  int points_per_room = 60000;    ///< measured, all positions of a room together
  int positions = 0;              ///< sensor positions in a room; 0: by its area, 4 to 12
  double eye_height_m = 1.4;      ///< of the sensor over the floor
  double eye_height_sd_m = 0.15;  ///< from position to position

  // The sensor.
  double fov_horizontal_deg = 360;  ///< the person turns around with the sensor; less: only part of a turn
  double fov_vertical_deg = 115;
  double range_m = 5;
  double noise_m = 0.004;              ///< standard deviation of a distance at 0 m …
  double noise_growth_per_m = 0.0022;  ///< … plus this times distance² (1/m)
  double stray_share = 0.002;          ///< points that are nowhere near a surface
  double registration_sd_m = 0.008;    ///< error of a scan's position in its pose, each axis
  double registration_sd_deg = 0.2;    ///< error of a scan's heading in its pose
  double drift_sd_m = 0.10;            ///< rigid error of a whole room's poses, each plan axis
  double drift_sd_deg = 0.5;           ///< rigid error of a whole room's heading

  // The day.
  double doors_closed_share = 0;
  double doors_ajar_share = 0;  ///< leaf somewhere between 20° and 80°
  double window_frame_m = 0;    ///< width of the frame around the pane; 0: no frame
  double blinds_share = 0;      ///< windows with a blind let down by 20 to 60 % of their height
  double opposite_share = 0;    ///< windows with something in sight behind, 1.5 to 5 m off: a façade, a tree
  double outer_wall_m = 0.3;    ///< depth of the reveal of openings with no room behind

  /// true: the poses are in a frame of the room's own, origin at the first position, heading unknown.
  bool room_frame = false;
};

struct SimulatedScan {
  std::vector<Vec3> points;  ///< in the scanner's frame
  Eigen::Isometry3d frame_from_scanner =
      Eigen::Isometry3d::Identity();  ///< as the pose says: with its errors
};

struct SimulatedRoom {
  std::vector<SimulatedScan> scans;
  Eigen::Isometry3d frame_from_building =
      Eigen::Isometry3d::Identity();  ///< the drift, or the room's own frame
  Vec2 mean_position = Vec2::Zero();  ///< of the sensor, in the building's frame, without any error
};

/// Scans the named rooms (indices into the building's), many at a time. Deterministic for a seed, with any
/// number of threads; a room's scans do not depend on which others are scanned. Throws InputError when a room
/// is too small to stand in.
std::vector<SimulatedRoom> simulate_rooms(const Building& building, const std::vector<std::size_t>& rooms,
                                          const SimulateOptions& options);

/// The bytes of a `.xyz` file: a point a line with `decimals` digits.
std::string xyz_text(const std::vector<Vec3>& points, int decimals);

}  // namespace gramap
