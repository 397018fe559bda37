#include "geometry/overlap.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "geometry/polygon.h"

namespace gramap {
namespace {

/// Where the horizontal at `y` is inside the ring: alternating entries and exits, ascending.
std::vector<double> crossings(const Polygon& ring, double y) {
  std::vector<double> xs;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 &a = ring[i], &b = ring[(i + 1) % ring.size()];
    if ((a.y() > y) == (b.y() > y)) continue;
    xs.push_back(a.x() + (b.x() - a.x()) * (y - a.y()) / (b.y() - a.y()));
  }
  std::sort(xs.begin(), xs.end());
  return xs;
}

double shared_length(const std::vector<double>& a, const std::vector<double>& b) {
  double length = 0;
  for (std::size_t i = 0; i + 1 < a.size(); i += 2)
    for (std::size_t j = 0; j + 1 < b.size(); j += 2)
      length += std::max(0.0, std::min(a[i + 1], b[j + 1]) - std::max(a[i], b[j]));
  return length;
}

}  // namespace

double shared_area(const Polygon& a, const Polygon& b) {
  if (a.size() < 3 || b.size() < 3) return 0;
  std::vector<double> heights;
  for (const Vec2& point : a) heights.push_back(point.y());
  for (const Vec2& point : b) heights.push_back(point.y());
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) {
      const Vec2 &p = a[i], &q = b[j];
      const Vec2 r = a[(i + 1) % a.size()] - p, s = b[(j + 1) % b.size()] - q;
      const double turn = r.x() * s.y() - r.y() * s.x();
      if (turn == 0) continue;
      const Vec2 d = q - p;
      const double t = (d.x() * s.y() - d.y() * s.x()) / turn, u = (d.x() * r.y() - d.y() * r.x()) / turn;
      if (t >= 0 && t <= 1 && u >= 0 && u <= 1) heights.push_back(p.y() + t * r.y());
    }
  }
  std::sort(heights.begin(), heights.end());
  double area = 0;
  for (std::size_t i = 0; i + 1 < heights.size(); ++i) {
    const double height = heights[i + 1] - heights[i];
    if (height <= 0) continue;
    const double middle = heights[i] + height / 2;
    area += height * shared_length(crossings(a, middle), crossings(b, middle));
  }
  return area;
}

double intersection_over_union(const Polygon& a, const Polygon& b) {
  const double shared = shared_area(a, b);
  const double all = std::abs(signed_area(a)) + std::abs(signed_area(b)) - shared;
  return all > 0 ? shared / all : 0;
}

}  // namespace gramap
