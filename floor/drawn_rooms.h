// The rooms that a floor file draws, taken as if they had been scanned: so a fitted floor's GeoJSON or a
// survey's plan can be fitted again.
#pragma once

#include <vector>

#include "floor/ground_truth.h"
#include "grammar/space.h"

namespace gramap {

/// Adds the rooms along each space's reference line to its problem: width to half a centimetre, place to a
/// centimetre, and its type where the rules know it. Rooms that anything is known of already, by their id,
/// and spaces that are drawn in parts only are left as they are. `problems` are in the order of floor.spaces.
void observe_drawn_rooms(const FloorGroundTruth& floor, const FloorTruth& drawn, const RuleSet& rules,
                         std::vector<SpaceProblem>& problems);

}  // namespace gramap
