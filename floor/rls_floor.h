// A floor from the RLS/rules CSV pair alone: every reference line segment becomes a space, every gap between
// two wall lines an observed room.
//
// What the files leave open, and what is taken:
// - Lengths run between wall lines, taken as the walls' centre lines; a clear width is a gap less one inner
// wall.
// - Collinear neighbours meet in the wall that both have seen, which replaces the border of the two segments.
// - A first gap too narrow for any room of the rules is no room: the space begins at that first wall.
// - A space's depth is the distance to the nearest end of a segment across it; without one, the rules' room
// depth.
#pragma once

#include <filesystem>
#include <vector>

#include "floor/fitted_floor.h"
#include "floor/ground_truth.h"
#include "grammar/rules.h"
#include "grammar/space.h"

namespace gramap {

struct RlsOptions {
  double width_sigma_m = 0.05;   ///< standard deviation of a gap, metres
  double relative_sigma = 0.02;  ///< and in proportion to the gap, as phones' scales drift
  double default_depth_m = 5;    ///< when neither the other segments nor the rules say how deep a space is
};

struct RlsFloor {
  FloorGroundTruth floor;  ///< spaces named "rls_<index>", without outline and hallways; its remarks say
                           ///< which gaps are no rooms
  std::vector<SpaceProblem> problems;  ///< one a space, in order
};

/// Throws InputError for what is wrong with the files.
RlsFloor rls_floor(const std::filesystem::path& rls, const std::filesystem::path& rules_csv,
                   const RuleSet& rules, const RlsOptions& options = {});

}  // namespace gramap
