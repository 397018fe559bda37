// Level surfaces and upright bodies inside a room, as connected sets of points.
#pragma once

#include <vector>

#include "perception/furniture_cells.h"

namespace gramap {

struct FurnitureSurface {
  std::vector<Vec2> points;  ///< in the plan, cloud's frame, evened out: at most one on every few centimetres
  double weight = 1;         ///< measured points for each of these
  int below = 0;             ///< points of upright faces under the top, in the same place
  double top_m = 0;          ///< above the floor
  bool top_seen = true;      ///< false: a body known by its upright faces only
};

/// Cells of the plan where many points lie at one height join their neighbours of that height to a surface;
/// cells whose points stand one above the other join their neighbours of that height to a body. A thing whose
/// top and front are both seen is there twice; the forest says which is the better one.
std::vector<FurnitureSurface> furniture_surfaces(const FurnitureCells& cells,
                                                 const FurnitureOptions& options);

}  // namespace gramap
