#include "perception/furniture_features.h"

#include <algorithm>
#include <cmath>

#include "geometry/polygon.h"

namespace gramap {
namespace {

constexpr double kSameHeight_m = 0.04;
constexpr double kBesideFrom_m = 0.03, kBesideTo_m = 0.16;  // the margin around a box

Vec2 left_of(const Vec2& axis) {
  return {-axis.y(), axis.x()};
}

/// Shares of the cells in a box, or in the margin around it, of which something holds.
struct Shares {
  int inside = 0, held = 0, floor = 0, walled = 0;
  int beside = 0, goes_on = 0, floor_beside = 0, wall_beside = 0, higher_beside = 0, step_beside = 0;
};

double share(int part, int whole) {
  return whole > 0 ? static_cast<double>(part) / whole : 0;
}

bool any_between(const std::vector<Eigen::Vector3f>& column, double low_m, double high_m) {
  const auto first = std::lower_bound(column.begin(), column.end(), low_m,
                                      [](const Eigen::Vector3f& p, double z) { return p.z() < z; });
  return first != column.end() && first->z() <= high_m;
}

/// Points one above the other over most of the height below the top: the box's upright sides.
bool is_face(const std::vector<Eigen::Vector3f>& column, double top_m) {
  const int bins = std::max(1, static_cast<int>((top_m - 0.1) / 0.1));
  int filled = 0;
  for (int bin = 0; bin < bins; ++bin) filled += any_between(column, 0.1 + 0.1 * bin, 0.2 + 0.1 * bin);
  return 2 * filled > bins;
}

void count_inside(Shares& shares, const FurnitureCells& cells, int column, int row, double top_m) {
  const auto& held = cells.points.at(column, row);
  ++shares.inside;
  shares.held += any_between(held, top_m - kSameHeight_m, top_m + kSameHeight_m);
  shares.floor += cells.floor.at(column, row) > 0;
  shares.walled += is_face(held, top_m);
}

void count_beside(Shares& shares, const FurnitureCells& cells, int column, int row, double top_m) {
  ++shares.beside;
  if (column < 0 || row < 0 || column >= cells.points.columns || row >= cells.points.rows ||
      cells.in_room.at(column, row) == 0) {
    ++shares.wall_beside;
    return;
  }
  const auto& held = cells.points.at(column, row);
  shares.goes_on += any_between(held, top_m - kSameHeight_m, top_m + kSameHeight_m);
  shares.floor_beside += cells.floor.at(column, row) > 0;
  shares.higher_beside += any_between(held, top_m + 0.3, 10);
  // What ends a step's height above or below, as stairs do.
  const double end = held.empty() ? 0 : static_cast<double>(held.back().z());
  shares.step_beside += std::abs(end - top_m) > 0.1 && std::abs(end - top_m) < 0.24;
}

Shares shares_of(const FurnitureCells& cells, const AxisBox& e, const Vec2& axis, double top_m) {
  Shares shares;
  Vec2 low = ring_of(e, axis)[0], high = low;
  for (const Vec2& p : ring_of(e, axis)) low = low.cwiseMin(p), high = high.cwiseMax(p);
  const auto cell_of = [&](const Vec2& p) {
    return Eigen::Vector2i(((p - cells.low) / cells.cell_m).array().floor().cast<int>());
  };
  const Eigen::Vector2i first = cell_of(low - Vec2::Constant(kBesideTo_m)),
                        last = cell_of(high + Vec2::Constant(kBesideTo_m));
  for (int row = first.y(); row <= last.y(); ++row)
    for (int column = first.x(); column <= last.x(); ++column) {
      const Vec2 p = cells.centre(column, row);
      const double u = axis.dot(p), v = left_of(axis).dot(p);
      const double out = std::max({e.u0 - u, u - e.u1, e.v0 - v, v - e.v1});
      const bool known = column >= 0 && row >= 0 && column < cells.points.columns && row < cells.points.rows;
      if (out < 0 && known) count_inside(shares, cells, column, row, top_m);
      if (out > kBesideFrom_m && out < kBesideTo_m) count_beside(shares, cells, column, row, top_m);
    }
  return shares;
}

}  // namespace

Polygon ring_of(const AxisBox& e, const Vec2& axis) {
  const Vec2 left = left_of(axis);
  return {e.u0 * axis + e.v0 * left, e.u1 * axis + e.v0 * left, e.u1 * axis + e.v1 * left,
          e.u0 * axis + e.v1 * left};
}

const std::vector<std::string>& furniture_feature_names() {
  static const std::vector<std::string> names = {
      "area",        "height",        "length",      "breadth", "aspect",
      "hull fill",   "cell fill",     "to wall",     "density", "faces below",
      "top seen",    "upright share", "floor below", "goes on", "floor beside",
      "wall beside", "higher beside", "step beside", "whole"};
  return names;
}

std::vector<float> furniture_features(const FurnitureCells& cells, const FurnitureSurface& surface,
                                      const std::vector<Vec2>& points, const AxisBox& e, const Vec2& axis,
                                      bool whole) {
  const double length = std::max(e.u1 - e.u0, e.v1 - e.v0), breadth = std::min(e.u1 - e.u0, e.v1 - e.v0);
  const Polygon ring = ring_of(e, axis), hull = convex_hull(points);
  const double hull_m2 = std::abs(signed_area(hull));
  double wall = 1e9;
  for (std::size_t i = 0; i < ring.size(); ++i)
    wall = std::min(wall, distance_to_border(cells.outline, 0.5 * (ring[i] + ring[(i + 1) % ring.size()])));
  const Shares shares = shares_of(cells, e, axis, surface.top_m);
  const double values[] = {
      hull_m2,
      surface.top_m,
      length,
      breadth,
      length / breadth,
      hull_m2 / e.area(),
      share(shares.held, shares.inside),
      std::min(wall, 2.0),
      static_cast<double>(points.size()) * surface.weight / (e.area() * cells.floor_density),
      static_cast<double>(surface.below) / static_cast<double>(surface.points.size()),
      surface.top_seen ? 1.0 : 0.0,
      share(shares.walled, shares.inside),
      share(shares.floor, shares.inside),
      share(shares.goes_on, shares.beside),
      share(shares.floor_beside, shares.beside),
      share(shares.wall_beside, shares.beside),
      share(shares.higher_beside, shares.beside),
      share(shares.step_beside, shares.beside),
      whole ? 1.0 : 0.0};
  return {std::begin(values), std::end(values)};
}

}  // namespace gramap
