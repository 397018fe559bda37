// Rooms of a space resemble one another more than rules for all spaces can say: a row of lecture rooms among
// rows of offices shows in the first of them that is scanned.
//
// What the rules expect of the next room, its element and its width, is worth one room; each scanned room of
// the space is worth another: with n of them, a room is placed as the rules say with probability 1 / (n + 1),
// else it is as wide as one of those scanned, all alike, and of an element that the rules think likely for
// such a width; what the rules rule out stays ruled out. That is the urn of Blackwell and MacQueen (1973)
// with the unit information of Kass and Wasserman (1995); the order of rooms, contexts and ends stay the
// rules'. A scan does not foretell itself: what it adds to its own room's prior is taken out of its
// likelihood.
#pragma once

#include <vector>

#include "grammar/row.h"
#include "grammar/rules.h"
#include "grammar/space.h"

namespace gramap {

/// Makes the row expect rooms as wide as those scanned; `likeness` is the standard deviation of two rooms'
/// widths as a share of them (FitOptions). Returns by scanned room what its likelihood as a whole room is to
/// be multiplied with: how likely its width was without it / with it. Empty, and the row as it was, when
/// `likeness` is 0 or no scan tells a width along the line that the rules allow.
std::vector<double> expect_as_scanned(const RuleSet& rules, const SpaceProblem& problem, double likeness,
                                      Row& row);

/// The likeness under which the scanned widths are best foretold, each from the other scans of its space and
/// from the rules; 0 unless that is clearly better than the rules alone.
double likeness_of(const RuleSet& rules, const std::vector<SpaceProblem>& problems);

}  // namespace gramap
