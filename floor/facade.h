// Where a floor has its façades: walls with the outside, or a courtyard, behind them.
#pragma once

#include "floor/ground_truth.h"

namespace gramap {

/// Whether the outside, or a courtyard, lies `behind_m` behind the middle of a clear wall face from `a` to
/// `b` (counter-clockwise around its room). True where the floor has no outline: nothing else is known.
bool faces_outside(const FloorGroundTruth& floor, double behind_m, const Vec2& a, const Vec2& b);

/// Whether some part of the wall opposite the hallway faces the outside. Walls may be thicker than
/// `outer_wall_m` says: what is asked for is that no room has place behind it.
bool has_facade(const FloorGroundTruth& floor, double outer_wall_m, const Space& space);

}  // namespace gramap
