// Where the wall region is cut into single walls: across it, from every corner at which a wall starts or
// ends, to the face that lies opposite. Where a corner's wall angle is wide (a room's corner, seen from the
// wall), both its walls end there, and two cuts leave the junction between them.
#pragma once

#include <optional>
#include <vector>

#include "geometry/overlay.h"
#include "geometry/segment_grid.h"
#include "geometry/types.h"

namespace gramap {

/// The rings that bound the wall region, each with the side on which the wall lies.
class WallFaces {
 public:
  /// `wall_on_left`: by ring, whether the wall lies on the left of its edges.
  WallFaces(const std::vector<Polygon>& rings, std::vector<bool> wall_on_left, double thickest_wall_m);

  /// The cuts at the rings' corners.
  std::vector<Cut> corner_cuts() const;

  /// The cut straight across the wall from a point on a ring's edge; none when no face lies opposite.
  std::optional<Cut> across(const PointOnRing& from) const;

  /// The nearest point on a ring.
  PointOnRing nearest(int ring, const Vec2& point) const;

 private:
  struct Edge {
    int ring, edge;
    Vec2 a, b;  ///< with the wall on the left
  };
  std::optional<Cut> shoot(const PointOnRing& from, const Vec2& direction, bool snap) const;
  Vec2 into_wall(int ring, int edge) const;

  const std::vector<Polygon>& rings_;
  std::vector<bool> wall_on_left_;
  double reach_m_;
  SegmentGrid grid_;
  std::vector<Edge> edges_;
};

/// Makes cuts that end nearer to one another than this, on one edge, end in one point: two corners may aim at
/// the same place, and rounding keeps them apart by less than any triangle can bear.
void share_landings(std::vector<Cut>& cuts, double within_m);

}  // namespace gramap
