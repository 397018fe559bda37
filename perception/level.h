// Which way is up, from the planes themselves: phones and tripods lean.
#pragma once

#include <vector>

#include "perception/hough.h"

namespace gramap {

/// Turns cloud and planes so that floor and ceiling lie as level and walls stand as upright as they can, by
/// the smallest turn about the middle of the scanners. Only leanings of up to about 5° are noticed. Returns
/// the angle in radians.
double level(RegisteredCloud& cloud, std::vector<PlanePatch>& planes);

}  // namespace gramap
