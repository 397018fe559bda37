// Usual furniture of a room that nobody scanned: a plausible place for each piece, so that the room does not
// look empty.
#pragma once

#include <string>
#include <vector>

#include "floor/fitted_floor.h"

namespace gramap {

/// Pieces by name ("table", "chair", anything else is a cupboard-like "other"), in their usual sizes: tables
/// in rows from the window side, a chair at each, further chairs and other things along the wall; what finds
/// no place without touching another is left out. `along` is the direction of the hallway. Origin `derived`.
std::vector<FittedFurniture> derived_furniture(const FittedRoom& room, const Vec2& along,
                                               const std::vector<std::string>& names);

}  // namespace gramap
