// Measures as messages say them.
#pragma once

#include <cstddef>
#include <string>

#include "geometry/types.h"

namespace gramap {

/// "2.80 m".
std::string said_metres(double length_m);

/// "1 room", "2 rooms"; `many` where it is not `one` with an s.
std::string said_count(std::size_t count, const std::string& one, const std::string& many = "");

/// "(1.20, 3.40)", plan coordinates in metres.
std::string said_point(const Vec2& point, int decimals = 2);

}  // namespace gramap
