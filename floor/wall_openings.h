// Doors and windows put into their walls: each is assigned to one wall, clipped to what both faces of that
// wall have in common, and told apart from the same opening seen from the other side.
#pragma once

#include <vector>

#include "floor/model.h"
#include "geometry/partition.h"

namespace gramap {

struct PlacedOpenings {
  std::vector<ModelOpening> openings;    ///< without footprint; `fitted` as clipped
  std::vector<PlanOpening> cuts;         ///< in the same order
  std::vector<SetAsideInput> set_aside;  ///< what has no place, and why
};

/// `plan` is the partition without openings; `rooms` are in its order.
PlacedOpenings place_openings(const std::vector<ModelRoom>& rooms, const Partition& plan);

}  // namespace gramap
