// One space as plain numbers: what was observed along its reference line, and the layout that explains it
// best. All positions are metres along the reference line from its start; the space's clear length is from
// wall face to wall face.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "grammar/rules.h"

namespace gramap {

/// A room that somebody scanned.
struct RoomEvidence {
  std::string id;      ///< the scanned room's name
  double width_m = 0;  ///< clear width along the reference line
  double width_sigma_m = 0;
  std::optional<double>
      other_width_m;  ///< set when it is not known which dimension lies along the line: the other one
  double other_sigma_m = 0;
  std::optional<double>
      centre_m;  ///< position of the room's centre along the line; none: only the order is known
  double centre_sigma_m = 0;
  std::string type;  ///< type evidence: a room type's name, or empty
  double type_confidence = 0;
  bool of_two_rooms = false;  ///< a wall was missed for sure: no room by itself explains it
};

/// A door seen in the hallway's wall, from the hallway.
struct DoorEvidence {
  double centre_m = 0;
  double sigma_m = 0;
  double width_m = 0;
  double width_sigma_m = 0;  ///< 0: the width is not held against what the rules say of doors
};

/// A stretch of the hallway's wall on which every door would have been seen.
struct Stretch {
  double start_m = 0;
  double end_m = 0;
};

/// One space to be filled.
struct SpaceProblem {
  std::string id;
  double length_m = 0;
  double depth_m = 0;
  std::string hallway;
  bool facade = true;
  std::vector<RoomEvidence>
      rooms;  ///< in any order when positions are known, else in the order along the line
  std::vector<DoorEvidence> doors;
  std::vector<Stretch> doors_visible;
};

/// One room of a layout.
struct PlacedRoom {
  std::string type;  ///< the room type's name; "Unknown" for the background room
  double start_m = 0;
  double width_m = 0;
  /// Of the best layout's rooms: over all layouts, about this width and the nearest wall; of alternatives':
  /// within the sequence.
  double width_sigma_m = 0;
  double start_sigma_m = 0;  ///< standard deviation of the wall before the room
  double end_sigma_m = 0;    ///< and behind it
  double type_probability = 1;
  /// That a room of this type lies here and is as wide, to 10 cm; of the best layout's rooms only.
  double room_probability = 1;
  std::string rule;                    ///< the rule that placed it
  std::vector<std::string> rule_path;  ///< from the start symbol's rule down to `rule`
  std::vector<int> evidence;           ///< indices into SpaceProblem::rooms
  bool swapped = false;                ///< the evidence's other dimension lies along the line
  /// Position across the space, for units with nested splits: 0 at the hallway wall; depth < 0: the whole
  /// depth.
  double depth_start_m = 0;
  double depth_m = -1;
};

struct Layout {
  std::vector<PlacedRoom>
      rooms;  ///< from start to end; widths and the walls between them sum to the length exactly
  /// ln of the joint probability of this sequence of types and the evidence, over all its widths. Widths and
  /// positions are those of its most probable layout.
  double score = 0;
  double probability = 0;  ///< of this sequence of types among all, given the evidence
};

/// What became of a piece of evidence that no room explains.
struct SetAside {
  int evidence = 0;
  std::string reason;
};

/// How evidence was read that is not simply one room's width.
struct Reinterpreted {
  int evidence = 0;
  std::string how;  ///< a sentence for people
};

struct SpaceFit {
  Layout best;
  std::vector<Layout> alternatives;  ///< the next best distinct sequences, best first
  std::vector<SetAside> set_aside;
  std::vector<Reinterpreted> reinterpreted;
};

/// Scanned rooms of a floor that are about as wide as one another.
struct AlikeRooms {
  double width_m = 0;  ///< mean
  double sigma_m = 0;  ///< of one of them, as scanned
  int count = 0;
  std::string type;  ///< as in RoomEvidence
  double type_confidence = 0;
};

/// How alike the rooms of a space, and those of a floor, are expected to be (like_scanned.h).
struct Likeness {
  /// Standard deviation of the widths of rooms that are alike, as a share of them; 0: no room is expected to
  /// be like another.
  double deviation = 0;
  double rules_worth = 1;      ///< so many scanned rooms of the space are worth what is expected of any space
  double floor_deviation = 0;  ///< as `deviation`, of rooms of different spaces
  double floor_rules_worth = 1;      ///< so many scanned rooms of the floor are worth the rules
  std::vector<AlikeRooms> on_floor;  ///< in all spaces; none unless floor_deviation > 0
};

struct FitOptions {
  double grid_m = 0.01;         ///< step of the dynamic programme's positions
  double outlier_share = 0.02;  ///< ε: prior share of evidence that no room explains
  /// Prior share of evidence that belongs to a room which has other evidence, under another name.
  double duplicate_share = 0.01;
  double cut_off_share = 0.02;       ///< prior share of scans whose one wall is spurious, inside the room
  double missed_wall_share = 0.005;  ///< prior share of scans that read two rooms as one
  double doorless_share = 0.03;      ///< prior share of rooms without a door to the hallway
  double second_door_share = 0.05;   ///< prior share of rooms with two doors or more
  double false_door_share = 0.01;    ///< expected number of doors seen per space that are none
  Likeness likeness;
  int beam = 24;         ///< prefixes of layouts that are carried on from about the same place
  int alternatives = 0;  ///< how many distinct alternatives to report
  /// Instead of the most probable layout the one whose widths are expected to be least wrong
  /// (least_error.h); widths are means over all layouts of its sequence.
  bool least_error = false;
};

/// The most probable layout of the space. Throws InputError when no derivation fills the space, naming the
/// space, its length and the nearest length that can be filled.
SpaceFit fit_space(const RuleSet& rules, const SpaceProblem& problem, const FitOptions& options = {});

}  // namespace gramap
