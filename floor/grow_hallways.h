// Hallways from rules: the rule file's L-system grows a network into the outline of a floor whose hallways
// nobody gave.
//
// The axiom begins at one end (the seed says which) of the longest strip of the outline that is broad enough
// for the hallway and rooms of the least depth on both sides, in its middle; where nothing is that broad, on
// one side of it. From then on every step is bent to its surroundings (local constraints, Parish and Müller
// 2001):
// - A straight ends before an outer wall comes nearer than the least depth sideways, or another hallway
// nearer than two
//   rows of rooms sideways, one row ahead. Where it would leave less than one row of rooms, it goes on to the
//   end. It is at least half a metre long.
// - A branch is moved along its hallway to the middle of the wing that it leads into, where only one hallway
// fits in
//   there; else to the nearest place that leaves room for rooms. When it is the last thing that its hallway
//   does, the hallway ends in that corner.
// - A production does not compete where its first step has no place. A symbol without a production that
// applies, and a
//   straight without any way to go, end their hallway.
//
// So hallways never cross or touch but where one branches off another: the network is a tree, and its outline
// one simple polygon. All runs are parallel or perpendicular to the outline's longest edge.
#pragma once

#include <cstdint>

#include "floor/ground_truth.h"
#include "grammar/rules.h"

namespace gramap {

/// The network's outline, in plan coordinates, counter-clockwise. The same seed grows the same network.
/// Throws InputError when the outline is nowhere broad enough.
Polygon grow_hallways(const FloorGroundTruth& floor, const HallwayGrammar& grammar, double inner_wall_m,
                      double outer_wall_m, std::uint64_t seed);

}  // namespace gramap
