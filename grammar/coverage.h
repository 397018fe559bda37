// What type of room lies where: marginals over all layouts.
#pragma once

#include <vector>

#include "grammar/inference.h"

namespace gramap {

/// For every room of the path (element by element, in the order of Element::rooms): the posterior probability
/// that the room which covers its centre, in whatever layout, has its type. A room covers the wall after it,
/// too, and a room of a unit only its own stretch of the depth.
std::vector<double> type_coverage(const Lattice& lattice, const NodeTable& forward, const NodeTable& backward,
                                  const std::vector<double>& posteriors, const std::vector<PathStep>& path);

}  // namespace gramap
