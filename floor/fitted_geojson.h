// The fitted floor as GeoJSON of the floor file's own kinds: to be learned from, evaluated, edited, fitted
// again.
#pragma once

#include <string>

#include "floor/fitted_floor.h"

namespace gramap {

/// The fitted rooms, doors, windows and furniture as the truth kinds.
FloorTruth truth_of(const FittedFloor& floor);

/// Outline, hallways, fixed rooms, spaces and reference lines as given, and the fitted rooms, doors, windows
/// and furniture as the truth kinds.
std::string to_geojson(const FittedFloor& floor);

}  // namespace gramap
