// The pass over the whole cloud that gives planes found on a sample their exact fit and support.
#pragma once

#include <span>
#include <vector>

#include "perception/hough.h"

namespace gramap {

/// Every point goes to the nearest plane that has it within its band and on its patch; the planes are fitted
/// anew to their points. Patches are relative to `centre`, points are not.
void refit_planes(std::vector<PlanePatch>& patches, std::span<const Point> points, const Point& centre);

}  // namespace gramap
