// A row whose rooms are known: the space that it fills, and what a scan of each of its rooms would say.
#pragma once

#include <vector>

#include "grammar/learn.h"
#include "grammar/space.h"

namespace gramap {

/// The row's space, as deep as its deepest room, without anything seen of it.
SpaceProblem bare_problem(const KnownRow& row);

/// The row's rooms in their order: widths to `width_sigma_m`, places along the line to `place_sigma_m`, types
/// as sure as `type_confidence` (0: nothing is said of them). `wall_m`: the wall between neighbours.
std::vector<RoomEvidence> row_evidence(const KnownRow& row, double wall_m, double width_sigma_m,
                                       double place_sigma_m, double type_confidence = 0);

}  // namespace gramap
