#include "floor/cut_holes.h"

#include <algorithm>
#include <cmath>

#include "geometry/overlay.h"
#include "geometry/partition.h"
#include "geometry/polygon.h"

namespace gramap {
namespace {

double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Nearer than this to a corner, a cut ends in it: no slivers.
constexpr double kSnap_m = 1e-3;

/// From the ring's farthest corner along `heading`, the leftmost of several, straight on to the next ring.
/// So the cuts between two holes side by side, one from either, are apart or the same.
Cut straight_on(const std::vector<Polygon>& rings, int ring, const Vec2& heading) {
  const Polygon& own = rings[static_cast<std::size_t>(ring)];
  const auto farthest = std::max_element(own.begin(), own.end(), [&](const Vec2& a, const Vec2& b) {
    const double ahead = heading.dot(b - a);
    return std::abs(ahead) > kSnap_m ? ahead > 0 : cross(heading, b - a) > 0;
  });
  Cut cut;
  cut.from = {ring, static_cast<int>(farthest - own.begin()), 0, *farthest};
  double nearest = 1e300;
  for (std::size_t r = 0; r < rings.size(); ++r) {
    if (static_cast<int>(r) == ring) continue;
    for (std::size_t i = 0; i < rings[r].size(); ++i) {
      const Vec2 &a = rings[r][i], edge = rings[r][(i + 1) % rings[r].size()] - a;
      const double across = cross(heading, edge);
      if (std::abs(across) < 1e-6 * edge.norm()) continue;  // the cut ends at its neighbour's corner
      const double distance = cross(a - *farthest, edge) / across, t = cross(a - *farthest, heading) / across;
      const double snap = kSnap_m / edge.norm();
      if (distance <= 0 || distance >= nearest || t < -snap || t > 1 + snap) continue;
      nearest = distance;
      const double end = t < snap ? 0 : t > 1 - snap ? 1 : t;
      cut.to = {static_cast<int>(r), static_cast<int>(i), end, a + end * edge};
    }
  }
  return cut;
}

}  // namespace

std::vector<Polygon> cut_at_holes(const Polygon& outer, const std::vector<Polygon>& holes) {
  std::vector<Polygon> rings{simplified(outer)};
  for (const Polygon& hole : holes) rings.push_back(simplified(hole));
  std::vector<Cut> cuts;
  const Vec2 axis = oriented_box(outer).axis;
  for (int hole = 1; hole < static_cast<int>(rings.size()); ++hole)
    for (const Vec2& heading : {axis, Vec2(-axis)}) cuts.push_back(straight_on(rings, hole, heading));
  // Every ring now hangs on two others, so each cell is bounded by one ring.
  const Overlay cells = overlay(rings, cuts);
  std::vector<Polygon> pieces;
  for (const Overlay::Cell& cell : cells.cells)
    if (cell.rings == std::vector<int>{0})
      for (Polygon& ring : border(cells.points, cell.triangles))
        pieces.push_back(simplified(std::move(ring)));
  return pieces;
}

}  // namespace gramap
