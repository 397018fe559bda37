#include "grammar/sequence.h"

#include <algorithm>
#include <cmath>

namespace gramap {
namespace {

/// The moments of start x and width w over the edges of one element.
struct Moments {
  double weight = 0, x = 0, w = 0, xx = 0, ww = 0, xw = 0;

  void add(double p, double start, double width) {
    weight += p;
    x += p * start;
    w += p * width;
    xx += p * start * start;
    ww += p * width * width;
    xw += p * start * width;
  }
};

double deviation(double weight, double first, double second) {
  const double mean = first / weight;
  return std::sqrt(std::max(0.0, second / weight - mean * mean));
}

class Sequence {
 public:
  Sequence(const Lattice& lattice, const Prefix& whole)
      : lattice_(lattice), looks_(looks_of(lattice.row())), edges_(lattice), scratch_(lattice.nodes(), 0) {
    for (const Prefix* prefix = &whole; prefix != nullptr; prefix = prefix->before.get())
      prefixes_.push_back(prefix);
    std::reverse(prefixes_.begin(), prefixes_.end());
  }

  SequencePosterior run() {
    SequencePosterior posterior;
    posterior.places.resize(elements());
    go_backward(posterior);
    trace_best(posterior);
    return posterior;
  }

 private:
  std::size_t elements() const { return prefixes_.size() - 1; }
  const std::vector<LayerNode>& layer(std::size_t i) const { return prefixes_[i]->layer; }

  /// Calls visit(arc index, move) for the edges from a node to the next element.
  template <class Visit>
  void for_each_move(std::size_t i, const LayerNode& from, Visit visit) {
    const std::vector<Arc>& arcs = lattice_.arcs(from.state, from.cell);
    for (std::size_t a = 0; a < arcs.size(); ++a) {
      if (looks_[static_cast<std::size_t>(arcs[a].element)] != prefixes_[i + 1]->look) continue;
      for (const Move& move : edges_.moves(from.cell, arcs[a].element, from.evidence_state)) visit(a, move);
    }
  }

  const double* targets(const LayerNode& from, std::size_t arc, const Move& move) const {
    const int state = lattice_.arcs(from.state, from.cell)[arc].target;
    return &scratch_[lattice_.node(move.first_cell, state, move.target_evidence)];
  }

  void fill(std::size_t i, const std::vector<double>& values) {
    for (std::size_t k = 0; k < values.size(); ++k) scratch_[layer(i)[k].node] = values[k];
  }
  void clear(std::size_t i) {
    for (const LayerNode& node : layer(i)) scratch_[node.node] = 0;
  }

  /// The weight of ending in each node of the last layer.
  std::vector<double> acceptance() const {
    std::vector<double> values;
    for (const LayerNode& node : prefixes_.back()->layer)
      values.push_back(lattice_.row().accept[static_cast<std::size_t>(node.state)]);
    return values;
  }

  /// Completions of each layer's nodes within the sequence, summed for the moments and the best ones for the
  /// best layout; each layer on a scale of its own.
  void go_backward(SequencePosterior& posterior) {
    std::vector<double> sums = acceptance();
    best_.assign(elements() + 1, {});
    best_.back() = sums;
    log_scale_.assign(elements() + 1, 0);
    for (std::size_t i = elements(); i-- > 0;) {
      fill(i + 1, sums);
      sums = sum_layer(i, posterior);
      fill(i + 1, best_[i + 1]);
      for (const LayerNode& from : layer(i)) {
        double most = 0;
        for_each_move(i, from, [&](std::size_t arc, const Move& move) {
          const double* target = targets(from, arc, move);
          const double probability = lattice_.arcs(from.state, from.cell)[arc].probability;
          for (int k = 0; k < move.count; ++k)
            most = std::max(most, probability * move.max[k] * target[k * move.stride]);
        });
        best_[i].push_back(most);
      }
      clear(i + 1);
      const double most = *std::max_element(best_[i].begin(), best_[i].end());
      for (double& value : best_[i]) value /= most;
      log_scale_[i] = log_scale_[i + 1] + std::log(most);
    }
    posterior.log_best = prefixes_.front()->log_weight + std::log(best_.front().front()) + log_scale_.front();
  }

  /// Needs the completions of layer i + 1 in the scratch table; returns those of layer i.
  std::vector<double> sum_layer(std::size_t i, SequencePosterior& posterior) {
    const Grid& grid = lattice_.grid();
    const double start_cell = prefixes_[i]->mean_cell;
    const double width_cells = prefixes_[i + 1]->mean_cell - start_cell;
    Moments m;
    std::vector<double> completions;
    for (const LayerNode& from : layer(i)) {
      double all = 0;
      for_each_move(i, from, [&](std::size_t arc, const Move& move) {
        const double* target = targets(from, arc, move);
        const double probability = lattice_.arcs(from.state, from.cell)[arc].probability;
        for (int k = 0; k < move.count; ++k) {
          const double p = probability * move.sum[k] * target[k * move.stride];
          if (p <= 0) continue;
          all += p;
          m.add(from.sum * p, (from.cell - start_cell) * grid.step_m,
                (move.first_cell + k * move.stride - from.cell - width_cells) * grid.step_m);
        }
      });
      completions.push_back(all);
    }
    const double most = *std::max_element(completions.begin(), completions.end());
    for (double& value : completions) value /= most;
    SequencePosterior::Place& place = posterior.places[i];
    place.start_mean_m = start_cell * grid.step_m + m.x / m.weight;
    place.start_sd_m = i == 0 ? 0 : deviation(m.weight, m.x, m.xx);
    place.width_sd_m = deviation(m.weight, m.w, m.ww);
    place.covariance_m2 = m.xw / m.weight - m.x / m.weight * m.w / m.weight;
    place.end_sd_m = i + 1 < elements() ? posterior.places[i + 1].start_sd_m : 0;
    return completions;
  }

  void trace_best(SequencePosterior& posterior) {
    LayerNode at = layer(0).front();
    for (std::size_t i = 0; i < elements(); ++i) {
      fill(i + 1, best_[i + 1]);
      double most = -1;
      PathStep step;
      LayerNode next;
      for_each_move(i, at, [&](std::size_t arc, const Move& move) {
        const double* target = targets(at, arc, move);
        const Arc& taken = lattice_.arcs(at.state, at.cell)[arc];
        for (int k = 0; k < move.count; ++k) {
          const double value = taken.probability * move.max[k] * target[k * move.stride];
          if (value <= most) continue;
          most = value;
          step = {at.cell,
                  move.first_cell + k * move.stride - at.cell,
                  at.state,
                  at.evidence_state,
                  static_cast<int>(arc),
                  move.target_evidence,
                  move.matched};
          next = {move.first_cell + k * move.stride, taken.target, move.target_evidence, 0, 0};
        }
      });
      clear(i + 1);
      posterior.best.push_back(step);
      at = next;
    }
  }

  const Lattice& lattice_;
  std::vector<int> looks_;
  Edges edges_;
  std::vector<double> scratch_;            // [node]; zero but for the layer at work
  std::vector<const Prefix*> prefixes_;    // the empty one first
  std::vector<std::vector<double>> best_;  // [layer][node of the layer]
  std::vector<double> log_scale_;          // of best_
};

}  // namespace

SequencePosterior sequence_posterior(const Lattice& lattice, const Prefix& sequence) {
  return Sequence(lattice, sequence).run();
}

}  // namespace gramap
