// How probable rules make what was observed: the figure by which rule files are compared on floors that they
// were not made from.
#pragma once

#include <vector>

#include "grammar/rules.h"
#include "grammar/space.h"

namespace gramap {

/// ln p(evidence | rules, length), summed over all layouts that fill the space; -infinity when none does.
/// Throws InputError when the rules cannot be made a row.
double log_likelihood(const RuleSet& rules, const SpaceProblem& problem, const FitOptions& options = {});

/// ln p(evidence, length | rules): the same but for what does not depend on the evidence, in half the time.
double log_joint(const RuleSet& rules, const SpaceProblem& problem, const FitOptions& options = {});

/// ln p(rooms | what was observed in the space, rules): how well rooms are foretold that were not scanned.
/// That no room explains one of them is as probable as for scans. -infinity when no layout fills the space.
double log_predictive(const RuleSet& rules, const SpaceProblem& observed,
                      const std::vector<RoomEvidence>& rooms, const FitOptions& options = {});

}  // namespace gramap
