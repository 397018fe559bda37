// What a floor file may leave out: hallways and spaces.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "floor/ground_truth.h"
#include "grammar/rules.h"

namespace gramap {

/// Fills in what the floor file leaves out: hallways, when it gives neither hallways nor spaces and the rules
/// say how they grow; then spaces beside the hallways. A derived space that no derivation fills is left
/// solid. Returns one sentence for every decision, for people. Throws InputError as grow_hallways and
/// derive_spaces do.
std::vector<std::string> complete_floor(FloorGroundTruth& floor, const RuleSet& rules, std::uint64_t seed);

}  // namespace gramap
