// Derivation: layouts drawn from the distribution that the rules denote for a space of a given length.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "grammar/inference.h"
#include "grammar/space.h"
#include "grammar/trace.h"

namespace gramap {

/// A layout that was drawn. Its walls lie on the grid, so widths and walls add up to the length.
struct Derivation {
  std::vector<PathStep> path;
  std::vector<PlacedRoom> rooms;
  Trace tree;
};

/// The layouts of one space, ready to be drawn from.
class SpaceDeriver {
 public:
  /// Of `space` only id, length, depth, hallway and façade count. Throws InputError as fit_space does.
  SpaceDeriver(const RuleSet& rules, const SpaceProblem& space, double grid_m = 0.01);
  ~SpaceDeriver();

  /// `count` independent layouts; the i-th depends on the seed and i alone.
  std::vector<Derivation> draw(int count, std::uint64_t seed) const;

  const Lattice& lattice() const;
  const NodeTable& forward_sums() const;
  const NodeTable& backward_sums() const;

 private:
  struct Model;
  std::unique_ptr<Model> model_;
};

/// What the rules promise for a space, exactly: expectations over all its layouts.
struct DerivationStatistics {
  double log_probability = 0;  ///< ln of the probability that a derivation fills this length (grid cell)
  std::vector<double> rooms;   ///< by type, last: background; expected number in a layout
  std::vector<double> width_mean_m;  ///< by type
  std::vector<double> width_sd_m;
  std::vector<double> rules;  ///< expected number of uses in a layout
};

DerivationStatistics exact_statistics(const RuleSet& rules, const SpaceDeriver& deriver);

}  // namespace gramap
