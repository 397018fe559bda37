// Is a ring a simple polygon? Asked of every area in a floor file before anything is computed from it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geometry/types.h"

namespace gramap {

/// The ring without its closing point and without points that repeat the one before (to a micrometre).
Polygon without_repeats(const Polygon& ring);

/// Where the ring crosses or touches itself, as a sentence for people; nothing when it is simple. `ring` has
/// no repeated neighbours. Edges are swept along x, so rings of thousands of points are quick.
std::optional<std::string> ring_fault(const Polygon& ring);

/// What keeps a ring from being an area, as the end of a sentence about it: it encloses nothing, crosses or
/// touches itself. Nothing when it is a simple polygon. `ring` has no repeated neighbours.
std::optional<std::string> area_fault(const Polygon& ring);

/// What is wrong with the holes of a polygon, as a sentence for people; nothing when each lies inside of
/// `outer` and they touch neither it nor each other. All rings are simple.
std::optional<std::string> holes_fault(const Polygon& outer, const std::vector<Polygon>& holes);

}  // namespace gramap
