// Upright faces too narrow for triples of points: columns, jambs, niches, the ends of walls.
#pragma once

#include <vector>

#include "perception/hough.h"
#include "perception/range_noise.h"
#include "perception/wall_lines.h"

namespace gramap {

/// A third search for upright planes, in the plan: points under the ceiling that no plane explains, by the
/// noise that points at their range have and the angle they were seen at, fall into clusters; along the
/// directions that the room's other walls have, a cluster's points are piled up where it has a face. A face
/// of 30 cm is not much wider than the noise is thick, so that its direction has to come from elsewhere.
std::vector<PlanePatch> find_narrow_faces(const std::vector<PlanePatch>& planes, const RegisteredCloud& cloud,
                                          const Storey& storey, const WallOptions& options,
                                          const RangeNoise& noise);

}  // namespace gramap
