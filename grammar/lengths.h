// What rules do with spaces from one length to another: which they cannot fill, and how often each rule shows
// in a space of a given length, beside the number that the file gives it.
#pragma once

#include <string>
#include <vector>

#include "grammar/space.h"

namespace gramap {

/// From the shortest to the longest of neighbouring lengths that no derivation fills, metres.
struct UnfillableRange {
  double first_m = 0;
  double last_m = 0;
};

/// Tries lengths from `least_m` to `most_m` in steps of `step_m`; of `space` only depth, hallway and façade
/// count.
std::vector<UnfillableRange> unfillable_ranges(const RuleSet& rules, const SpaceProblem& space,
                                               double least_m, double most_m, double step_m);

struct RuleFrequency {
  double stated = 0;    ///< P(R) among the rules of its symbol, whatever their contexts and conditions
  double share = 0;     ///< of the uses of its symbol's rules, in spaces of the length
  double expected = 0;  ///< number of uses in a layout
};

/// One entry a rule. Throws InputError when nothing fills the length.
std::vector<RuleFrequency> rule_frequencies(const RuleSet& rules, const SpaceProblem& space, double length_m);

}  // namespace gramap
