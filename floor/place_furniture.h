// Furniture put into its room: as an upright box in the plan, moved off the walls it was measured into.
#pragma once

#include <vector>

#include "floor/model.h"

namespace gramap {

/// The room's furniture; what does not fit into the room goes to `set_aside`, with the reason.
std::vector<ModelFurniture> place_furniture(const ModelRoom& room, std::vector<SetAsideInput>& set_aside);

}  // namespace gramap
