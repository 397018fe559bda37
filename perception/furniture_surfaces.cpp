#include "perception/furniture_surfaces.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <queue>

#include "geometry/polygon.h"
#include "perception/raster.h"

namespace gramap {
namespace {

constexpr double kThickness_m = 0.05;  // points of one level surface lie within, noise included
constexpr double kStep_m = 0.04;       // neighbouring cells of one surface differ by less
constexpr int kLeastFaceBins = 5;      // an upright face is at least so many bins high
constexpr double kBin_m = 0.1;         // of the height, where upright faces are looked for

/// The points of a room's inside by cells of the plan.
struct Columns {
  Vec2 low = Vec2::Zero();
  double cell_m = 0.1;
  Raster<std::vector<Eigen::Vector3f>> cells;  ///< plan coordinates, and height over the floor
};

struct Level {
  int column, row;
  float z;
  int count;
};

double floor_density(const RegisteredCloud& cloud, const RoomObservation& room, const Polygon& outline) {
  const double floor_z = room.floor_z_m - cloud.origin_m.z();
  const auto on_floor = std::count_if(cloud.points_m.begin(), cloud.points_m.end(), [&](const Point& p) {
    return std::abs(p.z() - floor_z) < 0.06 && contains(outline, p.head<2>().cast<double>());
  });
  return std::max(1.0, static_cast<double>(on_floor)) / std::max(0.1, signed_area(outline));
}

Columns columns_of(const RegisteredCloud& cloud, const RoomObservation& room, const Polygon& outline,
                   double cell_m, const FurnitureOptions& options) {
  Columns columns;
  columns.cell_m = cell_m;
  columns.low = outline[0];
  Vec2 high = outline[0];
  for (const Vec2& p : outline) columns.low = columns.low.cwiseMin(p), high = high.cwiseMax(p);
  columns.cells = {static_cast<int>((high.x() - columns.low.x()) / cell_m) + 1,
                   static_cast<int>((high.y() - columns.low.y()) / cell_m) + 1};
  const double floor_z = room.floor_z_m - cloud.origin_m.z();
  const double top = std::min(options.highest_m, room.ceiling_z_m - room.floor_z_m - 0.12);
  for (const Point& p : cloud.points_m) {
    const double z = p.z() - floor_z;
    const Vec2 plan = p.head<2>().cast<double>();
    if (z < 0.08 || z > top || (plan.array() < columns.low.array()).any() ||
        (plan.array() > high.array()).any())
      continue;
    if (!contains(outline, plan) || distance_to_border(outline, plan) < options.from_wall_m) continue;
    const Vec2 at = (plan - columns.low) / cell_m;
    columns.cells.at(static_cast<int>(at.x()), static_cast<int>(at.y()))
        .emplace_back(p.x(), p.y(), static_cast<float>(z));
  }
  for (auto& column : columns.cells.cells)
    std::sort(column.begin(), column.end(), [](const auto& a, const auto& b) { return a.z() < b.z(); });
  return columns;
}

/// The heights at which a column holds at least `least` points within a surface's thickness, fullest first;
/// clearly more than an upright face with the column's other points would hold there by chance.
void add_levels(const std::vector<Eigen::Vector3f>& column, int at_column, int at_row, int least,
                std::vector<Level>& levels) {
  std::vector<Level> found;
  for (std::size_t first = 0, last = 0; first < column.size(); ++first) {
    while (last < column.size() && column[last].z() <= column[first].z() + kThickness_m) ++last;
    const int count = static_cast<int>(last - first);
    const double slices = std::max(1.0, (column.back().z() - column.front().z()) / kThickness_m - 1);
    const double by_chance = static_cast<double>(column.size() - static_cast<std::size_t>(count)) / slices;
    if (count >= least && count > by_chance + 3 * std::sqrt(by_chance))
      found.push_back({at_column, at_row, column[first + static_cast<std::size_t>(count) / 2].z(), count});
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Level& a, const Level& b) { return a.count > b.count; });
  std::vector<Level> kept;
  for (const Level& level : found)
    if (std::none_of(kept.begin(), kept.end(),
                     [&](const Level& other) { return std::abs(other.z - level.z) < 1.5 * kThickness_m; }))
      kept.push_back(level);
  levels.insert(levels.end(), kept.begin(), kept.end());
}

/// Connected groups of things on cells, by a rule of which of two neighbours belong together.
template <typename Thing, typename Joined>
std::vector<std::vector<int>> groups_of(const std::vector<Thing>& things, int columns, int rows, int reach,
                                        Joined joined) {
  Raster<std::vector<int>> at(columns, rows);
  for (std::size_t i = 0; i < things.size(); ++i)
    at.at(things[i].column, things[i].row).push_back(static_cast<int>(i));
  std::vector<bool> visited(things.size());
  std::vector<std::vector<int>> groups;
  for (std::size_t seed = 0; seed < things.size(); ++seed) {
    if (visited[seed]) continue;
    visited[seed] = true;
    std::vector<int> group = {static_cast<int>(seed)};
    for (std::size_t next = 0; next < group.size(); ++next) {
      const Thing& thing = things[static_cast<std::size_t>(group[next])];
      for (int row = std::max(0, thing.row - reach); row <= std::min(rows - 1, thing.row + reach); ++row)
        for (int column = std::max(0, thing.column - reach);
             column <= std::min(columns - 1, thing.column + reach); ++column)
          for (const int other : at.at(column, row))
            if (!visited[static_cast<std::size_t>(other)] &&
                joined(thing, things[static_cast<std::size_t>(other)])) {
              visited[static_cast<std::size_t>(other)] = true;
              group.push_back(other);
            }
    }
    groups.push_back(std::move(group));
  }
  return groups;
}

/// The points of the group's cells and of those around them at its height, with the faces below it.
FurnitureSurface surface_of(const std::vector<Level>& levels, const std::vector<int>& group,
                            const Columns& columns) {
  FurnitureSurface surface;
  surface.cell_m = columns.cell_m;
  double weighted = 0, weight = 0;
  Raster<std::uint8_t> near(columns.cells.columns, columns.cells.rows);
  for (const int i : group) {
    const Level& level = levels[static_cast<std::size_t>(i)];
    weighted += static_cast<double>(level.z) * level.count, weight += level.count;
    for (int row = std::max(0, level.row - 1); row <= std::min(near.rows - 1, level.row + 1); ++row)
      for (int column = std::max(0, level.column - 1); column <= std::min(near.columns - 1, level.column + 1);
           ++column)
        near.at(column, row) = std::max<std::uint8_t>(near.at(column, row), 1);
    near.at(level.column, level.row) = 2;
  }
  surface.top_m = weighted / weight;
  for (int row = 0; row < near.rows; ++row)
    for (int column = 0; column < near.columns; ++column) {
      const auto& column_points = columns.cells.at(column, row);
      if (near.at(column, row) == 0 || column_points.empty()) continue;
      // Beside the surface something higher may stand, whose faces are not this surface's.
      if (near.at(column, row) == 1 && column_points.back().z() > surface.top_m + kThickness_m) continue;
      for (const Eigen::Vector3f& p : column_points) {
        if (std::abs(p.z() - surface.top_m) < 0.5 * kThickness_m + 0.01)
          surface.points.push_back(p.head<2>().cast<double>());
        else if (p.z() < surface.top_m)
          surface.below.push_back(p.z());
      }
    }
  return surface;
}

/// A surface explains the faces below its border as well.
void raise_around(Raster<float>& top_m, const Level& level) {
  for (int row = std::max(0, level.row - 1); row <= std::min(top_m.rows - 1, level.row + 1); ++row)
    for (int column = std::max(0, level.column - 1); column <= std::min(top_m.columns - 1, level.column + 1);
         ++column)
      top_m.at(column, row) = std::max(top_m.at(column, row), level.z);
}

struct Face {
  int column, row;
  float top;
};

/// Columns whose points stand one above the other from knee height up, and higher than any surface there:
/// `surface_top_m` has the heights of those.
std::vector<Face> upright_faces(const Columns& columns, const Raster<float>& surface_top_m) {
  std::vector<Face> faces;
  for (int row = 0; row < columns.cells.rows; ++row)
    for (int column = 0; column < columns.cells.columns; ++column) {
      std::vector<int> bins(26);
      for (const Eigen::Vector3f& p : columns.cells.at(column, row))
        ++bins[std::min<std::size_t>(25, static_cast<std::size_t>(p.z() / kBin_m))];
      int filled = 0, top = 0;
      for (int bin = 2; bin < 25; ++bin)
        if (bins[static_cast<std::size_t>(bin)] > 0) ++filled, top = bin;
      const auto& held = columns.cells.at(column, row);
      const bool higher = !held.empty() && held.back().z() > surface_top_m.at(column, row) + 0.15F;
      if (higher && top >= kLeastFaceBins && filled >= 0.55 * (top - 1))
        faces.push_back({column, row, held.back().z()});
    }
  return faces;
}

FurnitureSurface body_of(const std::vector<Face>& faces, const std::vector<int>& group,
                         const Columns& columns) {
  FurnitureSurface body;
  body.cell_m = columns.cell_m;
  body.top_seen = false;
  std::vector<float> tops;
  for (const int i : group) {
    const Face& face = faces[static_cast<std::size_t>(i)];
    tops.push_back(face.top);
    for (const Eigen::Vector3f& p : columns.cells.at(face.column, face.row)) {
      body.points.push_back(p.head<2>().cast<double>());
      body.below.push_back(p.z());
    }
  }
  const auto nth = tops.begin() + static_cast<std::ptrdiff_t>(0.7 * static_cast<double>(tops.size() - 1));
  std::nth_element(tops.begin(), nth, tops.end());
  body.top_m = *nth;
  return body;
}

}  // namespace

std::vector<FurnitureSurface> furniture_surfaces(const RegisteredCloud& cloud, const RoomObservation& room,
                                                 const FurnitureOptions& options) {
  Polygon outline = room.outline;
  for (Vec2& p : outline) p -= cloud.origin_m.head<2>();
  const double density = floor_density(cloud, room, outline);
  const double cell_m = std::clamp(2.5 / std::sqrt(density), 0.05, 0.12);
  const Columns columns = columns_of(cloud, room, outline, cell_m, options);
  const int least = std::max(3, static_cast<int>(std::lround(0.35 * density * cell_m * cell_m)));

  std::vector<Level> levels;
  for (int row = 0; row < columns.cells.rows; ++row)
    for (int column = 0; column < columns.cells.columns; ++column)
      add_levels(columns.cells.at(column, row), column, row, least, levels);
  std::erase_if(levels, [&](const Level& level) { return level.z < options.lowest_m; });
  std::vector<FurnitureSurface> found;
  Raster<float> surface_top_m(columns.cells.columns, columns.cells.rows);
  const auto same_height = [](const Level& a, const Level& b) { return std::abs(a.z - b.z) < kStep_m; };
  for (const auto& group : groups_of(levels, columns.cells.columns, columns.cells.rows, 1, same_height)) {
    const double area = static_cast<double>(group.size()) * cell_m * cell_m;
    if (group.size() < 2 || area < 0.4 * options.least_area_m2 ||
        area > options.most_floor_share * signed_area(outline))
      continue;
    found.push_back(surface_of(levels, group, columns));
    for (const int i : group) raise_around(surface_top_m, levels[static_cast<std::size_t>(i)]);
  }

  const std::vector<Face> faces = upright_faces(columns, surface_top_m);
  const auto any = [](const Face&, const Face&) { return true; };
  for (const auto& group : groups_of(faces, columns.cells.columns, columns.cells.rows, 2, any))
    if (group.size() >= 4) found.push_back(body_of(faces, group, columns));
  return found;
}

}  // namespace gramap
