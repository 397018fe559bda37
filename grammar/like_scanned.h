// Rooms of a space resemble one another more than rules for all spaces can say: a row of lecture rooms among
// rows of offices shows in the first of them that is scanned. Less so, rooms of a floor do.
//
// What the rules expect of the next room, its element and its width, is worth w_f rooms, each scanned room of
// the floor one: together they say what to expect of any space. That is worth w rooms, each scanned room of
// the space itself one. With n of them among N on the floor, a room is placed as the rules say with
// probability w / (n + w) w_f / (N + w_f), else it is as wide as one of those scanned, all alike, and of an
// element that the rules think likely for such a width; what the rules rule out stays ruled out. These are
// the nested urns of Blackwell and MacQueen (1973) and Teh et al. (2006, hierarchical Dirichlet processes);
// the order of rooms, contexts and ends stay the rules'. A scan does not foretell itself: what it adds to its
// own room's prior is taken out of its likelihood.
#pragma once

#include <optional>
#include <vector>

#include "grammar/row.h"
#include "grammar/rules.h"
#include "grammar/space.h"

namespace gramap {

/// Makes the row expect rooms as wide as those scanned. Returns by scanned room what its likelihood as a
/// whole room is to be multiplied with: how likely its width was without it / with it. Empty, and the row as
/// it was, when no room is like another or no scan of the space or the floor tells a width along the line
/// that the rules allow.
std::vector<double> expect_as_scanned(const RuleSet& rules, const SpaceProblem& problem,
                                      const Likeness& likeness, Row& row);

/// The scanned rooms of all spaces, those of one type whose widths are within 2 % of one another together.
std::vector<AlikeRooms> alike_rooms(const std::vector<SpaceProblem>& problems);

/// The likeness under which the scanned widths are best foretold, each from the other scans of its space and
/// floor and from the rules; a deviation of 0 unless that is clearly better than the rules alone.
/// `deviation`: taken as given, however well it does.
Likeness likeness_of(const RuleSet& rules, const std::vector<SpaceProblem>& problems,
                     std::optional<double> deviation = {});

}  // namespace gramap
