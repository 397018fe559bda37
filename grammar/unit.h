// Units: items whose scope is split further inside, across the space or along it within a size of its own.
// In the row they are one element; the rooms in them have starts and widths that are affine in its width.
#pragma once

#include <vector>

#include "grammar/row.h"
#include "grammar/rules.h"

namespace gramap {

/// One way in which the symbols and repeats inside an item come out.
struct UnitVariant {
  double probability = 1;
  std::vector<ElementRoom> rooms;
  std::vector<InnerUse> uses;  ///< as in Element
};

/// All ways of `item`, which stands in `rule`; probabilities sum to 1. Inside a unit sizes are taken at their
/// means, floating ones share what is left, and where there is none the others stretch in proportion to their
/// variances. Throws RowFaultError when a split cannot fill its scope (with the residual), and for what a
/// unit cannot hold: recursion, contexts, `after` blocks, conditions on the remaining length, repeats without
/// a most.
std::vector<UnitVariant> unit_variants(const RuleSet& rules, const SpaceAttributes& space, const Item& item,
                                       int rule);

}  // namespace gramap
