#include "perception/door_gaps.h"

#include <algorithm>
#include <cmath>

namespace gramap {
namespace {

enum Label : unsigned char { occluded, occupied, empty };

/// A wall's raster of labels: columns along the wall, rows up from the floor.
struct Raster {
  int columns = 0, rows = 0;
  std::vector<Label> cells;
  Label& at(int column, int row) { return cells[static_cast<std::size_t>(row) * columns + column]; }
};

Raster label_wall(const RegisteredCloud& cloud, const RoomObservation& room, const WallObservation& wall,
                  const DoorGapOptions& options) {
  const Vec2 along = (wall.b - wall.a).normalized(), inward(-along.y(), along.x());
  const double length = (wall.b - wall.a).norm();
  Raster raster;
  raster.columns = std::max(1, static_cast<int>(std::ceil(length / options.cell_m)));
  raster.rows = std::max(1, static_cast<int>(std::ceil(options.head_m / options.cell_m)));
  raster.cells.assign(static_cast<std::size_t>(raster.columns) * raster.rows, occluded);

  const auto cell = [&](double s, double z) -> Label* {
    const int column = static_cast<int>(std::floor(s / options.cell_m)),
              row = static_cast<int>(std::floor(z / options.cell_m));
    return column < 0 || column >= raster.columns || row < 0 || row >= raster.rows ? nullptr
                                                                                   : &raster.at(column, row);
  };
  // Empty outweighs occupied: door frames and leaves give hits near the plane in cells that were looked
  // through as well.
  for (const RegisteredCloud::Part& part : cloud.parts) {
    const Vec3 scanner = part.scanner_m + cloud.origin_m;
    const double from = (scanner.head<2>() - wall.a).dot(inward);
    if (from <= 0) continue;
    for (std::size_t i = part.begin; i < part.end; ++i) {
      const Vec3 point = cloud.points_m[i].cast<double>() + cloud.origin_m;
      const double to = (point.head<2>() - wall.a).dot(inward);
      if (std::abs(to) <= options.on_wall_m) {
        Label* label = cell((point.head<2>() - wall.a).dot(along), point.z() - room.floor_z_m);
        if (label && *label == occluded) *label = occupied;
      } else if (to < -options.beyond_m) {
        const Vec3 crossing = scanner + (point - scanner) * (from / (from - to));
        Label* label = cell((crossing.head<2>() - wall.a).dot(along), crossing.z() - room.floor_z_m);
        if (label) *label = empty;
      }
    }
  }
  return raster;
}

}  // namespace

std::vector<OpeningObservation> find_door_gaps(const RegisteredCloud& cloud, const RoomObservation& room,
                                               const DoorGapOptions& options) {
  std::vector<OpeningObservation> doors;
  for (std::size_t index = 0; index < room.walls.size(); ++index) {
    const WallObservation& wall = room.walls[index];
    Raster raster = label_wall(cloud, room, wall, options);
    const int foot_rows = std::max(1, static_cast<int>(options.foot_m / options.cell_m));
    const int skirting_rows = static_cast<int>(std::ceil(options.skirting_m / options.cell_m));
    // A column belongs to a gap when most of what was seen of it was seen through, near the floor too.
    std::vector<double> open_share(static_cast<std::size_t>(raster.columns), 0.0);
    for (int column = 0; column < raster.columns; ++column) {
      int through = 0, hit = 0, through_foot = 0, hit_foot = 0;
      for (int row = skirting_rows; row < raster.rows; ++row) {
        const Label label = raster.at(column, row);
        through += label == empty, hit += label == occupied;
        if (row < foot_rows) through_foot += label == empty, hit_foot += label == occupied;
      }
      const bool foot_open = through_foot >= hit_foot;
      if (through > hit && foot_open)
        open_share[static_cast<std::size_t>(column)] = static_cast<double>(through) / (through + hit);
    }
    for (int begin = 0; begin < raster.columns;) {
      if (open_share[static_cast<std::size_t>(begin)] <= 0) {
        ++begin;
        continue;
      }
      int end = begin;
      double share = 0;
      // One closed column, a shadow or a stray hit, does not end a gap.
      while (end < raster.columns &&
             (open_share[static_cast<std::size_t>(end)] > 0 ||
              (end + 1 < raster.columns && open_share[static_cast<std::size_t>(end) + 1] > 0)))
        share += open_share[static_cast<std::size_t>(end++)];
      const double width = (end - begin) * options.cell_m;
      if (width >= options.least_width_m && width <= options.most_width_m) {
        OpeningObservation door;
        door.kind = "door";
        door.wall = static_cast<int>(index);
        door.start_m = begin * options.cell_m;
        door.width_m = width;
        door.head_m = options.head_m;
        door.confidence = share / (end - begin);
        doors.push_back(door);
      }
      begin = end;
    }
  }
  return doors;
}

}  // namespace gramap
