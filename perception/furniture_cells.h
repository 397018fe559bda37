// A room's points by cells of the plan, for what stands on its floor.
#pragma once

#include <vector>

#include "perception/furniture.h"
#include "perception/raster.h"

namespace gramap {

/// Points off the walls, over the floor and under the ceiling, by cells of the plan. Of a cloud with more
/// points than it takes to see furniture, evenly some.
struct FurnitureCells {
  Polygon outline;  ///< of the room, in the cloud's frame
  Vec2 low = Vec2::Zero();
  double cell_m = 0.1;                          ///< holds about six points of the floor
  double floor_density = 1;                     ///< points per m² of the floor
  Raster<std::vector<Eigen::Vector3f>> points;  ///< in the plan, and height over the floor; by height
  Raster<int> floor;                            ///< points on the floor itself
  Raster<std::uint8_t> in_room;                 ///< 1: the cell's middle is inside the outline

  Vec2 centre(int column, int row) const { return low + cell_m * Vec2(column + 0.5, row + 0.5); }
};

FurnitureCells furniture_cells(const RegisteredCloud& cloud, const RoomObservation& room,
                               const FurnitureOptions& options);

}  // namespace gramap
