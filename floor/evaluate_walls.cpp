#include "floor/evaluate_walls.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/polygon.h"

namespace gramap {
namespace {

struct Segment {
  Vec2 a, b;
};

std::vector<Segment> segments(const std::vector<Polygon>& rings) {
  std::vector<Segment> all;
  for (const Polygon& ring : rings)
    for (std::size_t i = 0; i < ring.size(); ++i) all.push_back({ring[i], ring[(i + 1) % ring.size()]});
  return all;
}

}  // namespace

double WallDistances::share_within(double buffer_m) const {
  if (sorted_m.empty()) return 1;
  const auto end = std::upper_bound(sorted_m.begin(), sorted_m.end(), buffer_m + 1e-9);
  return static_cast<double>(end - sorted_m.begin()) / static_cast<double>(sorted_m.size());
}

double WallDistances::median_within(double buffer_m) const {
  const auto end = std::upper_bound(sorted_m.begin(), sorted_m.end(), buffer_m + 1e-9);
  const std::ptrdiff_t count = end - sorted_m.begin();
  return count == 0 ? 0 : sorted_m[static_cast<std::size_t>(count / 2)];
}

WallDistances wall_distances(const std::vector<Polygon>& walls, const std::vector<Polygon>& others,
                             double step_m) {
  constexpr double reach_m = 1.0;  // farther off is not measured, only counted
  const double least_cosine = std::cos(15 * 3.14159265358979 / 180);
  const std::vector<Segment> candidates = segments(others);
  WallDistances distances;
  for (const Segment& wall : segments(walls)) {
    const double length = (wall.b - wall.a).norm();
    if (length == 0) continue;
    const Vec2 along = (wall.b - wall.a) / length;
    std::vector<Segment> near;
    for (const Segment& other : candidates) {
      const double other_length = (other.b - other.a).norm();
      if (other_length == 0 || std::abs(along.dot(other.b - other.a)) < least_cosine * other_length) continue;
      const Vec2 middle = (wall.a + wall.b) / 2;
      if (distance_to_segment(middle, other.a, other.b) < length / 2 + reach_m) near.push_back(other);
    }
    const int samples = std::max(1, static_cast<int>(std::lround(length / step_m)));
    for (int i = 0; i < samples; ++i) {
      const Vec2 point = wall.a + (i + 0.5) / samples * (wall.b - wall.a);
      double nearest = std::numeric_limits<double>::infinity();
      for (const Segment& other : near)
        nearest = std::min(nearest, distance_to_segment(point, other.a, other.b));
      distances.sorted_m.push_back(nearest);
    }
  }
  std::sort(distances.sorted_m.begin(), distances.sorted_m.end());
  return distances;
}

}  // namespace gramap
