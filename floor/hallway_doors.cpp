#include "floor/hallway_doors.h"

#include <algorithm>
#include <cmath>

#include "geometry/polygon.h"

namespace gramap {
namespace {

struct Box {
  Vec2 low, high;
  Vec2 size() const { return high - low; }
};

Box bounds(const Polygon& ring, const Vec2& u) {
  const Vec2 v(-u.y(), u.x());
  Box box{Vec2::Constant(1e300), Vec2::Constant(-1e300)};
  for (const Vec2& point : ring) {
    const Vec2 local(point.dot(u), point.dot(v));
    box.low = box.low.cwiseMin(local), box.high = box.high.cwiseMax(local);
  }
  return box;
}

/// See PlanMotion::misfit_m.
double misfit(const Polygon& seen, const PlanMotion& motion, const Polygon& given) {
  double sum = 0;
  for (const Vec2& point : seen) sum += std::pow(distance_to_border(given, motion(point)), 2);
  return std::sqrt(sum / static_cast<double>(std::max<std::size_t>(1, seen.size())));
}

}  // namespace

Vec2 PlanMotion::operator()(const Vec2& point) const {
  const double c = std::cos(angle_rad), s = std::sin(angle_rad);
  return Vec2(c * point.x() - s * point.y(), s * point.x() + c * point.y()) + shift;
}

std::vector<PlanMotion> hallway_motions(const RoomObservation& seen, const Polygon& given, bool own_frame) {
  const Vec2 axis = oriented_box(given).axis, across(-axis.y(), axis.x());
  const Box target = bounds(given, axis);
  std::vector<PlanMotion> ranked;
  for (int quarter = 0; quarter < 4; ++quarter) {
    // The rotation that takes the seen axis, turned by quarters, onto the given one; middles of the boxes on
    // each other.
    const double angle =
        std::atan2(axis.y(), axis.x()) - std::atan2(seen.axis.y(), seen.axis.x()) + quarter * M_PI / 2;
    PlanMotion motion{std::remainder(angle, 2 * M_PI), Vec2::Zero(), 0};
    Polygon turned;
    for (const Vec2& point : seen.outline) turned.push_back(motion(point));
    const Box box = bounds(turned, axis);
    const Vec2 middle = (target.low + target.high - box.low - box.high) / 2;
    motion.shift = middle.x() * axis + middle.y() * across;
    if (!own_frame && std::abs(motion.angle_rad) > M_PI / 4) continue;
    motion.misfit_m = misfit(seen.outline, motion, given);
    ranked.push_back(motion);
  }
  std::sort(ranked.begin(), ranked.end(),
            [](const PlanMotion& a, const PlanMotion& b) { return a.misfit_m < b.misfit_m; });
  std::erase_if(ranked, [best = ranked.empty() ? 0 : ranked.front().misfit_m](const PlanMotion& motion) {
    return motion.misfit_m > best + 0.3;
  });
  return ranked;
}

void add_door_evidence(const FloorGroundTruth& floor, const RoomObservation& hallway,
                       const PlanMotion& plan_from_hallway, std::vector<SpaceProblem>& problems,
                       const HallwayDoorOptions& options) {
  const double sigma_m = std::hypot(options.door_sigma_m, plan_from_hallway.misfit_m);
  for (std::size_t index = 0; index < hallway.walls.size(); ++index) {
    const WallObservation& wall = hallway.walls[index];
    const Vec2 a = plan_from_hallway(wall.a), b = plan_from_hallway(wall.b);
    if ((b - a).norm() < 0.3) continue;
    const Vec2 direction = (b - a).normalized();
    for (std::size_t i = 0; i < floor.spaces.size(); ++i) {
      const Space& space = floor.spaces[i];
      const Vec2 along = (space.end - space.start).normalized(), left(-along.y(), along.x());
      // The hallway has its wall's inside on the left, the space has its own: the two run against each other.
      if (direction.dot(along) > -0.98) continue;
      if (std::abs(((a + b) / 2 - space.start).dot(left)) > options.reach_m) continue;
      const double length = clear_length_m(space);
      const double low = std::max(0.0, (b - space.start).dot(along)),
                   high = std::min(length, (a - space.start).dot(along));
      if (high <= low) continue;
      problems[i].doors_visible.push_back({low, high});
      for (const OpeningObservation& opening : hallway.openings) {
        if (opening.kind != "door" || opening.wall != static_cast<int>(index) ||
            opening.confidence < options.least_confidence)
          continue;
        const Vec2 middle = a + direction * (opening.start_m + opening.width_m / 2);
        const double centre = (middle - space.start).dot(along);
        if (centre <= 0 || centre >= length) continue;
        problems[i].doors.push_back({centre, sigma_m, opening.width_m, options.width_sigma_m});
      }
    }
  }
}

}  // namespace gramap
