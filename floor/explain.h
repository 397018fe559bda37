// Why a room of a fitted floor is what it is: its rules, what was observed, and what the fit would have taken
// instead.
#pragma once

#include <string>

#include "floor/fitted_floor.h"

namespace gramap {

/// The explanation as text. Throws InputError when the floor has no such room, naming the nearest names.
std::string explain_room(const FittedFloor& floor, const std::string& id);

}  // namespace gramap
