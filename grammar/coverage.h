// What type of room lies where: marginals over all layouts.
#pragma once

#include <map>
#include <span>
#include <vector>

#include "grammar/inference.h"

namespace gramap {

/// Rooms of one type and one stretch of the depth (from the hallway wall; extent < 0: the whole depth).
struct CoverageChannel {
  int type = 0;
  double depth_start_m = 0;
  double depth_m = -1;
  auto operator<=>(const CoverageChannel&) const = default;
};

/// Posterior probability that a cell is covered by a room of the channel, in whatever layout. A room covers
/// the wall after it, too.
using Coverage = std::map<CoverageChannel, std::vector<double>>;

/// Within what clear widths a room counts as the same, metres: plus or minus.
inline constexpr double kSameWidth_m = 0.10;

/// A room whose like is looked for: of its channel, covering its middle cell, with its gross width.
struct SameRoom {
  CoverageChannel channel;
  int middle = 0;
  int width = 0;           ///< in cells
  double probability = 0;  ///< that such a room is there
  /// Of the clear widths of whatever rooms cover the middle, about this one's: square root of the mean
  /// square.
  double width_deviation_m = 0;
};

/// A wall of which it is asked how well its place is known: the cell where an element begins.
struct SameWall {
  int cell = 0;
  /// Root mean square distance to the nearest wall, over all layouts.
  double deviation_m = 0;
};

/// The rooms of a path, element by element, in the order of Element::rooms.
std::vector<SameRoom> rooms_of(const Lattice& lattice, const std::vector<PathStep>& path);

/// The walls between the elements of a path, in order.
std::vector<SameWall> walls_of(const std::vector<PathStep>& path);

/// Also fills in the probabilities and deviations of `rooms` and the deviations of `walls` (in order).
Coverage cover(const Lattice& lattice, const NodeTable& forward, const NodeTable& backward,
               const std::vector<double>& posteriors, std::span<SameRoom> rooms = {},
               std::span<SameWall> walls = {});

/// For every room of the path (element by element, in the order of Element::rooms): the posterior probability
/// that the room which covers its centre has its type; inside a unit, at its place across the space.
std::vector<double> type_probabilities(const Lattice& lattice, const Coverage& coverage,
                                       const std::vector<PathStep>& path);

}  // namespace gramap
