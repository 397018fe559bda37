// What the scanners saw of the plan: a raster of the places that rays passed through without crossing a wall.
#pragma once

#include <cstdint>
#include <vector>

#include "perception/wall_lines.h"

namespace gramap {

struct FreeSpace {
  Vec2 corner_m = Vec2::Zero();  ///< of the raster, in the cloud's frame
  double pixel_m = 0.05;
  int columns = 0, rows = 0;
  std::vector<std::uint8_t> seen;

  Vec2 centre(int column, int row) const { return corner_m + pixel_m * Vec2(column + 0.5, row + 0.5); }
};

/// Walks rays from each scanner to its points. A ray ends where it crosses a line at a place that is wall
/// right up to the ceiling: what is seen through a door, under its lintel, is another room.
FreeSpace free_space(const RegisteredCloud& cloud, const std::vector<WallLine>& lines, const Storey& storey);

}  // namespace gramap
