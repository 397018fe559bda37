// Refining a rule file that somebody wrote: its probabilities and widths meet new rows; all else stays as it
// is.
#pragma once

#include <string>
#include <vector>

#include "grammar/learn.h"

namespace gramap {

struct UpdateOptions {
  double weight = 20;           ///< how many uses of each symbol, and rooms of each type, the file is worth
  double width_sigma_m = 0.05;  ///< how exactly the rows' widths and positions are known
  double grid_m = 0.02;
};

struct UpdatedRules {
  std::string text;
  int probabilities = 0;                ///< how many were written anew,
  int widths = 0;                       ///< and how many numbers of room types' widths
  std::vector<std::string> left_alone;  ///< rules that were used but whose probability is no plain number
  std::vector<std::string> unfilled;    ///< rows that the rules cannot make, nothing is learned from them
};

/// The rule file `text` with the probabilities of its rules and the widths of its room types re-estimated:
/// one expectation step over all derivations of the rows, given their widths, places and types, says how
/// often each rule was used and each width of a type seen; the file's own numbers count as `weight` such
/// observations (a Dirichlet prior of the shares, a normal-inverse-gamma one of the widths). Only plain
/// numbers are replaced: names, sizes in rules, what is made of constants, comments and `after` blocks stay
/// byte for byte, and a file in canonical form stays in it. Throws InputError when the file has errors or no
/// row can be made.
UpdatedRules update_rules(const std::string& text, const std::string& name, const LearnData& data,
                          const UpdateOptions& options = {});

}  // namespace gramap
