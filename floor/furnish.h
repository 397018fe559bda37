// Doors, windows and furniture of the fitted floor: what was seen goes to the fitted room it belongs to; what
// nobody saw is derived from the habits of the room's type, and says so.
#pragma once

#include <vector>

#include "floor/fitted_floor.h"
#include "grammar/rules.h"
#include "grammar/space.h"
#include "perception/observation.h"

namespace gramap {

/// An observation's outline is laid onto its fitted room (of several ways round, the one whose doors lie on
/// the hallway's side), and its openings and furniture with it. Rooms without an observation get the door
/// that was seen from the hallway, else the one their type has, and their type's windows (on walls to the
/// outside) and usual furniture; rooms of a unit that do not lie on the hallway, or
/// whose type has no door there, are entered from inside the unit. A scanned room without any door gets one
/// as well: nobody climbs in. `problems` are those the floor was fitted from.
void furnish(FittedFloor& fitted, const RuleSet& rules, const std::vector<SpaceProblem>& problems,
             const std::vector<RoomObservation>& observations);

}  // namespace gramap
