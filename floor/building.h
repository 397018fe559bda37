// A floor's truth as the building that scans are simulated in.
#pragma once

#include "floor/ground_truth.h"
#include "perception/simulate.h"

namespace gramap {

/// The truth's rooms with their openings and furniture, in the truth's order. Heights become heights above
/// the room's floor. Throws InputError when there is no room, or an opening or a piece of
/// furniture that no scan could show: of no room, or of no height. `file` is where the truth is from, for
/// messages.
Building building_of(const FloorTruth& truth, const std::string& file = "");

}  // namespace gramap
