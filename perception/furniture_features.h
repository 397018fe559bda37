// What a box in the plan looks like, in the numbers that the furniture's forest judges by.
#pragma once

#include <vector>

#include "perception/furniture_cells.h"
#include "perception/furniture_surfaces.h"

namespace gramap {

/// A rectangle in the frame of a direction: extents along it and to its left, metres.
struct AxisBox {
  double u0 = 0, u1 = 0, v0 = 0, v1 = 0;
  double area() const { return (u1 - u0) * (v1 - v0); }
};

Polygon ring_of(const AxisBox& extent, const Vec2& axis);

/// The features of a surface's part: `points` are the part's, `extent` its box along `axis`;
/// `whole`: they are all of the surface.
std::vector<float> furniture_features(const FurnitureCells& cells, const FurnitureSurface& surface,
                                      const std::vector<Vec2>& points, const AxisBox& extent,
                                      const Vec2& axis, bool whole);

}  // namespace gramap
