#include "floor/ring_check.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "geometry/polygon.h"
#include "geometry/say.h"

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

/// A place where two rings meet.
std::optional<Vec2> meeting(const Polygon& a, const Polygon& b) {
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j)
      if (meet(a[i], a[(i + 1) % a.size()], b[j], b[(j + 1) % b.size()])) return b[j];
  return std::nullopt;
}

bool on_one_line(const Polygon& ring) {
  Vec2 far = ring.front();
  for (const Vec2& point : ring)
    if ((point - ring.front()).norm() > (far - ring.front()).norm()) far = point;
  return std::all_of(ring.begin(), ring.end(), [&](const Vec2& point) {
    return distance_to_segment(point, ring.front(), far) < kSame;
  });
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
      return "runs back on itself at " + said_point(b, 3);
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
        return "crosses or touches itself: the edge from " + said_point(ring[j], 3) + " to " +
               said_point(ring[next(j)], 3) + " meets the edge from " + said_point(ring[i], 3) + " to " +
               said_point(ring[next(i)], 3);
    }
    open.push_back(i);
  }
  return std::nullopt;
}

std::optional<std::string> area_fault(const Polygon& ring) {
  if (ring.size() < 3 || on_one_line(ring)) return "encloses no area";
  return ring_fault(ring);
}

std::optional<std::string> holes_fault(const Polygon& outer, const std::vector<Polygon>& holes) {
  for (std::size_t i = 0; i < holes.size(); ++i) {
    const std::string hole = "its hole " + std::to_string(i + 1);
    if (const auto at = meeting(outer, holes[i]))
      return hole + " crosses or touches its outer ring near " + said_point(*at, 3);
    if (!contains(outer, holes[i].front()))
      return hole + " lies outside of it, at " + said_point(holes[i].front(), 3);
    for (std::size_t j = 0; j < i; ++j) {
      const std::string both = "its holes " + std::to_string(j + 1) + " and " + std::to_string(i + 1);
      if (const auto at = meeting(holes[j], holes[i]))
        return both + " cross or touch near " + said_point(*at, 3);
      if (contains(holes[j], holes[i].front()) || contains(holes[i], holes[j].front()))
        return both + " lie in one another";
    }
  }
  return std::nullopt;
}

}  // namespace gramap
