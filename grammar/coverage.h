// What type of room lies where: marginals over all layouts.
#pragma once

#include <map>
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

Coverage cover(const Lattice& lattice, const NodeTable& forward, const NodeTable& backward,
               const std::vector<double>& posteriors);

/// For every room of the path (element by element, in the order of Element::rooms): the posterior probability
/// that the room which covers its centre has its type; inside a unit, at its place across the space.
std::vector<double> type_probabilities(const Lattice& lattice, const Coverage& coverage,
                                       const std::vector<PathStep>& path);

}  // namespace gramap
