#include "perception/furniture.h"

#include <algorithm>
#include <cmath>

#include "geometry/overlap.h"
#include "geometry/polygon.h"
#include "perception/furniture_features.h"
#include "perception/furniture_surfaces.h"

namespace gramap {
namespace {

constexpr double kCutStep_m = 0.1;
constexpr double kLeastSide_m = 0.22;
constexpr int kCutDepth = 2;
constexpr double kEqualBonus = 1.15;  // tables that make one surface mostly are of one size
constexpr double kSeamMalus = 0.7;    // a chair stands where the cut would be
constexpr double kChairVotes = 0.3;
constexpr double kSeatHalf_m = 0.2, kSeatReach_m = 0.6;  // a chair and how far it stands from its table
constexpr double kAtWall_m = 0.16;                       // a side nearer to a wall than this is at it
constexpr double kDeepest_m = 0.8;                       // no cupboard reaches farther from the wall

double quantile(std::vector<double>& values, double share) {
  const auto nth =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}

/// The box of the points. A surface's points lie evenly over it, so its sides follow from where all but a
/// twentieth of them at either end lie, and stray ones do not count; a body's lie on its sides, so its sides
/// are where they end.
AxisBox extent_of(const std::vector<Vec2>& points, const Vec2& axis, bool even) {
  std::vector<double> u, v;
  for (const Vec2& p : points) u.push_back(axis.dot(p)), v.push_back(-axis.y() * p.x() + axis.x() * p.y());
  const double cut = even ? 0.05 : 0.01, beyond = even ? cut / (1 - 2 * cut) : 0;
  AxisBox e{quantile(u, cut), quantile(u, 1 - cut), quantile(v, cut), quantile(v, 1 - cut)};
  const double grow_u = beyond * (e.u1 - e.u0), grow_v = beyond * (e.v1 - e.v0);
  e.u0 -= grow_u, e.u1 += grow_u, e.v0 -= grow_v, e.v1 += grow_v;
  return e;
}

/// Furniture mostly stands along the walls; when it clearly does not, its own smallest box tells its
/// direction.
Vec2 axis_of(const FurnitureSurface& surface, const Vec2& room_axis) {
  const OrientedBox own = oriented_box(surface.points);
  const AxisBox along_walls = extent_of(surface.points, room_axis, surface.top_seen),
                as_own = extent_of(surface.points, own.axis, surface.top_seen);
  return as_own.area() < 0.85 * along_walls.area() ? own.axis : room_axis;
}

/// Makes the boxes of one surface and measures them.
class Cutter {
 public:
  Cutter(const FurnitureSurface& surface, const FurnitureCells& cells, const Vec2& room_axis,
         FurnitureCandidates& candidates)
      : surface_(surface), cells_(cells), axis_(axis_of(surface, room_axis)), candidates_(candidates) {}

  /// The candidate of some of the surface's points, and of its parts; −1 when they are too few or too small.
  int cut(const std::vector<Vec2>& points, int depth, double least_area_m2) {
    if (points.size() < 8) return -1;
    AxisBox e = extent_of(points, axis_, surface_.top_seen);
    reach_walls(e);
    if (e.u1 - e.u0 < kLeastSide_m || e.v1 - e.v0 < kLeastSide_m || e.area() < least_area_m2) return -1;
    const auto mine = static_cast<int>(candidates_.all.size());
    candidates_.all.push_back({ring_of(e, axis_),
                               surface_.top_m,
                               furniture_features(cells_, surface_, points, e, axis_, depth == kCutDepth),
                               {}});
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
  /// Points at the walls were left to the walls: sides that end near one end at it. Of a body that only its
  /// front is seen of, the rest is between the front and the wall behind, where nothing was seen.
  void reach_walls(AxisBox& e) const {
    const bool flat[] = {2 * (e.u1 - e.u0) < e.v1 - e.v0, 2 * (e.v1 - e.v0) < e.u1 - e.u0};
    double* const sides[] = {&e.u0, &e.u1, &e.v0, &e.v1};
    const AxisBox seen = e;
    for (int i = 0; i < 4; ++i) {
      const double gap_m = gap_behind(seen, i);
      const bool hidden = !surface_.top_seen && flat[i / 2] && gap_m <= kDeepest_m && unseen(seen, i, gap_m);
      if (gap_m <= kAtWall_m || hidden) *sides[i] += (i % 2 == 0 ? -1 : 1) * gap_m;
    }
  }

  Vec2 outward(int side) const {
    const Vec2 direction = side < 2 ? axis_ : Vec2(-axis_.y(), axis_.x());
    return side % 2 == 0 ? Vec2(-direction) : direction;
  }

  static double end_of(const AxisBox& e, int side) {
    const double ends[] = {-e.u0, e.u1, -e.v0, e.v1};
    return ends[side];
  }

  /// From the middle of a side to the wall that it faces.
  double gap_behind(const AxisBox& e, int side) const {
    const Vec2 along = side < 2 ? Vec2(-axis_.y(), axis_.x()) : axis_;
    const double middle = side < 2 ? 0.5 * (e.v0 + e.v1) : 0.5 * (e.u0 + e.u1);
    const Vec2 at = end_of(e, side) * outward(side) + middle * along;
    double step = 0;
    while (step <= kDeepest_m && contains(cells_.outline, at + step * outward(side))) step += 0.01;
    return step;
  }

  /// Neither floor nor anything else was measured in most of the strip behind a side.
  bool unseen(const AxisBox& e, int side, double gap_m) const {
    const Vec2 along = side < 2 ? Vec2(-axis_.y(), axis_.x()) : axis_;
    const double from = side < 2 ? e.v0 : e.u0, to = side < 2 ? e.v1 : e.u1;
    int places = 0, seen = 0;
    for (double s = from + 0.5 * cells_.cell_m; s < to; s += cells_.cell_m)
      for (double d = cells_.cell_m; d < gap_m - 0.5 * cells_.cell_m; d += cells_.cell_m) {
        const Vec2 p = (end_of(e, side) + d) * outward(side) + s * along;
        const Vec2 at = (p - cells_.low) / cells_.cell_m;
        if (at.minCoeff() < 0 || at.x() >= cells_.floor.columns || at.y() >= cells_.floor.rows) continue;
        ++places;
        seen += cells_.floor.at(static_cast<int>(at.x()), static_cast<int>(at.y())) > 0;
      }
    return seen <= 0.2 * places;
  }

  const FurnitureSurface& surface_;
  const FurnitureCells& cells_;
  Vec2 axis_;
  FurnitureCandidates& candidates_;
};

/// The best cutting of a candidate: how much of its area the forest takes for whole pieces.
struct Cutting {
  double worth = 0;
  std::vector<int> pieces;
};

/// Chooses how to cut what stands together. Two equal tables pushed together can often be cut two ways;
/// people sit at the middle of a table, not where two meet.
class CuttingChooser {
 public:
  CuttingChooser(const FurnitureCandidates& candidates, const Forest& forest)
      : candidates_(candidates), forest_(forest) {
    for (const int root : candidates.roots)
      if (forest.votes(at(root).features)[kChair] > kChairVotes)
        chairs_.push_back(centroid(at(root).footprint));
  }

  Cutting best(int whole) const {
    const FurnitureCandidate& candidate = at(whole);
    const double sure = 1 - forest_.votes(candidate.features)[kNoFurniture];
    Cutting best_one{sure * area(whole), {whole}};
    for (std::size_t i = 0; i + 1 < candidate.parts.size(); i += 2) {
      Cutting first = best(candidate.parts[i]), second = best(candidate.parts[i + 1]);
      double worth = first.worth + second.worth;
      if (first.pieces.size() == 1 && second.pieces.size() == 1) {
        if (equal(first.pieces[0], second.pieces[0])) worth *= kEqualBonus;
        if (chair_at_seam(first.pieces[0], second.pieces[0])) worth *= kSeamMalus;
      }
      if (worth <= 1.05 * best_one.worth) continue;  // one thing unless two are clearly likelier
      best_one = {worth, std::move(first.pieces)};
      best_one.pieces.insert(best_one.pieces.end(), second.pieces.begin(), second.pieces.end());
    }
    return best_one;
  }

 private:
  const FurnitureCandidate& at(int i) const { return candidates_.all[static_cast<std::size_t>(i)]; }
  double area(int i) const { return std::abs(signed_area(at(i).footprint)); }
  bool equal(int a, int b) const { return std::min(area(a), area(b)) > 0.85 * std::max(area(a), area(b)); }
  bool chair_at_seam(int a, int b) const {
    const Polygon &p = at(a).footprint, &q = at(b).footprint;
    const Vec2 across = (centroid(q) - centroid(p)).normalized();
    double last = across.dot(p[0]), first = across.dot(q[0]);
    for (const Vec2& corner : p) last = std::max(last, across.dot(corner));
    for (const Vec2& corner : q) first = std::min(first, across.dot(corner));
    const double seam = 0.5 * (first + last);
    return std::any_of(chairs_.begin(), chairs_.end(), [&](const Vec2& chair) {
      return std::abs(across.dot(chair) - seam) < kSeatHalf_m &&
             distance_to_border(p, chair) < kSeatReach_m && distance_to_border(q, chair) < kSeatReach_m;
    });
  }

  const FurnitureCandidates& candidates_;
  const Forest& forest_;
  std::vector<Vec2> chairs_;
};

/// One of the two hides most of the other in the plan.
bool same_place(const FurnitureObservation& a, const FurnitureObservation& b) {
  const double smaller = std::min(std::abs(signed_area(a.footprint)), std::abs(signed_area(b.footprint)));
  return shared_area(a.footprint, b.footprint) > 0.4 * smaller;
}

}  // namespace

const std::vector<std::string>& furniture_class_names() {
  static const std::vector<std::string> names = {"none", "table", "chair", "other"};
  return names;
}

FurnitureCandidates furniture_candidates(const RegisteredCloud& cloud, const RoomObservation& room,
                                         const FurnitureOptions& options) {
  FurnitureCandidates candidates;
  if (room.outline.size() < 3) return candidates;
  const FurnitureCells cells = furniture_cells(cloud, room, options);
  const Polygon& outline = cells.outline;
  std::size_t longest = 0;
  const auto edge = [&](std::size_t i) { return Vec2(outline[(i + 1) % outline.size()] - outline[i]); };
  for (std::size_t i = 1; i < outline.size(); ++i)
    if (edge(i).norm() > edge(longest).norm()) longest = i;
  const Vec2 room_axis = edge(longest).normalized();
  for (const FurnitureSurface& surface : furniture_surfaces(cells, options)) {
    const int root =
        Cutter(surface, cells, room_axis, candidates).cut(surface.points, kCutDepth, options.least_area_m2);
    if (root >= 0) candidates.roots.push_back(root);
  }
  return candidates;
}

std::vector<FurnitureObservation> find_furniture(const RegisteredCloud& cloud, const RoomObservation& room,
                                                 const Forest& forest, const FurnitureOptions& options) {
  return judge_furniture(furniture_candidates(cloud, room, options), cloud.origin_m, forest,
                         options.least_confidence);
}

std::vector<FurnitureObservation> judge_furniture(const FurnitureCandidates& candidates, const Vec3& origin_m,
                                                  const Forest& forest, double least_confidence) {
  struct Piece {
    FurnitureObservation observed;
    double sure;
  };
  const CuttingChooser chooser(candidates, forest);
  std::vector<Piece> found;
  for (const int root : candidates.roots)
    for (const int piece : chooser.best(root).pieces) {
      const FurnitureCandidate& candidate = candidates.all[static_cast<std::size_t>(piece)];
      const std::vector<double> votes = forest.votes(candidate.features);
      const double sure = 1 - votes[kNoFurniture];
      if (sure < least_confidence) continue;
      const auto best = std::max_element(votes.begin() + kTable, votes.end()) - votes.begin();
      FurnitureObservation observed;
      observed.type = furniture_class_names()[static_cast<std::size_t>(best)];
      for (const Vec2& p : candidate.footprint) observed.footprint.push_back(p + origin_m.head<2>());
      observed.top_m = candidate.top_m;
      observed.confidence = votes[static_cast<std::size_t>(best)];
      found.push_back({std::move(observed), sure});
    }
  // Of two things in one place (a cupboard's top and its front, say) the likelier one stays.
  std::stable_sort(found.begin(), found.end(),
                   [](const Piece& a, const Piece& b) { return a.sure > b.sure; });
  std::vector<FurnitureObservation> kept;
  for (Piece& one : found)
    if (std::none_of(kept.begin(), kept.end(),
                     [&](const auto& other) { return same_place(one.observed, other); }))
      kept.push_back(std::move(one.observed));
  std::sort(kept.begin(), kept.end(), [](const auto& a, const auto& b) {
    const Vec2 p = centroid(a.footprint), q = centroid(b.footprint);
    return std::pair(p.x(), p.y()) < std::pair(q.x(), q.y());
  });
  return kept;
}

}  // namespace gramap
