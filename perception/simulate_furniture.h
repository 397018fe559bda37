// Shapes of simulated furniture.
#pragma once

#include "perception/simulate_scene.h"

namespace gramap {

/// A table as a top on four legs, a chair as a seat on legs with a back when it is taller than a stool,
/// anything else as a closed body. `floor_m` is the room's floor.
void add_furniture(std::vector<Face>& faces, const BuildingFurniture& piece, double floor_m);

}  // namespace gramap
