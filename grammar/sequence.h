// All layouts of one sequence of types: the best of them, and how well the sequence's walls are known.
#pragma once

#include <vector>

#include "grammar/sequence_search.h"

namespace gramap {

/// Derivations, associations and widths may differ from layout to layout; means and standard deviations are
/// those of the marginals over all layouts of the sequence, each with its posterior probability.
struct SequencePosterior {
  std::vector<PathStep> best;  ///< the layout with the largest weight
  double log_best = 0;         ///< ln of that weight
  struct Place {
    double start_mean_m = 0;
    double start_sd_m = 0;
    double end_sd_m = 0;
    double width_sd_m = 0;
    double covariance_m2 = 0;  ///< of start and width
  };
  std::vector<Place> places;  ///< by element
};

SequencePosterior sequence_posterior(const Lattice& lattice, const Prefix& sequence);

}  // namespace gramap
