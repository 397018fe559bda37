// The fitted floor: every room with its place, its widths and where they come from. Plan coordinates are the
// floor file's.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "floor/ground_truth.h"
#include "geometry/types.h"
#include "grammar/rules.h"

namespace gramap {

enum class Origin { observed, derived, given };
const char* to_string(Origin origin);

/// A door or window in a wall of a room, as a stretch of the room's clear outline.
struct FittedOpening {
  std::string kind;  ///< "door" or "window"
  Origin origin = Origin::derived;
  Vec2 a = Vec2::Zero();  ///< on the room's wall face
  Vec2 b = Vec2::Zero();
  double sill_m = 0;  ///< above the floor
  double head_m = 0;
  double confidence = 1;
};

struct FittedFurniture {
  std::string type;
  Origin origin = Origin::derived;
  Polygon outline;
  double bottom_m = 0;  ///< above the floor
  double top_m = 0;
  double confidence = 1;
};

struct FittedRoom {
  std::string id;  ///< unique on the floor
  std::string name;
  std::string type;
  Origin origin = Origin::derived;
  Polygon outline;     ///< clear outline, counter-clockwise
  std::string space;   ///< the space it belongs to; empty for hallways and fixed rooms
  double start_m = 0;  ///< along the space's reference line
  double width_m = 0;
  double width_sigma_m = 0;
  double start_sigma_m = 0;
  double end_sigma_m = 0;
  double depth_m = 0;
  double height_m = 0;
  std::optional<double> extracted_width_m;  ///< what the scan said, before the grammar
  std::optional<double> extracted_sigma_m;
  double type_probability = 1;
  double room_probability = 1;  ///< of a room of this type and, to 10 cm, this width in this place
  std::string rule;
  std::vector<std::string> rule_path;  ///< the rules from the start symbol down to `rule`
  std::vector<std::string> scans;      ///< the scan folders it was observed in
  std::vector<FittedOpening> openings;
  std::vector<FittedFurniture> furniture;
};

struct FittedSpace {
  std::string id;
  double length_m = 0;
  double score = 0;
  double probability = 0;
  /// The next best layouts, for people: types and widths in order.
  struct Alternative {
    double score = 0;
    double probability = 0;
    std::vector<std::string> types;
    std::vector<double> widths_m;
  };
  std::vector<Alternative> alternatives;
};

struct FittedFloor {
  FloorGroundTruth floor;  ///< what was given
  double inner_wall_m = 0;
  double outer_wall_m = 0;
  double height_m = 0;               ///< clear storey height
  double likeness = 0;               ///< of rooms of one space (Likeness::deviation), as fitted
  std::vector<FittedRoom> rooms;     ///< spaces in file order, rooms from start to end
  std::vector<FittedRoom> hallways;  ///< origin `given`
  std::vector<FittedRoom> fixed;     ///< origin `given`
  std::vector<FittedSpace> spaces;
  std::vector<SetAsideInput> set_aside;
};

}  // namespace gramap
