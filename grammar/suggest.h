// "Did you mean …?"
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace gramap {

/// The candidate that `word` was most likely meant to be: fewest typing errors (insertion, deletion,
/// replacement, swap of neighbours; a difference in case counts little), at most a third of the word. Empty
/// when none is near.
std::string nearest(std::string_view word, const std::vector<std::string_view>& candidates);

}  // namespace gramap
