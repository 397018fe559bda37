// The forests that ship with gramap, made by `gramap train` (see models/README.md) and built into the
// command.
#pragma once

#include "perception/forest.h"

namespace gramap {

/// Tells doors and windows from other gaps in a wall.
const Forest& shipped_openings_forest();

/// Tells tables, chairs and other furniture apart.
const Forest& shipped_furniture_forest();

}  // namespace gramap
