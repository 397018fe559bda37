// The table of rooms that a fit prints: what was extracted, what was derived, how sure it is.
#pragma once

#include <string>

#include "floor/fitted_floor.h"

namespace gramap {

/// One line a room in the order of the spaces, then hallways and fixed rooms, then what was set aside. Widths
/// in metres.
std::string room_table(const FittedFloor& floor);

}  // namespace gramap
