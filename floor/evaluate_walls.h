// Distances between two sets of walls, sampled along their length.
#pragma once

#include <vector>

#include "geometry/types.h"

namespace gramap {

/// Distances of samples along some walls to the nearest nearly parallel wall (15°) of others, ascending.
struct WallDistances {
  std::vector<double> sorted_m;
  double share_within(double buffer_m) const;   ///< 0 to 1; 1 when there are no walls at all
  double median_within(double buffer_m) const;  ///< median of the distances within the buffer
};

/// From the border of every ring in `walls`, sampled every `step_m`, to the borders in `others`.
WallDistances wall_distances(const std::vector<Polygon>& walls, const std::vector<Polygon>& others,
                             double step_m = 0.02);

}  // namespace gramap
