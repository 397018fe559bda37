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

constexpr int kScaleEvery = 32;  // cells

/// The largest value among the cells that an edge over `cell` may reach or has reached.
double largest_ahead(const Lattice& lattice, const NodeTable& table, int cell) {
  double most = 0;
  const int last = std::min(lattice.grid().cells, cell + lattice.longest());
  for (int n = cell; n <= last; ++n)
    for_each_node(lattice, n, [&](int, int, std::size_t node) { most = std::max(most, table.value[node]); });
  return most;
}

bool is_in_range(double value) {
  return value <= 0 || (value > kLeast && value < kMost);
}

/// Brings what lies ahead of `cell` (this one included) into range; the scale holds from here on.
double rescale_ahead(const Lattice& lattice, NodeTable& table, int cell) {
  const double most = largest_ahead(lattice, table, cell);
  if (is_in_range(most)) return 0;
  const int last = std::min(lattice.grid().cells, cell + lattice.longest());
  for (int n = cell; n <= last; ++n)
    for_each_node(lattice, n, [&](int, int, std::size_t node) { table.value[node] /= most; });
  return std::log(most);
}

/// Scale of completions from `cell` on, chosen so that the largest that it is summed up from is in range:
/// completions are computed from the end, cell by cell.
double scale_behind(const Lattice& lattice, const NodeTable& table, int cell) {
  const double scale = table.log_scale[static_cast<std::size_t>(cell) + 1];
  if (cell % kScaleEvery != 0) return scale;
  const int last = std::min(lattice.grid().cells, cell + lattice.longest());
  double most = -std::numeric_limits<double>::infinity();
  for (int n = cell + 1; n <= last; ++n) {
    double here = 0;
    for_each_node(lattice, n, [&](int, int, std::size_t node) { here = std::max(here, table.value[node]); });
    if (here > 0) most = std::max(most, std::log(here) + table.log_scale[static_cast<std::size_t>(n)]);
  }
  if (!std::isfinite(most)) return scale;
  return is_in_range(std::exp(most - scale)) ? scale : most;
}

/// Sum over the edges of an arc's emission of their weights times what comes after.
double completion(const Lattice& lattice, Edges& edges, const NodeTable& table, int cell, int evidence_state,
                  const Arc& arc, double scale) {
  double sum = 0;
  for (const Move& move : edges.moves(cell, arc.element, evidence_state)) {
    const double* target = &table.value[lattice.node(move.first_cell, arc.target, move.target_evidence)];
    if (has_one_scale(table, move, scale)) {
      sum += dot(move.sum, target, move.stride, move.count);
      continue;
    }
    for (int i = 0; i < move.count; ++i) {
      const auto n = static_cast<std::size_t>(move.first_cell + i * move.stride);
      sum += move.sum[i] * target[i * move.stride] * std::exp(table.log_scale[n] - scale);
    }
  }
  return sum;
}

}  // namespace

bool has_one_scale(const NodeTable& table, const Move& move, double scale) {
  for (int cell = move.first_cell; cell < move.last_cell(); cell += kScaleEvery)
    if (table.log_scale[static_cast<std::size_t>(cell)] != scale) return false;
  return table.log_scale[static_cast<std::size_t>(move.last_cell())] == scale;
}

double dot(const double* weights, const double* values, int stride, int count) {
  double sums[4] = {0, 0, 0, 0};  // in step, so that the compiler can use wide registers
  int i = 0;
  if (stride == 1) {
    for (; i + 4 <= count; i += 4)
      for (int k = 0; k < 4; ++k) sums[k] += weights[i + k] * values[i + k];
  }
  for (; i < count; ++i) sums[0] += weights[i] * values[i * stride];
  return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

NodeTable forward(const Lattice& lattice) {
  NodeTable table = empty_table(lattice);
  Edges edges(lattice);
  Departures departures(lattice);
  const auto [start, weight] = lattice.start();
  table.value[lattice.node(0, 0, start)] = weight;
  double scale = 0;
  for (int cell = 0; cell < lattice.grid().cells; ++cell) {
    if (cell % kScaleEvery == 0) scale += rescale_ahead(lattice, table, cell);
    table.log_scale[static_cast<std::size_t>(cell)] = scale;
    for_each_evidence_state(lattice, cell, [&](int e) {
      for (int state = 0; state < lattice.states(); ++state) {
        const double here = table.value[lattice.node(cell, state, e)];
        if (here <= 0) continue;
        for (const Arc& arc : lattice.arcs(state, cell)) departures.add(arc, here);
      }
      departures.take([&](int id, double factor) {
        const Emission& emission = lattice.row().emissions[static_cast<std::size_t>(id)];
        for (const Move& move : edges.moves(cell, emission.element, e)) {
          add_scaled(move, factor,
                     &table.value[lattice.node(move.first_cell, emission.target, move.target_evidence)]);
        }
      });
    });
  }
  table.log_scale.back() = scale;
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
  std::vector<double> completions(lattice.row().emissions.size(), 0);
  std::vector<bool> known(completions.size(), false);
  const int end = lattice.grid().cells;
  for (int state = 0; state < lattice.states(); ++state)
    table.value[lattice.node(end, state, lattice.end_evidence())] =
        lattice.row().accept[static_cast<std::size_t>(state)];
  for (int cell = end - 1; cell >= 0; --cell) {
    const double scale = scale_behind(lattice, table, cell);
    table.log_scale[static_cast<std::size_t>(cell)] = scale;
    for_each_evidence_state(lattice, cell, [&](int e) {
      std::fill(known.begin(), known.end(), false);
      for (int state = 0; state < lattice.states(); ++state) {
        const std::size_t node = lattice.node(cell, state, e);
        if (forward.value[node] <= 0) continue;
        double sum = 0;
        for (const Arc& arc : lattice.arcs(state, cell)) {
          const auto id = static_cast<std::size_t>(arc.emission);
          if (!known[id]) completions[id] = completion(lattice, edges, table, cell, e, arc, scale);
          known[id] = true;
          sum += arc.probability * completions[id];
        }
        table.value[node] = sum;
      }
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
