// Learning a rule file from rows of rooms that are known: the estimate that belongs to the meaning in
// rules.h.
//
// A row's rooms are sorted into classes: a type and one of its widths. Widths are grouped per type by
// description length (learn_width.h) and written in terms of the structural axis where that is shorter. A row
// is then a sequence of classes: the first one is made by a rule of the start symbol, every further one by a
// rule of the rest. Classes that stand only at an end become rules with the end as context; stretches that
// recur become units and repeats; neighbours that predict one another become `after` blocks; each only where
// it shortens the description of the data (learn_sequence.h). What was not seen keeps some probability: each
// type with widths of any number of axes, and a background room.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace gramap {

/// A door in a room's hallway wall, metres from the room's start along the reference line.
struct KnownDoor {
  double start_m = 0;
  double end_m = 0;
  double height_m = 0;
};

/// A window in a room's façade, the centre in metres along the reference line.
struct KnownWindow {
  double centre_m = 0;
  double width_m = 0;
  double sill_m = 0;
  double head_m = 0;
};

struct KnownRoom {
  std::string id;
  std::string type;  ///< may be empty, in a plan that has no types
  double width_m = 0;
  double depth_m = 0;
  std::vector<KnownDoor> doors;
  bool doors_known = false;  ///< no door in `doors` means that there is none
  std::vector<KnownWindow> windows;
  std::vector<std::string> furniture;
};

/// The rooms along one reference line, from its start to its end; between neighbours is an inner wall.
struct KnownRow {
  std::string floor;
  std::string space;
  std::string hallway;
  double length_m = 0;  ///< clear: widths and walls sum to it
  std::vector<KnownRoom> rooms;
  bool whole = true;  ///< false: a part of a space whose ends are no ends of the space
};

struct LearnData {
  std::vector<std::string> sources;  ///< for the comment at the head
  std::vector<KnownRow> rows;
  double inner_wall_m = 0.2;
  double outer_wall_m = 0.3;
  double height_m = 2.7;
};

struct LearnOptions {
  std::string name = "learned";  ///< of the grammar
  double resolution_m = 0.02;    ///< no spread is taken to be smaller: how exactly plans are drawn
  /// Rooms without a type: a type for each width. Otherwise they are one type in several widths, which fits
  /// better: the most probable sequence is then sought over all widths, not split among made-up types.
  bool types_by_width = false;
  bool uniform = false;  ///< all rules of a symbol alike, no `after`: a baseline for comparisons
};

/// One width of a type.
struct WidthClass {
  int type = 0;  ///< into LearnedRules::types
  double mean_m = 0;
  double sd_m = 0;
  int count = 0;
  int axes = 0;  ///< mean = axes * axis - inner wall + offset; 0: not written by the axis
  double offset_m = 0;
};

struct LearnedDoor {
  double width_m = 0;
  double height_m = 0;
  struct Place {
    double share = 1;
    double mean_m = 0;
    double sd_m = 0;
    bool from_end = false;
  };
  std::vector<Place> places;  ///< empty: anywhere
};

struct LearnedType {
  std::string name;
  int count = 0;
  std::vector<WidthClass> widths;  ///< what the room's `width` says, `count` as weight in thousandths
  double depth_mean_m = 0;
  double depth_sd_m = 0;
  std::optional<LearnedDoor> door;
  struct Windows {
    double width_m = 0, height_m = 0, sill_m = 0, spacing_m = 0;
  };
  std::optional<Windows> windows;
  std::vector<std::string> furniture;
};

struct LearnedRule {
  std::string name;
  bool first = false;        ///< rewrites the start symbol; else the rest
  bool last_only = false;    ///< has the end of the space as its right context and nothing behind it
  std::vector<int> classes;  ///< the pieces in order; empty: any room of `any_type`
  int any_type = -1;
  std::optional<WidthClass> other_width;  ///< with `any_type`: in a width that is none of the type's classes
  int least = 0, most = 0;                ///< > 0: `classes` repeated
  double count = 0;                       ///< uses in the data
  double probability = 0;
  std::vector<std::pair<int, double>> after;  ///< what follows, by rule index; empty: nothing special
};

struct LearnedRules {
  LearnData data;
  LearnOptions options;
  double axis_m = 0;  ///< 0: none found
  double axis_sd_m = 0;
  std::vector<LearnedType> types;
  std::vector<WidthClass> classes;
  std::vector<LearnedRule> rules;
  double background = 0;
  double least_width_m = 1;
  double most_width_m = 12;
};

/// Throws InputError when there is no row to learn from.
LearnedRules learn_rules(const LearnData& data, const LearnOptions& options = {});

/// The rule file, with comments that say the counts.
std::string to_text(const LearnedRules& rules);

}  // namespace gramap
