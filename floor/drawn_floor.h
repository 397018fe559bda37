// A floor made up from rules alone: to simulate scans of, and to try a grammar without any data.
#pragma once

#include <cstdint>

#include "floor/fit_floor.h"

namespace gramap {

/// A straight hallway with a space on either side, in a building that holds nothing else.
struct PlainFloorOptions {
  double length_m = 24;  ///< clear, of hallway and spaces
  double depth_m = 5;    ///< clear, of the spaces
  double hallway_m = 2;  ///< clear width of the hallway
};
FloorGroundTruth plain_floor(const RuleSet& rules, const PlainFloorOptions& options = {});

/// A layout for every space of the floor, drawn from the rules' distribution. Same seed, same floor. Throws
/// InputError for a floor without spaces, and for a space that no derivation fills.
FittedFloor drawn_floor(const FloorGroundTruth& floor, const RuleSet& rules, std::uint64_t seed);

}  // namespace gramap
