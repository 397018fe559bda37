#include "floor/facade.h"

#include <algorithm>
#include <cmath>

#include "geometry/polygon.h"

namespace gramap {
namespace {

constexpr double kStep_m = 1;  // a façade is asked for at every metre of a wall
constexpr double kRoom_m = 1;  // no room is less deep

}  // namespace

bool faces_outside(const FloorGroundTruth& floor, double behind_m, const Vec2& a, const Vec2& b) {
  if (floor.outline.empty()) return true;
  const Vec2 along = (b - a).normalized(), outward(along.y(), -along.x());
  const Vec2 beyond = (a + b) / 2 + outward * behind_m;
  return !contains(floor.outline, beyond) ||
         std::any_of(floor.courtyards.begin(), floor.courtyards.end(),
                     [&](const Polygon& court) { return contains(court, beyond); });
}

bool has_facade(const FloorGroundTruth& floor, double outer_wall_m, const Space& space) {
  const double behind_m = std::max(kRoom_m, 1.5 * outer_wall_m);
  const Vec2 forward = (space.end - space.start).normalized();
  for (std::size_t i = 0; i < space.outline.size(); ++i) {
    const Vec2& a = space.outline[i];
    const Vec2 edge = space.outline[(i + 1) % space.outline.size()] - a;
    if (edge.norm() <= 0 || edge.normalized().dot(forward) > -0.9) continue;
    const int pieces = std::max(1, static_cast<int>(std::lround(edge.norm() / kStep_m)));
    for (int n = 0; n < pieces; ++n)
      if (faces_outside(floor, behind_m, a + edge * n / pieces, a + edge * (n + 1) / pieces)) return true;
  }
  return false;
}

}  // namespace gramap
