// A look at the space on a coarse grid first: which nodes of the fine lattice can matter at all.
#pragma once

#include "grammar/lattice.h"
#include "grammar/space.h"

namespace gramap {

/// The cells of `fine` near which some layout on a grid several times as coarse passes with a probability of
/// at least 1e-7, by evidence state. The coarse grid widens all deviations to match its steps, so it errs on
/// the side of keeping. Empty (all cells) when `fine` is coarse itself or the coarse grid holds no layout.
NodeMask coarse_mask(const RuleSet& rules, const SpaceProblem& problem, const FitOptions& options,
                     const Lattice& fine);

}  // namespace gramap
