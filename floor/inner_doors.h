// Doors within a unit: a bath is entered from its vestibule, a bedroom through it.
#pragma once

#include "floor/fitted_floor.h"
#include "grammar/rules.h"

namespace gramap {

/// Gives every room that has no door, but stands in one unit with a room that has, a door to the room of its
/// unit that is nearest to the hallway, counted in doors. Rooms are of one unit
/// when they stand one behind the other, seen from the hallway, or beside one that does. The door is in the
/// middle of the wall that the two share, as large as the room's type says.
void add_inner_doors(FittedFloor& fitted, const RuleSet& rules);

}  // namespace gramap
