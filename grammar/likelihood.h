// How probable rules make what was observed: the figure by which rule files are compared on floors that they
// were not made from.
#pragma once

#include "grammar/rules.h"
#include "grammar/space.h"

namespace gramap {

/// ln p(evidence | rules, length), summed over all layouts that fill the space; -infinity when none does.
/// Throws InputError when the rules cannot be made a row.
double log_likelihood(const RuleSet& rules, const SpaceProblem& problem, const FitOptions& options = {});

/// ln p(evidence, length | rules): the same but for what does not depend on the evidence, in half the time.
double log_joint(const RuleSet& rules, const SpaceProblem& problem, const FitOptions& options = {});

}  // namespace gramap
