// Counts alone do not give the probabilities of rules whose derivations have to fill a space: rooms that fit
// the lengths at hand come up more often than their rules' shares say, others less often.
#pragma once

#include <vector>

#include "grammar/learn.h"

namespace gramap {

/// Tilts the probabilities of the rules for rooms that were seen, until each is expected in spaces of the
/// data's lengths as often as it was used there: the conditional likelihood's maximum over one factor a rule
/// (generalised iterative scaling: Darroch and Ratcliff 1972), with a Gaussian prior on the factors'
/// logarithms, which keeps few floors from saying much. `uses`: by row, the rules of its derivation.
void match_filling(LearnedRules& rules, const std::vector<std::vector<int>>& uses);

}  // namespace gramap
