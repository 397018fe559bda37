// Measures as messages say them.
#pragma once

#include <string>

#include "geometry/types.h"

namespace gramap {

/// "2.80 m".
std::string said_metres(double length_m);

/// "(1.20, 3.40)", plan coordinates in metres.
std::string said_point(const Vec2& point, int decimals = 2);

}  // namespace gramap
