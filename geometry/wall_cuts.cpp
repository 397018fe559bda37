#include "geometry/wall_cuts.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace gramap {
namespace {

/// Corners that bend less than this go on as one wall.
constexpr double kBend_rad = 0.5;
/// A cut that lands this near a corner ends in the corner: no slivers.
constexpr double kSnap_m = 0.005;
/// The same for openings, which stay where they are but for rounding.
constexpr double kTouch_m = 1e-4;

double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

Vec2 left_of(const Vec2& direction) {
  return {-direction.y(), direction.x()};
}

}  // namespace

WallFaces::WallFaces(const std::vector<Polygon>& rings, std::vector<bool> wall_on_left,
                     double thickest_wall_m)
    : rings_(rings), wall_on_left_(std::move(wall_on_left)), reach_m_(thickest_wall_m) {
  for (int ring = 0; ring < static_cast<int>(rings_.size()); ++ring)
    for (int i = 0; i < static_cast<int>(rings_[ring].size()); ++i) {
      Vec2 a = rings_[ring][i], b = rings_[ring][(i + 1) % rings_[ring].size()];
      if (!wall_on_left_[ring]) std::swap(a, b);
      edges_.push_back({ring, i, a, b});
      grid_.add(a, b);
    }
}

Vec2 WallFaces::into_wall(int ring, int edge) const {
  const Vec2 direction = (rings_[ring][(edge + 1) % rings_[ring].size()] - rings_[ring][edge]).normalized();
  return wall_on_left_[ring] ? left_of(direction) : Vec2(-left_of(direction));
}

std::vector<Cut> WallFaces::corner_cuts() const {
  std::vector<Cut> cuts;
  for (int ring = 0; ring < static_cast<int>(rings_.size()); ++ring) {
    const int size = static_cast<int>(rings_[ring].size());
    for (int corner = 0; corner < size; ++corner) {
      const Vec2 before = into_wall(ring, (corner + size - 1) % size), after = into_wall(ring, corner);
      double turn = std::atan2(cross(before, after), before.dot(after));
      if (!wall_on_left_[ring]) turn = -turn;
      if (turn > -kBend_rad) continue;  // the wall goes on straight, or folds around the corner from outside
      const PointOnRing from{ring, corner, 0, rings_[ring][corner]};
      for (const Vec2& direction : {before, after})
        if (auto cut = shoot(from, direction, true)) cuts.push_back(*cut);
    }
  }
  return cuts;
}

std::optional<Cut> WallFaces::across(const PointOnRing& from) const {
  return shoot(from, into_wall(from.ring, from.edge), false);
}

std::optional<Cut> WallFaces::shoot(const PointOnRing& from, const Vec2& direction, bool snap) const {
  double nearest = reach_m_;
  const Edge* hit = nullptr;
  double hit_t = 0;
  for (const int index : grid_.near(from.at, from.at + direction * reach_m_, 1e-6)) {
    const Edge& edge = edges_[index];
    if (edge.a == from.at || edge.b == from.at || (edge.ring == from.ring && edge.edge == from.edge))
      continue;
    const Vec2 along = edge.b - edge.a;
    const double facing = cross(direction, along);
    if (std::abs(facing) < 1e-9 * along.norm()) continue;  // parallel to the ray
    const double distance = cross(edge.a - from.at, along) / facing;
    const double t = cross(edge.a - from.at, direction) / facing;
    const double slack = 1e-7 / along.norm();
    if (distance < 1e-6 || distance >= nearest - 1e-9 || t < -slack || t > 1 + slack) continue;
    nearest = distance;
    hit = &edge;
    hit_t = std::clamp(t, 0.0, 1.0);
  }
  if (hit == nullptr) return std::nullopt;
  const Vec2 along = hit->b - hit->a;
  if (direction.dot(left_of(along)) >= 0) return std::nullopt;  // hit from behind: not across a wall
  const double near_m = snap ? kSnap_m : kTouch_m;
  if (hit_t * along.norm() < near_m) hit_t = 0;
  if ((1 - hit_t) * along.norm() < near_m) hit_t = 1;
  PointOnRing to{hit->ring, hit->edge, wall_on_left_[hit->ring] ? hit_t : 1 - hit_t,
                 from.at + direction * nearest};
  // Along an axis the landing point is exact when it takes the edge's own coordinate.
  for (int axis = 0; axis < 2; ++axis)
    if (hit->a[axis] == hit->b[axis]) to.at[axis] = hit->a[axis];
  if (hit_t == 0) to.at = hit->a;
  if (hit_t == 1) to.at = hit->b;
  return Cut{from, to};
}

void share_landings(std::vector<Cut>& cuts, double within_m) {
  std::vector<PointOnRing*> points;
  for (Cut& cut : cuts) points.insert(points.end(), {&cut.from, &cut.to});
  std::stable_sort(points.begin(), points.end(), [](const PointOnRing* a, const PointOnRing* b) {
    return std::tie(a->ring, a->edge, a->t) < std::tie(b->ring, b->edge, b->t);
  });
  for (std::size_t i = 1; i < points.size(); ++i) {
    const PointOnRing& last = *points[i - 1];
    PointOnRing& point = *points[i];
    if (last.ring == point.ring && last.edge == point.edge && (last.at - point.at).norm() < within_m)
      point = last;
  }
}

PointOnRing WallFaces::nearest(int ring, const Vec2& point) const {
  PointOnRing best;
  double least = 1e300;
  const Polygon& points = rings_[ring];
  for (int i = 0; i < static_cast<int>(points.size()); ++i) {
    const Vec2 a = points[i], along = points[(i + 1) % points.size()] - a;
    const double t = std::clamp((point - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
    const Vec2 at = a + along * t;
    if ((at - point).norm() < least) least = (at - point).norm(), best = {ring, i, t, at};
  }
  for (int axis = 0; axis < 2; ++axis) {
    const Vec2 &a = points[best.edge], &b = points[(best.edge + 1) % points.size()];
    if (a[axis] == b[axis]) best.at[axis] = a[axis];
  }
  return best;
}

}  // namespace gramap
