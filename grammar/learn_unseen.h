// How much to leave for rooms that learned classes do not foresee: estimated on floors (or rows) left out,
// not assumed.
#pragma once

#include <vector>

#include "grammar/learn.h"

namespace gramap {

struct UnseenShares {
  double even = 0;         ///< rooms of a known class, all classes alike
  double other_width = 0;  ///< rooms of a known type in a width of their own
  double background = 0;   ///< rooms of no known type
};

/// The shares under which the rooms of each part of the data are most probable to those who know the other
/// parts only: deleted estimation (Jelinek and Mercer, 1980) by expectation-maximisation. A part is a floor,
/// or a row when the data is one floor. `classes` has the class of each room, row by row; a width of no class
/// is normal about all widths of its type, a room of no type uniform up to the widest room. How many rooms
/// are of a type not seen is estimated by how many are of a type seen once (Good, 1953), half a room more.
/// Before any is seen, half a part's worth of rooms is believed to be unlike the others in every way: two
/// parts that happen to be alike do not prove that the next one is.
UnseenShares unseen_shares(const LearnedRules& rules, const std::vector<std::vector<int>>& classes);

/// The widths of all rooms of a type as one normal.
WidthClass any_width(const LearnedRules& rules, const std::vector<std::vector<int>>& classes, int type);

}  // namespace gramap
