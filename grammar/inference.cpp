#include "grammar/inference.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gramap {
namespace {

constexpr double kLeast = 1e-100;  // beyond these, values are scaled
constexpr double kMost = 1e100;

NodeTable empty_table(const Lattice& lattice) {
  return {std::vector<double>(lattice.nodes(), 0),
          std::vector<double>(static_cast<std::size_t>(lattice.grid().cells) + 1, 0)};
}

double largest(const Lattice& lattice, const NodeTable& table, int cell) {
  double most = 0;
  for_each_node(lattice, cell, [&](int, int, std::size_t node) { most = std::max(most, table.value[node]); });
  return most;
}

/// Brings what lies ahead of `cell` (this one included) into range.
void rescale_ahead(const Lattice& lattice, NodeTable& table, int cell) {
  const double most = largest(lattice, table, cell);
  if (most <= 0 || (most > kLeast && most < kMost)) return;
  const int last = std::min(lattice.grid().cells, cell + lattice.longest());
  for (int n = cell; n <= last; ++n)
    for_each_node(lattice, n, [&](int, int, std::size_t node) { table.value[node] /= most; });
  for (std::size_t n = static_cast<std::size_t>(cell); n < table.log_scale.size(); ++n)
    table.log_scale[n] += std::log(most);
}

/// Scale of a completion at `cell`, chosen after the largest value that lies ahead, so that the sums at
/// `cell` are in range: completions are computed from the end, cell by cell.
double scale_behind(const Lattice& lattice, const NodeTable& table, int cell) {
  const auto next = static_cast<std::size_t>(cell) + 1;
  const double most = largest(lattice, table, cell + 1);
  const double scale = table.log_scale[next];
  return most <= 0 || (most > kLeast && most < kMost) ? scale : scale + std::log(most);
}

/// exp(scale[cell + i] - scale_here), or nothing when that is 1 all over the move.
class ScaleFactors {
 public:
  const double* operator()(const NodeTable& table, const Move& move, double scale_here) {
    const auto first = table.log_scale.begin() + move.first_cell;
    if (std::all_of(first, first + move.count, [&](double scale) { return scale == scale_here; }))
      return nullptr;
    factors_.clear();
    for (auto scale = first; scale != first + move.count; ++scale)
      factors_.push_back(std::exp(*scale - scale_here));
    return factors_.data();
  }

 private:
  std::vector<double> factors_;
};

}  // namespace

NodeTable forward(const Lattice& lattice) {
  NodeTable table = empty_table(lattice);
  Edges edges(lattice);
  const auto [start, weight] = lattice.start();
  table.value[lattice.node(0, 0, start)] = weight;
  for (int cell = 0; cell < lattice.grid().cells; ++cell) {
    rescale_ahead(lattice, table, cell);
    for_each_node(lattice, cell, [&](int e, int state, std::size_t node) {
      const double here = table.value[node];
      if (here <= 0) return;
      for (const Arc& arc : lattice.arcs(state, cell)) {
        const double factor = here * arc.probability;
        for (const Move& move : edges.moves(cell, arc.element, e)) {
          const double* weights = edges.sum(move);
          double* target = &table.value[lattice.node(move.first_cell, arc.target, move.target_evidence)];
          for (int i = 0; i < move.count; ++i) target[i] += factor * weights[i];
        }
      }
    });
  }
  return table;
}

double log_total(const Lattice& lattice, const NodeTable& forward) {
  double sum = 0;
  const int end = lattice.grid().cells;
  for (int state = 0; state < lattice.states(); ++state)
    sum += forward.value[lattice.node(end, state, lattice.end_evidence())] *
           lattice.row().accept[static_cast<std::size_t>(state)];
  if (sum <= 0) return -std::numeric_limits<double>::infinity();
  return std::log(sum) + forward.log_scale.back();
}

NodeTable backward(const Lattice& lattice, const NodeTable& forward) {
  NodeTable table = empty_table(lattice);
  Edges edges(lattice);
  ScaleFactors factors;
  const int end = lattice.grid().cells;
  for (int state = 0; state < lattice.states(); ++state)
    table.value[lattice.node(end, state, lattice.end_evidence())] =
        lattice.row().accept[static_cast<std::size_t>(state)];
  for (int cell = end - 1; cell >= 0; --cell) {
    const double scale = scale_behind(lattice, table, cell);
    table.log_scale[static_cast<std::size_t>(cell)] = scale;
    for_each_node(lattice, cell, [&](int e, int state, std::size_t node) {
      if (forward.value[node] <= 0) return;
      double sum = 0;
      for (const Arc& arc : lattice.arcs(state, cell)) {
        double part = 0;
        for (const Move& move : edges.moves(cell, arc.element, e)) {
          const double* weights = edges.sum(move);
          const double* target =
              &table.value[lattice.node(move.first_cell, arc.target, move.target_evidence)];
          const double* scales = factors(table, move, scale);
          for (int i = 0; i < move.count; ++i)
            part += weights[i] * target[i] * (scales != nullptr ? scales[i] : 1);
        }
        sum += arc.probability * part;
      }
      table.value[node] = sum;
    });
  }
  return table;
}

std::vector<double> node_posteriors(const Lattice& lattice, const NodeTable& forward,
                                    const NodeTable& backward) {
  std::vector<double> posteriors(lattice.nodes(), 0);
  const double total = log_total(lattice, forward);
  for (int cell = 0; cell <= lattice.grid().cells; ++cell) {
    const auto n = static_cast<std::size_t>(cell);
    const double scale = std::exp(forward.log_scale[n] + backward.log_scale[n] - total);
    for_each_node(lattice, cell, [&](int, int, std::size_t node) {
      posteriors[node] = forward.value[node] * backward.value[node] * scale;
    });
  }
  return posteriors;
}

}  // namespace gramap
