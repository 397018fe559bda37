// A building's surfaces as flat faces: walls with their openings cut, reveals, leaves, frames, blinds,
// furniture.
#pragma once

#include "perception/raycast.h"
#include "perception/simulate.h"

namespace gramap {

/// All faces that rays from inside the rooms can hit. Panes are transparent: they have none. The state of
/// every door and blind comes from the seed and its place alone, so it is the same from both sides of the
/// wall.
std::vector<Face> building_faces(const Building& building, const SimulateOptions& options);

/// An upright prism over `outline` between two heights: its sides, its top, and its underside.
void add_prism(std::vector<Face>& faces, const Polygon& outline, double bottom_m, double top_m);

}  // namespace gramap
