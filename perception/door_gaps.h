// Doors as gaps in a wall: where the scans looked through the wall's plane between floor and lintel height.
// Quick, needs no training, and finds open or recessed doors only; the openings chain is the thorough way.
#pragma once

#include <vector>

#include "perception/observation.h"
#include "perception/scan.h"

namespace gramap {

struct DoorGapOptions {
  double cell_m = 0.05;        ///< side of a cell of the wall's raster
  double beyond_m = 0.12;      ///< a point this far behind the wall's plane was seen through it
  double on_wall_m = 0.08;     ///< a point this near the plane is on the wall
  double least_width_m = 0.6;  ///< narrower gaps are no doors
  double most_width_m = 2.6;   ///< nor are wider ones
  double head_m = 1.9;         ///< a door is open at least up to here, above the floor
  double skirting_m = 0.15;    ///< below this, points of the floor itself lie near the plane
  double foot_m = 0.6;         ///< and down to below here, where a window has its parapet
};

/// Gaps in the walls of a perceived room, in the order of its walls. Confidence is the share of the gap's
/// cells seen through.
std::vector<OpeningObservation> find_door_gaps(const RegisteredCloud& cloud, const RoomObservation& room,
                                               const DoorGapOptions& options = {});

}  // namespace gramap
