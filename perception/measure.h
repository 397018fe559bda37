// The outline's walls measured anew on all their points, and the room's width, depth and height with their
// deviations.
#pragma once

#include "perception/observation.h"
#include "perception/outline.h"

namespace gramap {

/// Fits each line of the outline to the points along its edges; moves the outline's corners with them.
struct MeasuredWall {
  double sigma_m = 0;
  double rms_m = 0;
  int support = 0;
};
std::vector<MeasuredWall> measure_walls(RoomOutline& outline, std::vector<WallLine>& lines,
                                        const RegisteredCloud& cloud, const Storey& storey);

/// Fills width, depth and axis of an observation whose outline and walls are known.
void measure_extent(RoomObservation& observation);

}  // namespace gramap
