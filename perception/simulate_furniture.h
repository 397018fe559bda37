// Shapes of simulated furniture.
#pragma once

#include "perception/simulate_scene.h"

namespace gramap {

/// The faces of a piece as BuildingFurniture says. `floor_m` is the room's floor.
void add_furniture(std::vector<Face>& faces, const BuildingFurniture& piece, double floor_m);

}  // namespace gramap
