#include "perception/furniture_cells.h"

#include <algorithm>
#include <cmath>

#include "geometry/polygon.h"

namespace gramap {
namespace {

constexpr std::size_t kEnoughPoints = 250000;
constexpr double kFloor_m = 0.06;      // points of the floor lie within, noise included
constexpr double kOverFloor_m = 0.08;  // and what stands on it begins here
constexpr double kUnderCeiling_m = 0.12;

struct HeightPoint {
  Vec2 plan;
  double z;
};

std::vector<HeightPoint> points_in_box(const RegisteredCloud& cloud, double floor_z, const Vec2& low,
                                       const Vec2& high) {
  std::vector<HeightPoint> inside;
  const std::size_t step = std::max<std::size_t>(1, cloud.points_m.size() / kEnoughPoints);
  inside.reserve(cloud.points_m.size() / step + 1);
  for (std::size_t i = 0; i < cloud.points_m.size(); i += step) {
    const Vec2 plan = cloud.points_m[i].head<2>().cast<double>();
    if ((plan.array() >= low.array()).all() && (plan.array() <= high.array()).all())
      inside.push_back({plan, cloud.points_m[i].z() - floor_z});
  }
  return inside;
}

}  // namespace

FurnitureCells furniture_cells(const RegisteredCloud& cloud, const RoomObservation& room,
                               const FurnitureOptions& options) {
  FurnitureCells cells;
  cells.outline = room.outline;
  for (Vec2& p : cells.outline) p -= cloud.origin_m.head<2>();
  cells.low = cells.outline[0];
  Vec2 high = cells.outline[0];
  for (const Vec2& p : cells.outline) cells.low = cells.low.cwiseMin(p), high = high.cwiseMax(p);
  const std::vector<HeightPoint> inside =
      points_in_box(cloud, room.floor_z_m - cloud.origin_m.z(), cells.low, high);
  const auto on_floor = std::count_if(inside.begin(), inside.end(), [&](const HeightPoint& p) {
    return std::abs(p.z) < kFloor_m && contains(cells.outline, p.plan);
  });
  cells.floor_density =
      std::max(1.0, static_cast<double>(on_floor)) / std::max(0.1, signed_area(cells.outline));
  cells.cell_m = std::clamp(2.5 / std::sqrt(cells.floor_density), 0.05, 0.12);

  const int columns = static_cast<int>((high.x() - cells.low.x()) / cells.cell_m) + 1,
            rows = static_cast<int>((high.y() - cells.low.y()) / cells.cell_m) + 1;
  cells.points = {columns, rows}, cells.floor = {columns, rows}, cells.in_room = {columns, rows};
  Raster<float> to_wall_m(columns, rows);
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const Vec2 centre = cells.centre(column, row);
      cells.in_room.at(column, row) = contains(cells.outline, centre) ? 1 : 0;
      to_wall_m.at(column, row) = static_cast<float>(distance_to_border(cells.outline, centre));
    }
  const double top = std::min(options.highest_m, room.ceiling_z_m - room.floor_z_m - kUnderCeiling_m);
  const double across = 0.75 * cells.cell_m;  // farther from a cell's middle no point of it lies
  for (const HeightPoint& p : inside) {
    if (p.z < -kFloor_m || p.z > top) continue;
    const Vec2 at = (p.plan - cells.low) / cells.cell_m;
    const int column = static_cast<int>(at.x()), row = static_cast<int>(at.y());
    const double wall = to_wall_m.at(column, row);
    if (wall < options.from_wall_m + across) {
      if (wall > across ? cells.in_room.at(column, row) == 0 : !contains(cells.outline, p.plan)) continue;
      if (distance_to_border(cells.outline, p.plan) < options.from_wall_m) continue;
    } else if (cells.in_room.at(column, row) == 0) {
      continue;
    }
    if (p.z < kFloor_m)
      ++cells.floor.at(column, row);
    else if (p.z >= kOverFloor_m)
      cells.points.at(column, row)
          .emplace_back(static_cast<float>(p.plan.x()), static_cast<float>(p.plan.y()),
                        static_cast<float>(p.z));
  }
  for (auto& column : cells.points.cells)
    std::sort(column.begin(), column.end(), [](const auto& a, const auto& b) { return a.z() < b.z(); });
  return cells;
}

}  // namespace gramap
