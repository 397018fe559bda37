// Doors and windows that nobody saw: where the rules say that rooms of a type have theirs.
#pragma once

#include "floor/fitted_floor.h"
#include "grammar/rules.h"

namespace gramap {

/// Gives every room of a space that has no door (no window) the door (the windows) of its type's habit,
/// origin `derived`: the door at the likeliest of its places on the hallway wall, the windows evenly along
/// the far side. Whether the far side is a façade is for the model to see: derived windows in inner walls are
/// left out there.
void add_usual_openings(FittedFloor& floor, const RuleSet& rules);

}  // namespace gramap
