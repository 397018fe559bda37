// Several fitted floors made one building, lowest first.
#pragma once

#include <vector>

#include "floor/model.h"

namespace gramap {

/// Builds each floor; the slab between two storeys fills the height that their elevations leave. Throws
/// InputError when two floors have one elevation, or one reaches into the next.
std::vector<FloorModel> build_storeys(std::vector<FittedFloor> floors);

}  // namespace gramap
