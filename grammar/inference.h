// The passes of the dynamic programme over a space's lattice: forward and backward sums.
#pragma once

#include <vector>

#include "grammar/lattice.h"

namespace gramap {

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
    if (cell < lattice.first_cell(e) || cell > lattice.last_cell(e)) continue;
    for (int state = 0; state < lattice.states(); ++state) visit(e, state, lattice.node(cell, state, e));
  }
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
inline constexpr double kDeadPosterior = 1e-15;

/// Sum over all completions of each node that `forward` reaches.
NodeTable backward(const Lattice& lattice, const NodeTable& forward);

/// Posterior probability of passing through each node, by the two sums.
std::vector<double> node_posteriors(const Lattice& lattice, const NodeTable& forward,
                                    const NodeTable& backward);

}  // namespace gramap
