// The passes of the dynamic programme over a space's lattice: forward and backward sums.
#pragma once

#include <utility>
#include <vector>

#include "grammar/lattice.h"

namespace gramap {

/// Adds up, over the states of a cell and an evidence state, their values times the probabilities of the arcs
/// to each emission: what the edges of a emission start from. Those that are not zero come in order.
class Departures {
 public:
  explicit Departures(const Lattice& lattice) : values_(lattice.row().emissions.size(), 0) {}

  void add(const Arc& arc, double value) {
    double& sum = values_[static_cast<std::size_t>(arc.emission)];
    if (sum == 0) emissions_.push_back(arc.emission);
    sum += value * arc.probability;
  }

  /// Calls visit(emission, value) for each, and forgets them.
  template <class Visit>
  void take(Visit visit) {
    for (const int emission : emissions_)
      visit(emission, std::exchange(values_[static_cast<std::size_t>(emission)], 0));
    emissions_.clear();
  }

 private:
  std::vector<double> values_;
  std::vector<int> emissions_;
};

/// A value per node; the true one is value x exp(log_scale[cell]), so that no length underflows.
struct NodeTable {
  std::vector<double> value;
  std::vector<double> log_scale;  // [cell]
};

/// Calls visit(evidence_state, state, node) for every node of a cell.
template <class Visit>
void for_each_node(const Lattice& lattice, int cell, Visit visit) {
  const auto [first, last] = lattice.alive(cell);
  for (int e = first; e <= last; ++e) {
    if (!lattice.is_alive(cell, e)) continue;
    for (int state = 0; state < lattice.states(); ++state) visit(e, state, lattice.node(cell, state, e));
  }
}

/// Calls visit(evidence_state) for the evidence states that are alive at a cell.
template <class Visit>
void for_each_evidence_state(const Lattice& lattice, int cell, Visit visit) {
  const auto [first, last] = lattice.alive(cell);
  for (int e = first; e <= last; ++e)
    if (lattice.is_alive(cell, e)) visit(e);
}

/// One element of a path through the lattice.
struct PathStep {
  int cell = 0;
  int width = 0;  ///< in cells
  int state = 0;
  int evidence_state = 0;
  int arc = 0;  ///< into Lattice::arcs(state, cell)
  int target_evidence = 0;
  int matched = -1;  ///< last evidence explained (or opened, closed); -1: none
};

/// Sum over all partial paths from the start to each node.
NodeTable forward(const Lattice& lattice);

/// ln of the sum over all paths from start to end; -infinity when there is none.
double log_total(const Lattice& lattice, const NodeTable& forward);

/// Nodes whose posterior probability is below kDeadPosterior are left out of what follows the two sums.
inline constexpr double kDeadPosterior = 1e-30;

/// Sum over all completions of each node that `forward` reaches.
NodeTable backward(const Lattice& lattice, const NodeTable& forward);

/// Whether all that a move leads to has this scale.
bool has_one_scale(const NodeTable& table, const Move& move, double scale);

/// Sum of weights x values of the nodes that a move leads to.
double dot(const double* weights, const double* values, int stride, int count);

/// Adds factor x the move's sums to the values of the nodes that it leads to, of which `first` is the first.
inline void add_scaled(const Move& move, double factor, double* first) {
  if (move.stride == 1)  // told apart for wide registers
    for (int i = 0; i < move.count; ++i) first[i] += factor * move.sum[i];
  else
    for (int i = 0; i < move.count; ++i) first[i * move.stride] += factor * move.sum[i];
}

/// Posterior probability of passing through each node, by the two sums.
std::vector<double> node_posteriors(const Lattice& lattice, const NodeTable& forward,
                                    const NodeTable& backward);

}  // namespace gramap
