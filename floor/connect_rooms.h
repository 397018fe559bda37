// Doors for derived rooms that no other door leads to.
#pragma once

#include "floor/fitted_floor.h"

namespace gramap {

/// Rules say which doors lead to the hallway; rooms behind other rooms, beyond a hallway's end or of no known
/// type have none. Each derived room that cannot be reached gets a door in a wall that it shares with a place
/// that can be: a room of the same unit, before all the one that has a door to the hallway, else a hallway,
/// else any room; the longest such wall. Derived doors that face the end of a wall, or nothing but wall, move
/// beside it first. Rooms that were scanned or are given stay as they are, and so do rooms without such a
/// wall. Doors lead through walls of up to twice the inner walls' thickness.
void connect_rooms(FittedFloor& fitted);

}  // namespace gramap
