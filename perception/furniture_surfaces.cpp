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
constexpr double kFilledShare = 0.55;  // of a face's bins hold points
constexpr double kBodyStep_m = 0.1;    // neighbouring faces of one body differ by less
constexpr double kLeastShare = 0.35;   // of the floor's density is on a level surface
constexpr double kEven_m = 0.03;

struct Level {
  int column, row;
  float z;
  int count;
};

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

/// Evens the points out and takes them; how dense the cloud is must not count where a thing ends.
class EvenPoints {
 public:
  explicit EvenPoints(const FurnitureCells& cells)
      : cells_(cells),
        taken_(static_cast<int>(cells.points.columns * cells.cell_m / kEven_m) + 1,
               static_cast<int>(cells.points.rows * cells.cell_m / kEven_m) + 1) {}
  void add(const Eigen::Vector3f& p) {
    const Vec2 plan = p.head<2>().cast<double>(), at = (plan - cells_.low) / kEven_m;
    auto& taken = taken_.at(static_cast<int>(at.x()), static_cast<int>(at.y()));
    ++measured_;
    if (taken == 0) points_.push_back(plan);
    taken = 1;
  }
  void give(FurnitureSurface& surface) {
    surface.weight = static_cast<double>(measured_) / std::max(1.0, static_cast<double>(points_.size()));
    surface.points = std::move(points_);
  }

 private:
  const FurnitureCells& cells_;
  Raster<std::uint8_t> taken_;
  std::vector<Vec2> points_;
  int measured_ = 0;
};

/// The points of the group's cells and of those around them at its height, with the faces below it.
FurnitureSurface surface_of(const std::vector<Level>& levels, const std::vector<int>& group,
                            const FurnitureCells& cells) {
  FurnitureSurface surface;
  double weighted = 0, weight = 0;
  Raster<std::uint8_t> near(cells.points.columns, cells.points.rows);
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
  EvenPoints points(cells);
  for (int row = 0; row < near.rows; ++row)
    for (int column = 0; column < near.columns; ++column) {
      const auto& column_points = cells.points.at(column, row);
      if (near.at(column, row) == 0 || column_points.empty()) continue;
      // Beside the surface something higher may stand, whose faces are not this surface's.
      if (near.at(column, row) == 1 && column_points.back().z() > surface.top_m + kThickness_m) continue;
      for (const Eigen::Vector3f& p : column_points) {
        if (std::abs(p.z() - surface.top_m) < 0.5 * kThickness_m + 0.01)
          points.add(p);
        else if (p.z() < surface.top_m)
          ++surface.below;
      }
    }
  points.give(surface);
  return surface;
}

struct Face {
  int column, row;
  float top;
};

/// Columns whose points stand one above the other from knee height up.
std::vector<Face> upright_faces(const FurnitureCells& cells) {
  std::vector<Face> faces;
  for (int row = 0; row < cells.points.rows; ++row)
    for (int column = 0; column < cells.points.columns; ++column) {
      const auto& held = cells.points.at(column, row);
      std::vector<int> bins(26);
      for (const Eigen::Vector3f& p : held)
        ++bins[std::min<std::size_t>(25, static_cast<std::size_t>(p.z() / kBin_m))];
      int filled = 0, top = 0;
      for (int bin = 2; bin < 25; ++bin)
        if (bins[static_cast<std::size_t>(bin)] > 0) ++filled, top = bin;
      if (top >= kLeastFaceBins && filled >= kFilledShare * (top - 1))
        faces.push_back({column, row, held.back().z()});
    }
  return faces;
}

FurnitureSurface body_of(const std::vector<Face>& faces, const std::vector<int>& group,
                         const FurnitureCells& cells) {
  FurnitureSurface body;
  body.top_seen = false;
  std::vector<float> tops;
  EvenPoints points(cells);
  for (const int i : group) {
    const Face& face = faces[static_cast<std::size_t>(i)];
    tops.push_back(face.top);
    for (const Eigen::Vector3f& p : cells.points.at(face.column, face.row)) points.add(p), ++body.below;
  }
  const auto nth = tops.begin() + static_cast<std::ptrdiff_t>(0.7 * static_cast<double>(tops.size() - 1));
  std::nth_element(tops.begin(), nth, tops.end());
  body.top_m = *nth;
  points.give(body);
  return body;
}

}  // namespace

std::vector<FurnitureSurface> furniture_surfaces(const FurnitureCells& cells,
                                                 const FurnitureOptions& options) {
  const int columns = cells.points.columns, rows = cells.points.rows;
  const double cell_m2 = cells.cell_m * cells.cell_m, room_m2 = std::abs(signed_area(cells.outline));
  const int least = std::max(3, static_cast<int>(std::lround(kLeastShare * cells.floor_density * cell_m2)));
  std::vector<Level> levels;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column)
      add_levels(cells.points.at(column, row), column, row, least, levels);
  std::erase_if(levels, [&](const Level& level) { return level.z < options.lowest_m; });
  std::vector<FurnitureSurface> found;
  const auto same_height = [](const Level& a, const Level& b) { return std::abs(a.z - b.z) < kStep_m; };
  for (const auto& group : groups_of(levels, columns, rows, 1, same_height)) {
    const double area = static_cast<double>(group.size()) * cell_m2;
    if (group.size() < 2 || area < 0.4 * options.least_area_m2 || area > options.most_floor_share * room_m2)
      continue;
    found.push_back(surface_of(levels, group, cells));
  }
  const std::vector<Face> faces = upright_faces(cells);
  const auto as_high = [](const Face& a, const Face& b) { return std::abs(a.top - b.top) < kBodyStep_m; };
  for (const auto& group : groups_of(faces, columns, rows, 2, as_high))
    if (group.size() >= 4) found.push_back(body_of(faces, group, cells));
  return found;
}

}  // namespace gramap
