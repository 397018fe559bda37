// Refining a rule file that somebody wrote: its probabilities meet new rows; all else stays as it is.
#pragma once

#include <string>
#include <vector>

#include "grammar/learn.h"

namespace gramap {

struct UpdateOptions {
  double weight = 20;           ///< how many uses of each symbol the shares in the file are worth
  double width_sigma_m = 0.05;  ///< how exactly the rows' widths and positions are known
  double grid_m = 0.02;
};

struct UpdatedRules {
  std::string text;
  int probabilities = 0;                ///< how many were written anew
  std::vector<std::string> left_alone;  ///< rules that were used but whose probability is no plain number
  std::vector<std::string> unfilled;    ///< rows that the rules cannot make, nothing is learned from them
};

/// The rule file `text` with the probabilities of its rules re-estimated: the expected number of uses of each
/// rule in the rows, given their widths, places and types (an expectation step over all derivations), is
/// added to the file's own shares. Only the numbers are replaced: names, widths, constants, comments and
/// `after` blocks stay byte for byte. Throws InputError when the file has errors or no row can be made.
UpdatedRules update_rules(const std::string& text, const std::string& name, const LearnData& data,
                          const UpdateOptions& options = {});

}  // namespace gramap
