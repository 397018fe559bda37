#include "floor/ring_check.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>

#include "geometry/polygon.h"

namespace gramap {
namespace {

constexpr double kSame = 1e-6;

double turn(const Vec2& a, const Vec2& b, const Vec2& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

bool meet(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  if ((turn(a, b, c) > 0) != (turn(a, b, d) > 0) && (turn(c, d, a) > 0) != (turn(c, d, b) > 0)) return true;
  return distance_to_segment(a, c, d) < kSame || distance_to_segment(b, c, d) < kSame ||
         distance_to_segment(c, a, b) < kSame || distance_to_segment(d, a, b) < kSame;
}

std::string place(const Vec2& point) {
  char text[64];
  std::snprintf(text, sizeof text, "(%.3f, %.3f)", point.x(), point.y());
  return text;
}

}  // namespace

Polygon without_repeats(const Polygon& ring) {
  Polygon kept;
  for (const Vec2& point : ring)
    if (kept.empty() || (point - kept.back()).norm() > kSame) kept.push_back(point);
  while (kept.size() > 1 && (kept.front() - kept.back()).norm() <= kSame) kept.pop_back();
  return kept;
}

std::optional<std::string> ring_fault(const Polygon& ring) {
  const std::size_t n = ring.size();
  const auto next = [n](std::size_t i) { return (i + 1) % n; };
  const auto left = [&](std::size_t i) { return std::min(ring[i].x(), ring[next(i)].x()); };
  const auto right = [&](std::size_t i) { return std::max(ring[i].x(), ring[next(i)].x()); };
  for (std::size_t i = 0; i < n; ++i) {  // an edge that runs back along the one before
    const Vec2 &a = ring[i], &b = ring[next(i)], &c = ring[next(next(i))];
    if ((b - a).dot(c - b) < 0 &&
        (distance_to_segment(c, a, b) < kSame || distance_to_segment(a, b, c) < kSame))
      return "its outline runs back on itself at " + place(b);
  }
  std::vector<std::size_t> order(n), open;
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t i, std::size_t j) { return left(i) != left(j) ? left(i) < left(j) : i < j; });
  for (const std::size_t i : order) {
    std::erase_if(open, [&](std::size_t j) { return right(j) < left(i) - kSame; });
    for (const std::size_t j : open) {
      if (next(i) == j || next(j) == i) continue;
      if (meet(ring[i], ring[next(i)], ring[j], ring[next(j)]))
        return "its outline crosses or touches itself: the edge from " + place(ring[j]) + " to " +
               place(ring[next(j)]) + " meets the edge from " + place(ring[i]) + " to " +
               place(ring[next(i)]);
    }
    open.push_back(i);
  }
  return std::nullopt;
}

}  // namespace gramap
