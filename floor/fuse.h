// Several scans of one room, by one person or by many, become one piece of evidence.
#pragma once

#include <vector>

#include "floor/fitted_floor.h"
#include "grammar/space.h"

namespace gramap {

/// Evidence of the same room (same `id`) on one space is fused with inverse-variance weights. Of three or
/// more that disagree, those outside the largest agreeing group are set aside, said in `set_aside`; of two
/// that disagree both stay, and the fit decides which one it believes. Two agree when they differ by less
/// than 3 standard deviations of their difference, or 2 cm.
std::vector<RoomEvidence> fused(const std::vector<RoomEvidence>& evidence,
                                std::vector<SetAsideInput>& set_aside);

}  // namespace gramap
