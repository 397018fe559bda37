// Simple polygons in the plan: area, orientation, containment. Floating point; what must be exact is in
// partition.h.
#pragma once

#include "geometry/types.h"

namespace gramap {

/// Signed area in m² by the sum of cross products: positive when counter-clockwise.
double signed_area(const Polygon& ring);

/// Centre of gravity of the enclosed area; the mean of the points when the area is zero.
Vec2 centroid(const Polygon& ring);

/// True when `point` lies inside (even-odd rule). On the border either answer may come.
bool contains(const Polygon& ring, const Vec2& point);

/// Distance in metres from a point to a segment.
double distance_to_segment(const Vec2& point, const Vec2& a, const Vec2& b);

/// Distance in metres from a point to the ring's border.
double distance_to_border(const Polygon& ring, const Vec2& point);

/// The ring counter-clockwise, without repeated points and without points on a straight line within
/// `tolerance_m`.
Polygon simplified(Polygon ring, double tolerance_m = 1e-9);

/// The smaller-area box around the points, as origin corner, unit axis of its longer side, length and
/// breadth.
struct OrientedBox {
  Vec2 corner = Vec2::Zero();
  Vec2 axis = Vec2::UnitX();
  double length_m = 0;
  double breadth_m = 0;
};
OrientedBox oriented_box(const Polygon& points);

/// The counter-clockwise ring with every edge moved outward by `distance_m` (inward when negative), corners
/// mitred, sharp ones cut off at three times the distance. Nothing looks after edges that vanish or meet
/// others.
Polygon grown(const Polygon& ring, double distance_m);

/// Convex hull, counter-clockwise (Andrew's monotone chain).
Polygon convex_hull(Polygon points);

}  // namespace gramap
