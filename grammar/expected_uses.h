// How often rules are expected to be used, and widths of room types to be taken, in a space: the expectation
// step of estimation, over all derivations that fill the space and explain its evidence (Baum and Welch's
// forward-backward sums).
#pragma once

#include <vector>

#include "grammar/rules.h"
#include "grammar/space.h"

namespace gramap {

/// Rooms that were expected to have one of a type's widths: how many, and the sums of their observed widths
/// and of the squares, less the width that is written, metres.
struct WidthSums {
  double count = 0, off = 0, square = 0;
};

class ExpectedUses {
 public:
  /// The rules have to outlive this.
  explicit ExpectedUses(const RuleSet& rules);

  /// Adds those of a space; false, and nothing is added, when no derivation fills it.
  bool add(const SpaceProblem& problem, double grid_m);

  std::vector<double> rules;                   ///< by rule
  std::vector<std::vector<WidthSums>> widths;  ///< by room type and component of its width

 private:
  const RuleSet& of_;
};

}  // namespace gramap
