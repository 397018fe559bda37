// How well a room on the line explains what was observed: the likelihood terms of the fit, each a closed
// formula of one room's extent, so that the dynamic programme and an enumeration use the very same numbers.
//
// A room evidence (width m, centre c) that belongs to a room [a, b] of width w was read in one of these ways:
//   whole       N(m; w, s_w) N(c; (a+b)/2, s_c)
//   swapped     the same with the other dimension along the line, when it is not known which one does
//   start only  a spurious wall inside: the wall at a is right, the other one up to kMostCutOff_m
//               short: N(c-m/2; a, s) / kMostCutOff_m
//   end only    the same from b
//   missed wall the room and the next one were read as one: N(c-m/2; a, s) N(c+m/2; b of the next, s)
// or it belongs to no room: outlier share x a uniform density. Evidence is ordered by its centre (or as given
// when a centre is unknown); rooms explain it in that order; several may belong to one room, which is as
// rare as the share of duplicates says unless they carry one name. Beyond kGateSigmas a reading has density
// zero, which is what keeps the fit's cost linear.
#pragma once

#include <algorithm>
#include <vector>

#include "grammar/grid.h"
#include "grammar/rules.h"
#include "grammar/space.h"

namespace gramap {

inline constexpr double kGateSigmas = 6;

/// How much of a room a spurious wall may cut off, metres.
inline constexpr double kMostCutOff_m = 2;

/// A room's clear extent along the line.
struct Extent {
  double start_m = 0;
  double end_m = 0;
  double width_m() const { return end_m - start_m; }
  double centre_m() const { return 0.5 * (start_m + end_m); }
};

/// How an evidence was read.
enum class Reading { aside, whole, swapped, start_only, end_only, opens, closes };

/// A function of a number of cells that varies within a window only; made once, asked for every room tried.
struct WindowTable {
  int first = 0;
  std::vector<double> values;
  double before = 0;
  double after = 0;
  int last() const { return first + static_cast<int>(values.size()) - 1; }
  double at(int cell) const {
    if (cell < first) return before;
    const auto i = static_cast<std::size_t>(cell - first);
    return i < values.size() ? values[i] : after;
  }
};

/// A room evidence made ready: sorted, standard deviations widened by what the grid rounds off (a wall is
/// uniform within its cell: variance step^2/12 each).
struct PreparedEvidence {
  int original = 0;  ///< index into SpaceProblem::rooms
  double width_m = 0;
  double width_sd_m = 0;
  bool of_two_rooms = false;  ///< the only reading of it is a missed wall
  bool has_other = false;
  double other_m = 0;
  double other_sd_m = 0;
  bool has_centre = false;
  double centre_m = 0;
  double centre_sd_m = 0;
  double wall_sd_m = 0;             ///< of either wall as read: centre -+ width / 2
  std::vector<double> type_factor;  ///< by room type; last: background
  double type_even = 1;             ///< the factor of a type that nothing is known of
  double aside = 0;                 ///< weight of belonging to no room
  double whole_factor = 1;          ///< of being a room of its width, whatever the room
  double again = 1;                 ///< factor when the same room explains this and a later evidence
  double depth_factor = 1;          ///< density of `other` across the line
  double swapped_depth_factor = 0;  ///< density of `width` across the line
  int first_start = 0;              ///< cells at which a room may start that explains it
  int last_start = 0;
  WindowTable start_density;   ///< of its wall at the start, by the cell at which a room starts,
  WindowTable end_density;     ///< of the one at the end, by the cell at which the next room starts,
  WindowTable centre_density;  ///< of its centre, by the sum of these two cells (1 when it is not known),
  WindowTable width_density;   ///< of its width, by the cells that a room takes,
  WindowTable other_density;   ///< and of its other dimension, when that lies along the line

  double start_wall_m() const { return centre_m - 0.5 * width_m; }
  double end_wall_m() const { return centre_m + 0.5 * width_m; }
};

class Evidence {
 public:
  /// `whole_factor`: by scanned room, what its likelihood as a whole room is multiplied with
  /// (like_scanned.h); empty: nothing.
  Evidence(const RuleSet& rules, const SpaceProblem& problem, const FitOptions& options, const Grid& grid,
           const std::vector<double>& whole_factor = {});

  const std::vector<PreparedEvidence>& rooms() const { return rooms_; }
  const Grid& grid() const { return grid_; }

  /// Weight of one reading of evidence `e` by one room, without the type; zero beyond the gate.
  double reading(const PreparedEvidence& e, Reading how, const Extent& room) const;
  /// Weight of the evidence belonging to the room: whole, swapped, start only, end only together.
  double belongs(const PreparedEvidence& e, const Extent& room) const;
  /// The same for a room that starts at `cell` and takes first, first + stride, … cells, `count` of them.
  /// Returns whether any weight is above zero.
  bool belongs(const PreparedEvidence& e, int cell, int first, int stride, int count, double* weights) const;
  double type_factor(const PreparedEvidence& e, int type) const {
    return type < 0 ? e.type_factor.back() : e.type_factor[static_cast<std::size_t>(type)];
  }

  /// Likelihood of the doors seen in the hallway wall between two cells' edges (the room takes [first,
  /// last)), for a room of this type there.
  double doors(int type, int first_cell, int last_cell) const;
  /// The same for a room that starts at `cell` and takes first, first + stride, … cells, `count` of them.
  void doors(int type, int cell, int first, int stride, int count, double* likelihoods) const;
  bool has_doors() const { return !visible_.empty(); }

 private:
  /// What a door says of a room of one type: terms of the room's start (by its first cell) and of its end (by
  /// the next room's first cell).
  struct DoorTables {
    WindowTable starts_before;  ///< probability that the door lies wholly behind the room's start,
    WindowTable ends_after;     ///< and before its end
    WindowTable from_start;     ///< density of the place, of the places reckoned from the start
    WindowTable from_end;
    double width = 1;  ///< how much more likely a door of its width is than any other
    /// A room that ends behind this cell ends wholly behind the door, whatever its end.
    int settled() const { return std::max(ends_after.last(), from_end.last()); }
  };

  template <class Function>
  WindowTable tabulate(double least_m, double most_m, double before, double after, Function f) const;
  DoorTables door_tables(const DoorEvidence& door, const RoomType* type) const;

  const RuleSet& rules_;
  FitOptions options_;
  Grid grid_;
  double depth_m_ = 0;
  double width_range_m_ = 0;
  std::vector<PreparedEvidence> rooms_;
  std::vector<DoorEvidence> doors_;
  std::vector<std::vector<DoorTables>> door_tables_;  // [type (last: any)][door]
  std::vector<double> door_anywhere_;  // [cells that a room takes]: density of a door that may be anywhere
  std::vector<double> all_false_;      // [count]: density of so many doors seen where there are none
  std::vector<int> doors_before_;      // [cell]: doors whose centre lies before the cell's edge
  std::vector<double> visible_;  // [cell]: metres of visible hallway wall before the cell's edge; empty: none
};

}  // namespace gramap
