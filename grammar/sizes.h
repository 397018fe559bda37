// Sizes of items: their densities, and the share of what is left that relative and floating ones take.
#pragma once

#include <vector>

#include "grammar/row.h"
#include "grammar/rules.h"

namespace gramap {

/// A fault found while rules are turned into a row; caught in compile_row.
struct RowFaultError {
  RowFault fault;
};

/// The mixture with kDefaultTolerance_m where nothing was said of the spread.
Mixture with_tolerance(Mixture mixture);

/// Mean of a mixture, metres.
double mean_m(const Mixture& mixture);

/// Density of a room made of rooms (or of a unit made of pieces) side by side: means and the walls between
/// add up, variances add up.
Mixture side_by_side(const std::vector<Mixture>& parts, double wall_m);

/// Density of the clear width of an item that has one of its own: a room by its type, anything with an
/// absolute size, a merge, a nested split by its pieces (side by side, or the first across that has one).
/// Empty when nothing is said (any width). Throws RowFaultError (naming `rule`) for items that have none.
Mixture own_density(const RuleSet& rules, const Item& item, int rule);

/// The mean width of row[index], relative or floating, as a function of the clear length that is left when
/// it is placed: relative sizes refer to the scope's clear length less the walls between its items; floating
/// ones share by weight what the others' means leave.
Affine share_of_rest(const RuleSet& rules, const std::vector<Item>& row, std::size_t index, int rule);

}  // namespace gramap
