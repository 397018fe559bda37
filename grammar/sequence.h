// Layouts of one sequence of types: its probability among all, and how well its walls are known.
#pragma once

#include <vector>

#include "grammar/inference.h"

namespace gramap {

/// What an element shows of itself: its rooms' types (and where across the space they lie).
struct ElementLook {
  std::vector<int> types;
  std::vector<double> depths_m;
  bool operator==(const ElementLook&) const = default;
};
ElementLook look(const Element& element);

/// Posterior of all layouts that have the same sequence of looks as `path`: the layouts' widths, derivations
/// and associations may differ.
struct SequencePosterior {
  double log_weight = 0;  ///< ln of the sum of their weights
  /// By element: standard deviations of its start, end and clear width, metres, among these layouts.
  struct Place {
    double start_sd_m = 0;
    double end_sd_m = 0;
    double width_sd_m = 0;
    double covariance_m2 = 0;  ///< of start and width
  };
  std::vector<Place> places;
};

SequencePosterior sequence_posterior(const Lattice& lattice, const NodeTable& backward,
                                     const std::vector<double>& posteriors,
                                     const std::vector<PathStep>& path);

}  // namespace gramap
