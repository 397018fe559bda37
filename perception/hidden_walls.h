// Walls that little is seen of: behind cupboards, far away, narrow.
#pragma once

#include <vector>

#include "perception/hough.h"
#include "perception/wall_lines.h"

namespace gramap {

/// A second search for upright planes among the points under the ceiling that no wall has yet. Furniture does
/// not reach there, so that what shows above it, the lintel over an opening and a column's narrow faces stand
/// out.
std::vector<PlanePatch> find_hidden_walls(const std::vector<PlanePatch>& planes, const RegisteredCloud& cloud,
                                          const Storey& storey, const WallOptions& options,
                                          HoughOptions hough);

}  // namespace gramap
