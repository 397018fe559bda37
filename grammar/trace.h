// The derivation tree of a path through the lattice.
#pragma once

#include <vector>

#include "grammar/inference.h"

namespace gramap {

/// The use of one rule. A symbol that recurs nests ever deeper; the turns of a recursion are shown side by
/// side instead: a use's parent is the rule that the first turn was used in.
struct RuleUse {
  int rule = 0;
  int parent = -1;  ///< into Trace::uses; -1: the start symbol
};

struct Trace {
  std::vector<RuleUse> uses;   ///< in the order of the derivation
  std::vector<int> placed_by;  ///< by path step, the use that placed it; -1: before any rule (background)
  std::vector<std::vector<int>> rooms;  ///< by path step, for each room of its element, the use that made it
};

Trace trace(const RuleSet& rules, const Lattice& lattice, const std::vector<PathStep>& path);

/// The rules from the start symbol's down to a use's.
std::vector<int> rules_down_to(const Trace& trace, int use);

}  // namespace gramap
