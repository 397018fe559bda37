#include "perception/truth_match.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/overlap.h"
#include "geometry/polygon.h"

namespace gramap {
namespace {

/// Direction of an outline to the quarter turn: the mean over its edges, each turned four times as far,
/// weighted by length.
double direction_of(const Polygon& ring) {
  double cosine = 0, sine = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 edge = ring[(i + 1) % ring.size()] - ring[i];
    const double angle = 4 * std::atan2(edge.y(), edge.x());
    cosine += edge.norm() * std::cos(angle), sine += edge.norm() * std::sin(angle);
  }
  return std::atan2(sine, cosine) / 4;
}

}  // namespace

namespace {

BuildingRoom turned_truth(const BuildingRoom& truth, const RoomObservation& observed, double turn_rad) {
  const Eigen::Matrix2d rotation = Eigen::Rotation2Dd(turn_rad).toRotationMatrix();
  const Vec2 from = centroid(truth.outline), to = centroid(observed.outline);
  const auto moved = [&](const Vec2& p) { return Vec2(to + rotation * (p - from)); };
  BuildingRoom room = truth;
  for (Vec2& p : room.outline) p = moved(p);
  for (BuildingOpening& opening : room.openings) opening.a = moved(opening.a), opening.b = moved(opening.b);
  for (BuildingFurniture& piece : room.furniture)
    for (Vec2& p : piece.outline) p = moved(p);
  return room;
}

double opening_overlap(const BuildingRoom& room, const RoomObservation& observed) {
  double sum = 0;
  for (const OpeningObservation& truth : true_openings(room, observed))
    for (const OpeningObservation& found : observed.openings)
      if (found.kind == truth.kind) sum += overlap(found, truth);
  return sum;
}

}  // namespace

BuildingRoom aligned_truth(const BuildingRoom& truth, const RoomObservation& observed) {
  constexpr double kQuarter_rad = std::numbers::pi / 2;
  double turn = direction_of(observed.outline) - direction_of(truth.outline);
  turn -= kQuarter_rad * std::round(turn / kQuarter_rad);
  BuildingRoom best = turned_truth(truth, observed, turn);
  if (observed.openings.empty()) return best;
  double best_match =
      intersection_over_union(best.outline, observed.outline) + opening_overlap(best, observed);
  for (int quarter = 1; quarter < 4; ++quarter) {
    BuildingRoom room = turned_truth(truth, observed, turn + quarter * kQuarter_rad);
    const double match =
        intersection_over_union(room.outline, observed.outline) + opening_overlap(room, observed);
    if (match > best_match + 0.2) best = std::move(room), best_match = match;
  }
  return best;
}

std::vector<OpeningObservation> true_openings(const BuildingRoom& aligned, const RoomObservation& observed) {
  std::vector<OpeningObservation> openings;
  for (const BuildingOpening& opening : aligned.openings) {
    OpeningObservation truth;
    truth.kind = opening.kind;
    truth.wall = -1;
    truth.sill_m = opening.sill_m, truth.head_m = opening.head_m;
    double nearest = 0.3;
    for (std::size_t i = 0; i < observed.walls.size(); ++i) {
      const WallObservation& wall = observed.walls[i];
      const double distance = distance_to_segment(0.5 * (opening.a + opening.b), wall.a, wall.b);
      const Vec2 along = (wall.b - wall.a).normalized();
      if (distance >= nearest || std::abs(along.dot((opening.b - opening.a).normalized())) < 0.9) continue;
      nearest = distance;
      const double s = along.dot(opening.a - wall.a), t = along.dot(opening.b - wall.a);
      truth.wall = static_cast<int>(i);
      truth.start_m = std::min(s, t), truth.width_m = std::abs(t - s);
    }
    openings.push_back(truth);
  }
  return openings;
}

double overlap(const OpeningObservation& a, const OpeningObservation& b) {
  if (a.wall != b.wall) return 0;
  const double width =
      std::min(a.start_m + a.width_m, b.start_m + b.width_m) - std::max(a.start_m, b.start_m);
  const double height = std::min(a.head_m, b.head_m) - std::max(a.sill_m, b.sill_m);
  if (width <= 0 || height <= 0) return 0;
  const double both = width * height;
  return both / (a.width_m * (a.head_m - a.sill_m) + b.width_m * (b.head_m - b.sill_m) - both);
}

RoomObservation observation_of_truth(const BuildingRoom& truth,
                                     const Eigen::Isometry3d& frame_from_building) {
  RoomObservation room;
  room.room = truth.id;
  for (const Vec2& p : truth.outline)
    room.outline.push_back((frame_from_building * Vec3(p.x(), p.y(), 0)).head<2>());
  for (std::size_t i = 0; i < room.outline.size(); ++i) {
    WallObservation wall;
    wall.a = room.outline[i], wall.b = room.outline[(i + 1) % room.outline.size()];
    wall.plane_rms_m = 0.02;
    room.walls.push_back(wall);
  }
  room.floor_z_m = truth.floor_m + frame_from_building.translation().z();
  room.ceiling_z_m = truth.ceiling_m + frame_from_building.translation().z();
  return room;
}

}  // namespace gramap
