// Which lengths rules can fill.
#pragma once

#include <optional>

#include "grammar/row.h"
#include "grammar/space.h"

namespace gramap {

/// Whether some derivation fills a space like this one, of this clear length, exactly.
bool can_fill(const RuleSet& rules, const SpaceProblem& problem, double length_m, double grid_m);

/// The nearest length that can be filled, to 5 cm, within half and twice the space's own and at most 10 m
/// away.
std::optional<double> nearest_fillable_m(const RuleSet& rules, const SpaceProblem& problem,
                                         const FitOptions& options);

/// Throws InputError: no layout fills the space, which rules were tried, and the nearest length that works.
[[noreturn]] void refuse_unfillable(const RuleSet& rules, const SpaceProblem& problem,
                                    const FitOptions& options);

/// Throws InputError when the rules could not be turned into a row for this space.
void refuse_fault(const RuleSet& rules, const SpaceProblem& problem, const CompiledRow& compiled);

}  // namespace gramap
