// An area with holes as pieces without: the hallway around a core, as indoor plans draw it, for everything
// that follows knows areas by one ring.
#pragma once

#include <vector>

#include "geometry/types.h"

namespace gramap {

/// Cuts the area from both ends of each hole, along the area's longer side, to the next ring: the pieces,
/// counter-clockwise, fill the area and have no holes. The holes lie inside of `outer`, apart from it and
/// from each other; all rings are simple.
std::vector<Polygon> cut_at_holes(const Polygon& outer, const std::vector<Polygon>& holes);

}  // namespace gramap
