#include "perception/shape_remarks.h"

#include <cmath>
#include <cstdio>
#include <numbers>

namespace gramap {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
// Straight pieces of a round wall of 1.5 m radius and more meet at less than this; corners of a bay at more.
constexpr double kLeastTurn = 3 * kDegree, kMostTurn = 44 * kDegree;

/// The angle by which the outline turns left at the corner where edge `i` begins.
double turn_at(const Polygon& ring, std::size_t i) {
  const std::size_t n = ring.size();
  const Vec2 before = ring[i] - ring[(i + n - 1) % n], after = ring[(i + 1) % n] - ring[i];
  return std::atan2(before.x() * after.y() - before.y() * after.x(), before.dot(after));
}

int sign_of_slight_turn(const Polygon& ring, std::size_t i) {
  const double turn = turn_at(ring, i);
  if (std::abs(turn) < kLeastTurn || std::abs(turn) > kMostTurn) return 0;
  return turn > 0 ? 1 : -1;
}

}  // namespace

std::vector<std::string> remarks_on_shape(const RoomOutline& outline, const std::vector<WallLine>& lines) {
  std::vector<std::string> remarks;
  char text[200];
  const std::size_t n = outline.ring.size();
  for (std::size_t i = 0; i < n; ++i) {
    const double lean = lines[static_cast<std::size_t>(outline.lines[i])].lean;
    if (lean == 0) continue;
    std::snprintf(text, sizeof text,
                  "wall %zu leans by %.1f degrees; it is modelled upright, where it stands at mid-height", i,
                  std::atan(std::abs(lean)) / kDegree);
    remarks.emplace_back(text);
  }
  std::size_t start = n;  // a corner at which no round wall goes on
  for (std::size_t i = 0; i < n && start == n; ++i)
    if (sign_of_slight_turn(outline.ring, i) != sign_of_slight_turn(outline.ring, (i + n - 1) % n)) start = i;
  if (start == n && sign_of_slight_turn(outline.ring, 0) == 0) return remarks;
  if (start == n) start = 0;  // the whole room is round
  for (std::size_t k = 0; k < n;) {
    const std::size_t first = (start + k) % n;
    const int sign = sign_of_slight_turn(outline.ring, first);
    std::size_t corners = 1;
    while (k + corners < n && sign_of_slight_turn(outline.ring, (first + corners) % n) == sign) ++corners;
    k += corners;
    if (sign == 0 || corners < 2) continue;
    std::snprintf(text, sizeof text,
                  "walls %zu to %zu look like one round wall; it is modelled as %zu straight ones",
                  (first + n - 1) % n, (first + corners - 1) % n, corners == n ? n : corners + 1);
    remarks.emplace_back(text);
  }
  return remarks;
}

}  // namespace gramap
