// Level surfaces and upright bodies inside a room, as connected sets of points.
#pragma once

#include <vector>

#include "perception/furniture.h"

namespace gramap {

struct FurnitureSurface {
  std::vector<Vec2> points;  ///< in the plan, cloud's frame
  std::vector<float> below;  ///< of upright faces under the top, in the same place: heights over the floor
  double top_m = 0;          ///< above the floor
  bool top_seen = true;      ///< false: a body known by its upright faces only
  double cell_m = 0.1;
};

/// Points inside of the outline, off its walls, gathered by cells of the plan: cells where many points lie at
/// one height join their neighbours of that height to a surface; cells whose points stand one above the other
/// up to more than the surfaces around join to a body.
std::vector<FurnitureSurface> furniture_surfaces(const RegisteredCloud& cloud, const RoomObservation& room,
                                                 const FurnitureOptions& options);

}  // namespace gramap
