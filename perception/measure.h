// The room's planes measured on all their points and all scans together, and the width, depth and height that
// follow.
#pragma once

#include "perception/adjust.h"
#include "perception/observation.h"
#include "perception/outline.h"

namespace gramap {

/// Floor, ceiling and the outline's lines, adjusted together with the scans' poses. Moves the lines, the
/// outline's corners, the storey's levels and the cloud's points to where they fit best.
struct MeasuredRoom {
  std::vector<AdjustedPlane> planes;  ///< floor, ceiling, then the planes of the outline's lines
  std::vector<int> plane_of_edge;     ///< into planes
  Adjustment adjustment;

  /// Standard deviation of the distance between two planes that face each other.
  double distance_sigma_m(int a, int b) const;
};
MeasuredRoom measure_room(RoomOutline& outline, std::vector<WallLine>& lines, Storey& storey,
                          RegisteredCloud& cloud, double min_edge_m);

/// Fills axis, width, depth and height with their deviations of an observation whose walls are known.
void measure_extent(RoomObservation& observation, const MeasuredRoom& measured);

}  // namespace gramap
