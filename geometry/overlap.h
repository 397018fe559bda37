// Area that two simple polygons share, for judging how well one thing in the plan matches another.
#pragma once

#include "geometry/types.h"

namespace gramap {

/// Area in m² of the intersection of two simple polygons of any orientation. Exact up to rounding: between
/// the heights of all corners and crossings the shared width is linear, so every slab counts with its middle.
double shared_area(const Polygon& a, const Polygon& b);

/// Intersection over union of the two areas, 0 to 1.
double intersection_over_union(const Polygon& a, const Polygon& b);

}  // namespace gramap
