#include "floor/reference_line.h"

#include <algorithm>
#include <cmath>

#include "geometry/polygon.h"

namespace gramap {
namespace {

Vec2 left_of(const Vec2& direction) {
  return Vec2(-direction.y(), direction.x());
}

}  // namespace

LineSide side_of(const Polygon& outline, const Vec2& start, const Vec2& end) {
  constexpr double tolerance_m = 0.05;
  constexpr int samples = 16;
  const Vec2 normal = left_of((end - start).normalized());
  int left = 0, right = 0;
  for (int i = 0; i <= samples; ++i) {
    const Vec2 point = start + (end - start) * i / samples;
    if (distance_to_border(outline, point) > tolerance_m) return LineSide::off_border;
    if (i == 0 || i == samples) continue;
    left += contains(outline, point + 2 * tolerance_m * normal);
    right += contains(outline, point - 2 * tolerance_m * normal);
  }
  return left >= right ? LineSide::left : LineSide::right;
}

double side_length(const Polygon& outline, const Vec2& start, const Vec2& end) {
  constexpr double tolerance_m = 0.05;
  const Vec2 along = (end - start).normalized(), normal = left_of(along);
  double first = 0, last = (end - start).norm();
  const auto on_line = [&](const Vec2& p) { return std::abs(normal.dot(p - start)) < tolerance_m; };
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2 &a = outline[i], &b = outline[(i + 1) % outline.size()];
    if (!on_line(a) || !on_line(b)) continue;
    first = std::min({first, along.dot(a - start), along.dot(b - start)});
    last = std::max({last, along.dot(a - start), along.dot(b - start)});
  }
  return last - first;
}

std::optional<std::pair<Vec2, Vec2>> edge_beside(const Polygon& outline, const Polygon& hallway,
                                                 double reach_m) {
  const double most_turn = std::sin(5 * 3.14159265358979 / 180);
  const Polygon ring = simplified(outline, 1e-3);  // so that an edge is not cut short by points on it
  std::optional<std::pair<Vec2, Vec2>> best;
  double longest = 0.1;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 &a = ring[i], &b = ring[(i + 1) % ring.size()];
    const double length = (b - a).norm();
    const Vec2 along = (b - a) / length, outward = -left_of(along);
    double overlap = 0;
    for (std::size_t k = 0; k < hallway.size(); ++k) {
      const Vec2 c = hallway[k] - a, d = hallway[(k + 1) % hallway.size()] - a;
      const Vec2 other = (d - c).normalized();
      // The hallway's border runs the other way round: its area, too, is on its left.
      if (other.dot(along) > 0 || std::abs(outward.dot(other)) > most_turn) continue;
      const double gap = outward.dot((c + d) / 2);
      if (gap < -0.05 || gap > reach_m) continue;
      overlap += std::max(0.0, std::min(along.dot(c), length) - std::max(along.dot(d), 0.0));
    }
    if (overlap <= longest) continue;
    longest = overlap;
    best = {a, b};
  }
  return best;
}

}  // namespace gramap
