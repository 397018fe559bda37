// The grid of wall positions along a space, in gross coordinates: a room takes its clear width and the wall
// after it, the space takes its clear length and one wall more, so every wall's thickness and the space's
// length are exact on the grid whatever its step.
#pragma once

#include <algorithm>
#include <cmath>

namespace gramap {

struct Grid {
  int cells = 0;      ///< gross length of the space in steps
  double step_m = 0;  ///< gross length / cells
  double wall_m = 0;  ///< thickness of inner walls

  /// Clear width of a room that takes `k` cells.
  double width_m(int k) const { return k * step_m - wall_m; }
  /// Position along the reference line of the room that starts at cell `n`.
  double position_m(int n) const { return n * step_m; }
  /// Clear length that is left at cell `n`; negative (minus a wall) when the space is full.
  double remaining_m(int n) const { return (cells - n) * step_m - wall_m; }
};

/// The grid of a space of clear length `length_m` whose step is nearest to `wanted_step_m`.
inline Grid make_grid(double length_m, double wall_m, double wanted_step_m) {
  const double gross_m = length_m + wall_m;
  const int cells = std::max(1, static_cast<int>(std::lround(gross_m / wanted_step_m)));
  return {cells, gross_m / cells, wall_m};
}

}  // namespace gramap
