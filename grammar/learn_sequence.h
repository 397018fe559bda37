// Sequences of symbols described as shortly as possible: by units that recur, by repeats, and by what follows
// what. Lengths are in nats.
#pragma once

#include <vector>

namespace gramap {

/// A token of the description: one symbol, several in a row (a unit), or one symbol repeated.
struct SequenceToken {
  std::vector<int> symbols;
  int least = 0, most = 0;  ///< > 0: the symbols are repeated that often
};

struct SequenceModel {
  std::vector<SequenceToken> tokens;
  std::vector<std::vector<int>> sequences;  ///< the input in tokens
  double length = 0;                        ///< nats
};

/// Length of sequences of the symbols 0 to `symbols` - 1, each said after the one before it where that is
/// shorter.
double sequence_length(const std::vector<std::vector<int>>& sequences, std::size_t symbols);

/// Greedy grammar induction by minimum description length: starting from single symbols (token i is symbol
/// i), the unit or repeat that shortens the description most is added, until none does.
SequenceModel describe_sequences(const std::vector<std::vector<int>>& sequences, int symbols);

/// Whether what follows a token is better said apart from what follows any: the log evidence for a
/// distribution of its own (Dirichlet prior about the shares `overall`, total weight `strength`) over
/// `overall` itself.
double log_evidence_of_own(const std::vector<double>& counts, const std::vector<double>& overall,
                           double strength);

}  // namespace gramap
