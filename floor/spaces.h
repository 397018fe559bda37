// Spaces and reference lines where the floor file leaves them out: what is left of the outline beside the
// hallways.
#pragma once

#include <string>
#include <vector>

#include "floor/ground_truth.h"

namespace gramap {

/// Fills `floor.spaces` from outline, courtyards, hallways and fixed rooms: every stretch of a hallway's side
/// gets the area behind it, up to the outer wall, a fixed room or the middle between it and the next hallway.
/// A corner region that two hallways could serve goes to one. Returns one sentence for every such decision,
/// for people. Throws InputError when there is no outline or no hallway, or nothing is left beside them.
/// `inner_wall_m` and `outer_wall_m` separate the spaces from hallways, fixed rooms and the outside.
std::vector<std::string> derive_spaces(FloorGroundTruth& floor, double inner_wall_m, double outer_wall_m);

/// Checks what can be known to be wrong before a fit: a self-crossing or clockwise-and-empty outline,
/// hallways or fixed rooms that overlap, touch the outline or lie outside it, a reference line of no length
/// or one whose space is not on its left, coordinates in degrees. Throws InputError with `file` as its place.
void check_floor(const FloorGroundTruth& floor, const std::string& file);

}  // namespace gramap
