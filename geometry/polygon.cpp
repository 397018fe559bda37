#include "geometry/polygon.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gramap {
namespace {

double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

}  // namespace

double signed_area(const Polygon& ring) {
  if (ring.size() < 3) return 0;
  double twice = 0;  // about the first point, so that large coordinates cost no digits
  for (std::size_t i = 1; i + 1 < ring.size(); ++i) twice += cross(ring[i] - ring[0], ring[i + 1] - ring[0]);
  return twice / 2;
}

Vec2 centroid(const Polygon& ring) {
  Vec2 mean = Vec2::Zero();
  for (const Vec2& point : ring) mean += point;
  if (!ring.empty()) mean /= static_cast<double>(ring.size());
  const double area = signed_area(ring);
  if (area == 0) return mean;
  Vec2 sum = Vec2::Zero();
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 a = ring[i] - mean, b = ring[(i + 1) % ring.size()] - mean;
    sum += (a + b) * cross(a, b);
  }
  return mean + sum / (6 * area);
}

bool contains(const Polygon& ring, const Vec2& point) {
  bool inside = false;
  for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
    const Vec2 &a = ring[i], &b = ring[j];
    if ((a.y() > point.y()) == (b.y() > point.y())) continue;
    if (point.x() < (b.x() - a.x()) * (point.y() - a.y()) / (b.y() - a.y()) + a.x()) inside = !inside;
  }
  return inside;
}

double distance_to_segment(const Vec2& point, const Vec2& a, const Vec2& b) {
  const Vec2 along = b - a;
  const double squared = along.squaredNorm();
  const double share = squared > 0 ? std::clamp((point - a).dot(along) / squared, 0.0, 1.0) : 0.0;
  return (a + share * along - point).norm();
}

double distance_to_border(const Polygon& ring, const Vec2& point) {
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < ring.size(); ++i)
    best = std::min(best, distance_to_segment(point, ring[i], ring[(i + 1) % ring.size()]));
  return best;
}

Polygon simplified(Polygon ring, double tolerance_m) {
  if (signed_area(ring) < 0) std::reverse(ring.begin(), ring.end());
  for (bool changed = true; changed && ring.size() > 2;) {
    changed = false;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vec2& before = ring[(i + ring.size() - 1) % ring.size()];
      const Vec2& after = ring[(i + 1) % ring.size()];
      if (distance_to_segment(ring[i], before, after) > tolerance_m) continue;
      ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(i));
      changed = true;
      break;
    }
  }
  return ring;
}

Polygon convex_hull(Polygon points) {
  std::sort(points.begin(), points.end(),
            [](const Vec2& a, const Vec2& b) { return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y()); });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  Polygon hull;
  for (int pass = 0; pass < 2; ++pass) {
    const std::size_t start = hull.size();
    for (const Vec2& point : points) {
      while (hull.size() >= start + 2 && cross(hull.back() - hull[hull.size() - 2], point - hull.back()) <= 0)
        hull.pop_back();
      hull.push_back(point);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

OrientedBox oriented_box(const Polygon& points) {
  const Polygon hull = convex_hull(points);
  OrientedBox best;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Vec2 edge = hull[(i + 1) % hull.size()] - hull[i];
    if (edge.norm() == 0) continue;
    const Vec2 u = edge.normalized(), v(-u.y(), u.x());
    double u0 = 1e300, u1 = -1e300, v0 = 1e300, v1 = -1e300;
    for (const Vec2& point : hull) {
      u0 = std::min(u0, u.dot(point)), u1 = std::max(u1, u.dot(point));
      v0 = std::min(v0, v.dot(point)), v1 = std::max(v1, v.dot(point));
    }
    const double area = (u1 - u0) * (v1 - v0);
    if (area >= least) continue;
    least = area;
    const bool along_u = u1 - u0 >= v1 - v0;
    // The corner is chosen so that axis and its left normal span the box.
    best.axis = along_u ? u : v;
    best.corner = along_u ? Vec2(u0 * u + v0 * v) : Vec2(u1 * u + v0 * v);
    best.length_m = along_u ? u1 - u0 : v1 - v0;
    best.breadth_m = along_u ? v1 - v0 : u1 - u0;
  }
  return best;
}

Polygon grown(const Polygon& ring, double distance_m) {
  Polygon result;
  const std::size_t size = ring.size();
  for (std::size_t i = 0; i < size; ++i) {
    const Vec2 before = (ring[i] - ring[(i + size - 1) % size]).normalized();
    const Vec2 after = (ring[(i + 1) % size] - ring[i]).normalized();
    const Vec2 sum = Vec2(before.y(), -before.x()) + Vec2(after.y(), -after.x());
    const double mitre = 2 / std::max(sum.squaredNorm(), 1e-12), most = 3 / std::max(sum.norm(), 1e-12);
    result.push_back(ring[i] + sum * distance_m * std::min(mitre, most));
  }
  return result;
}

}  // namespace gramap
