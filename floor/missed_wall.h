// Scans that read two rooms as one because nobody saw the wall between them.
#pragma once

#include "grammar/rules.h"
#include "grammar/space.h"

namespace gramap {

/// ln of the probability of all that was observed in the space.
double evidence_score(const SpaceFit& fit);

/// The fit under the assumption that scans which no room of the rules explains (set aside, or taken for a
/// room that the rules do not foresee), or whose room shows two doors to the hallway, are of two neighbours
/// at once, where that is more probable. The lattice holds the two outer walls of such a scan each by itself,
/// to what the pose is known; here the two rooms are held against its width, which is known far better. Such
/// a scan is said in `reinterpreted` and is evidence of both rooms. Only scans whose dimension along the line
/// is known are tried.
SpaceFit with_missed_walls(const RuleSet& rules, const SpaceProblem& problem, const FitOptions& options,
                           SpaceFit fit);

}  // namespace gramap
