// From the coordinates that a GeoJSON file holds, metres or degrees, to the plan's: the one place that
// decides which of the two they are, and whether a building can be so large.
#pragma once

#include "floor/geojson.h"

namespace gramap {

/// Checks the file's coordinates and projects those that are WGS84 about `about`, the file's own origin, or
/// its centre, which becomes the file's origin. With GeoFaults::keep, features far away from all others lose
/// their geometry first. Throws InputError.
void place_on_plan(GeoFile& file, const std::optional<GeoOrigin>& about, GeoFaults faults);

}  // namespace gramap
