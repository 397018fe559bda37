#include "perception/furniture.h"

#include <algorithm>
#include <cmath>

#include "geometry/polygon.h"
#include "perception/furniture_surfaces.h"

namespace gramap {
namespace {

constexpr double kCutStep_m = 0.1;
constexpr double kLeastSide_m = 0.22;
constexpr int kCutDepth = 2;

/// A rectangle in the frame of a direction: extents along it and to its left.
struct Extent {
  double u0 = 0, u1 = 0, v0 = 0, v1 = 0;
  double area() const { return (u1 - u0) * (v1 - v0); }
};

Polygon ring_of(const Extent& e, const Vec2& axis) {
  const Vec2 left(-axis.y(), axis.x());
  return {e.u0 * axis + e.v0 * left, e.u1 * axis + e.v0 * left, e.u1 * axis + e.v1 * left,
          e.u0 * axis + e.v1 * left};
}

double quantile(std::vector<double>& values, double share) {
  const auto nth =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}

/// The box of the points. A surface's points lie evenly over it, so its sides follow from where all but a
/// twentieth of them at either end lie, and stray ones do not count; a body's lie on its sides, so its sides
/// are where they end.
Extent extent_of(const std::vector<Vec2>& points, const Vec2& axis, bool even) {
  std::vector<double> u, v;
  for (const Vec2& p : points) u.push_back(axis.dot(p)), v.push_back(-axis.y() * p.x() + axis.x() * p.y());
  const double cut = even ? 0.05 : 0.01, beyond = even ? cut / (1 - 2 * cut) : 0;
  Extent e{quantile(u, cut), quantile(u, 1 - cut), quantile(v, cut), quantile(v, 1 - cut)};
  const double grow_u = beyond * (e.u1 - e.u0), grow_v = beyond * (e.v1 - e.v0);
  e.u0 -= grow_u, e.u1 += grow_u, e.v0 -= grow_v, e.v1 += grow_v;
  return e;
}

/// Furniture mostly stands along the walls; when it clearly does not, its own smallest box tells its
/// direction.
Vec2 axis_of(const FurnitureSurface& surface, const Vec2& room_axis) {
  const OrientedBox own = oriented_box(surface.points);
  const Extent along_walls = extent_of(surface.points, room_axis, surface.top_seen),
               as_own = extent_of(surface.points, own.axis, surface.top_seen);
  return as_own.area() < 0.85 * along_walls.area() ? own.axis : room_axis;
}

/// Makes the boxes of one surface and measures them.
class Cutter {
 public:
  Cutter(const FurnitureSurface& surface, const Polygon& outline, const Vec2& room_axis,
         FurnitureCandidates& candidates)
      : surface_(surface), outline_(outline), axis_(axis_of(surface, room_axis)), candidates_(candidates) {}

  /// The candidate of some of the surface's points, and of its parts; −1 when they are too few or too small.
  int cut(const std::vector<Vec2>& points, int depth, double least_area_m2) {
    if (points.size() < 8) return -1;
    Extent e = extent_of(points, axis_, surface_.top_seen);
    reach_walls(e);
    if (e.u1 - e.u0 < kLeastSide_m || e.v1 - e.v0 < kLeastSide_m || e.area() < least_area_m2) return -1;
    const auto mine = static_cast<int>(candidates_.all.size());
    candidates_.all.push_back({ring_of(e, axis_), surface_.top_m, features(points, e), {}});
    if (depth == 0) return mine;
    std::vector<int> parts;
    for (const bool across : {false, true}) {
      const double low = across ? e.v0 : e.u0, high = across ? e.v1 : e.u1;
      const Vec2 direction = across ? Vec2(-axis_.y(), axis_.x()) : axis_;
      for (double at = low + 0.3; at < high - 0.3; at += kCutStep_m) {
        std::vector<Vec2> first, second;
        for (const Vec2& p : points) (direction.dot(p) < at ? first : second).push_back(p);
        const int a = cut(first, depth - 1, least_area_m2), b = cut(second, depth - 1, least_area_m2);
        if (a >= 0 && b >= 0) parts.insert(parts.end(), {a, b});
      }
    }
    candidates_.all[static_cast<std::size_t>(mine)].parts = std::move(parts);
    return mine;
  }

 private:
  /// Points at the walls were left to the walls: sides that end near one end at it.
  void reach_walls(Extent& e) const {
    for (const bool across : {false, true}) {
      const Vec2 direction = across ? Vec2(-axis_.y(), axis_.x()) : axis_,
                 along = across ? axis_ : Vec2(-axis_.y(), axis_.x());
      double &low = across ? e.v0 : e.u0, &high = across ? e.v1 : e.u1;
      const double middle = across ? 0.5 * (e.u0 + e.u1) : 0.5 * (e.v0 + e.v1);
      for (double* side : {&low, &high}) {
        const Vec2 at = *side * direction + middle * along;
        const Vec2 outward = side == &low ? Vec2(-direction) : direction;
        for (double step = 0; step <= 0.16; step += 0.01)
          if (!contains(outline_, at + step * outward)) {
            *side += (side == &low ? -1 : 1) * step;
            break;
          }
      }
    }
  }

  std::vector<float> features(const std::vector<Vec2>& points, const Extent& e) const {
    const double length = std::max(e.u1 - e.u0, e.v1 - e.v0), breadth = std::min(e.u1 - e.u0, e.v1 - e.v0);
    const Polygon ring = ring_of(e, axis_), hull = convex_hull(points);
    double wall = 1e9;
    for (std::size_t i = 0; i < ring.size(); ++i)
      wall = std::min(wall, distance_to_border(outline_, 0.5 * (ring[i] + ring[(i + 1) % ring.size()])));
    // The share of the box's cells that hold points.
    const int columns = std::max(1, static_cast<int>((e.u1 - e.u0) / surface_.cell_m));
    const int rows = std::max(1, static_cast<int>((e.v1 - e.v0) / surface_.cell_m));
    std::vector<bool> held(static_cast<std::size_t>(columns * rows));
    for (const Vec2& p : points) {
      const double u = (axis_.dot(p) - e.u0) / (e.u1 - e.u0),
                   v = (-axis_.y() * p.x() + axis_.x() * p.y() - e.v0) / (e.v1 - e.v0);
      if (u >= 0 && u < 1 && v >= 0 && v < 1)
        held[static_cast<std::size_t>(static_cast<int>(v * rows) * columns + static_cast<int>(u * columns))] =
            true;
    }
    const double filled =
        static_cast<double>(std::count(held.begin(), held.end(), true)) / static_cast<double>(held.size());
    const double below =
        static_cast<double>(surface_.below.size()) / static_cast<double>(surface_.points.size());
    const double values[] = {std::abs(signed_area(hull)),
                             surface_.top_m,
                             length,
                             breadth,
                             length / breadth,
                             std::abs(signed_area(hull)) / e.area(),
                             filled,
                             wall,
                             static_cast<double>(points.size()) / e.area(),
                             below,
                             surface_.top_seen ? 1.0 : 0.0};
    return {std::begin(values), std::end(values)};
  }

  const FurnitureSurface& surface_;
  const Polygon& outline_;
  Vec2 axis_;
  FurnitureCandidates& candidates_;
};

/// The best cutting of a candidate: how much of its area the forest takes for whole pieces.
struct Cutting {
  double worth = 0;
  std::vector<int> pieces;
};

Cutting best_cutting(const FurnitureCandidates& candidates, int at, const Forest& forest) {
  const FurnitureCandidate& candidate = candidates.all[static_cast<std::size_t>(at)];
  const double sure = 1 - forest.votes(candidate.features)[kNoFurniture];
  Cutting best{sure * std::abs(signed_area(candidate.footprint)), {at}};
  for (std::size_t i = 0; i + 1 < candidate.parts.size(); i += 2) {
    Cutting first = best_cutting(candidates, candidate.parts[i], forest);
    Cutting second = best_cutting(candidates, candidate.parts[i + 1], forest);
    if (first.worth + second.worth <= 1.05 * best.worth)
      continue;  // one thing unless two are clearly likelier
    best = {first.worth + second.worth, std::move(first.pieces)};
    best.pieces.insert(best.pieces.end(), second.pieces.begin(), second.pieces.end());
  }
  return best;
}

bool same_place(const FurnitureObservation& a, const FurnitureObservation& b) {
  return contains(a.footprint, centroid(b.footprint)) || contains(b.footprint, centroid(a.footprint));
}

}  // namespace

const std::vector<std::string>& furniture_class_names() {
  static const std::vector<std::string> names = {"none", "table", "chair", "other"};
  return names;
}

const std::vector<std::string>& furniture_feature_names() {
  static const std::vector<std::string> names = {"area",          "height",      "length",    "breadth",
                                                 "aspect",        "hull fill",   "cell fill", "to wall",
                                                 "points per m2", "faces below", "top seen"};
  return names;
}

FurnitureCandidates furniture_candidates(const RegisteredCloud& cloud, const RoomObservation& room,
                                         const FurnitureOptions& options) {
  FurnitureCandidates candidates;
  if (room.outline.size() < 3) return candidates;
  Polygon outline = room.outline;
  for (Vec2& p : outline) p -= cloud.origin_m.head<2>();
  std::size_t longest = 0;
  const auto edge = [&](std::size_t i) { return Vec2(outline[(i + 1) % outline.size()] - outline[i]); };
  for (std::size_t i = 1; i < outline.size(); ++i)
    if (edge(i).norm() > edge(longest).norm()) longest = i;
  const Vec2 room_axis = edge(longest).normalized();
  for (const FurnitureSurface& surface : furniture_surfaces(cloud, room, options)) {
    const int root =
        Cutter(surface, outline, room_axis, candidates).cut(surface.points, kCutDepth, options.least_area_m2);
    if (root >= 0) candidates.roots.push_back(root);
  }
  return candidates;
}

std::vector<FurnitureObservation> find_furniture(const RegisteredCloud& cloud, const RoomObservation& room,
                                                 const Forest& forest, const FurnitureOptions& options) {
  const FurnitureCandidates candidates = furniture_candidates(cloud, room, options);
  std::vector<FurnitureObservation> found;
  for (const int root : candidates.roots)
    for (const int piece : best_cutting(candidates, root, forest).pieces) {
      const FurnitureCandidate& candidate = candidates.all[static_cast<std::size_t>(piece)];
      const std::vector<double> votes = forest.votes(candidate.features);
      if (1 - votes[kNoFurniture] < options.least_confidence) continue;
      const auto best = std::max_element(votes.begin() + kTable, votes.end()) - votes.begin();
      FurnitureObservation observed;
      observed.type = furniture_class_names()[static_cast<std::size_t>(best)];
      for (const Vec2& p : candidate.footprint) observed.footprint.push_back(p + cloud.origin_m.head<2>());
      observed.top_m = candidate.top_m;
      observed.confidence = votes[static_cast<std::size_t>(best)];
      found.push_back(std::move(observed));
    }
  // Of two things in one place (the shelves of a cupboard, say) the higher one holds the other.
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.top_m > b.top_m; });
  std::vector<FurnitureObservation> kept;
  for (FurnitureObservation& one : found)
    if (std::none_of(kept.begin(), kept.end(), [&](const auto& other) { return same_place(one, other); }))
      kept.push_back(std::move(one));
  std::sort(kept.begin(), kept.end(), [](const auto& a, const auto& b) {
    const Vec2 p = centroid(a.footprint), q = centroid(b.footprint);
    return std::pair(p.x(), p.y()) < std::pair(q.x(), q.y());
  });
  return kept;
}

}  // namespace gramap
