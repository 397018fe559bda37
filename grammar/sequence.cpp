#include "grammar/sequence.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "grammar/explanation.h"

namespace gramap {
namespace {

constexpr double kNegligible = 1e-16;  // share of a layer below which its nodes are left out

struct LayerNode {
  int cell;
  int state;
  int evidence_state;
  std::size_t node;
  double sum;  // over all partial paths of the sequence's first elements, scaled so that a layer sums to 1
};

struct Range {
  int first;
  int last;
};

/// The moments of start x and width w over a layer's edges.
struct Moments {
  double weight = 0, x = 0, w = 0, xx = 0, ww = 0, xw = 0;
};

double deviation(double weight, double first, double second) {
  const double mean = first / weight;
  return std::sqrt(std::max(0.0, second / weight - mean * mean));
}

class Sequence {
 public:
  Sequence(const Lattice& lattice, const std::vector<double>& posteriors, const NodeTable& completions,
           const std::vector<PathStep>& path)
      : lattice_(lattice),
        posteriors_(posteriors),
        completions_(completions),
        edges_(lattice),
        scratch_(lattice.nodes(), 0),
        path_(path) {
    std::vector<ElementLook> looks;
    for (const Element& element : lattice.row().elements) looks.push_back(look(element));
    for (const PathStep& step : path) {
      const ElementLook wanted = look(placed_element(lattice, step));
      std::vector<bool>& fits = fits_.emplace_back();
      for (const ElementLook& offered : looks) fits.push_back(offered == wanted);
    }
  }

  SequencePosterior run() {
    SequencePosterior posterior;
    posterior.log_weight = go_forward();
    posterior.places.resize(path_.size());
    go_backward(posterior);
    return posterior;
  }

 private:
  double go_forward() {
    const auto [start, weight] = lattice_.start();
    layers_.push_back({{0, 0, start, lattice_.node(0, 0, start), 1}});
    double log_weight = std::log(weight);
    for (std::size_t i = 0; i < path_.size(); ++i) {
      Range touched{lattice_.grid().cells + 1, -1};
      for (const LayerNode& from : layers_[i]) {
        for (const Arc& arc : lattice_.arcs(from.state, from.cell)) {
          if (!fits_[i][static_cast<std::size_t>(arc.element)]) continue;
          for (const Move& move : edges_.moves(from.cell, arc.element, from.evidence_state)) {
            const double* weights = edges_.sum(move);
            double* target = &scratch_[lattice_.node(move.first_cell, arc.target, move.target_evidence)];
            for (int k = 0; k < move.count; ++k) target[k] += from.sum * arc.probability * weights[k];
            touched = {std::min(touched.first, move.first_cell),
                       std::max(touched.last, move.first_cell + move.count - 1)};
          }
        }
      }
      log_weight += std::log(collect(touched, i + 1 == path_.size()));
    }
    return log_weight;
  }

  /// Makes a layer of what is in the scratch table; returns the sum that it was divided by.
  double collect(Range touched, bool is_last) {
    std::vector<LayerNode> layer;
    double sum = 0;
    double most = 0;
    for (int cell = touched.first; cell <= touched.last; ++cell) {
      const bool at_end = cell == lattice_.grid().cells;
      for_each_node(lattice_, cell, [&](int e, int state, std::size_t node) {
        double value = std::exchange(scratch_[node], 0);
        if (at_end) value *= lattice_.row().accept[static_cast<std::size_t>(state)];
        if (value <= 0 || posteriors_[node] < kDeadPosterior || at_end != is_last) return;
        layer.push_back({cell, state, e, node, value});
        sum += value;
        most = std::max(most, promise(layer.back()));
      });
    }
    std::erase_if(layer, [&](const LayerNode& node) { return promise(node) < kNegligible * most; });
    for (LayerNode& node : layer) node.sum /= sum;
    layers_.push_back(std::move(layer));
    return sum;
  }

  /// What the node's paths may still amount to, on one scale for a layer.
  double promise(const LayerNode& node) const {
    const auto n = static_cast<std::size_t>(node.cell);
    const auto reference = static_cast<std::size_t>(path_[std::min(layers_.size(), path_.size() - 1)].cell);
    return node.sum * completions_.value[node.node] *
           std::exp(completions_.log_scale[n] - completions_.log_scale[reference]);
  }

  void go_backward(SequencePosterior& posterior) {
    const Grid& grid = lattice_.grid();
    for (const LayerNode& node : layers_.back()) scratch_[node.node] = 1;
    for (std::size_t i = path_.size(); i-- > 0;) {
      Moments m;
      double most = 0;
      std::vector<double> completions;
      for (const LayerNode& from : layers_[i]) {
        double all = 0;
        const double x = (from.cell - path_[i].cell) * grid.step_m;
        for (const Arc& arc : lattice_.arcs(from.state, from.cell)) {
          if (!fits_[i][static_cast<std::size_t>(arc.element)]) continue;
          for (const Move& move : edges_.moves(from.cell, arc.element, from.evidence_state)) {
            const double* weights = edges_.sum(move);
            const double* target =
                &scratch_[lattice_.node(move.first_cell, arc.target, move.target_evidence)];
            for (int k = 0; k < move.count; ++k) {
              const double p = arc.probability * weights[k] * target[k];
              if (p <= 0) continue;
              const double w = (move.first_cell + k - from.cell - path_[i].width) * grid.step_m;
              all += p;
              m.w += from.sum * p * w;
              m.ww += from.sum * p * w * w;
              m.xw += from.sum * p * x * w;
            }
          }
        }
        m.weight += from.sum * all;
        m.x += from.sum * all * x;
        m.xx += from.sum * all * x * x;
        completions.push_back(all);
        most = std::max(most, all);
      }
      for (const LayerNode& node : layers_[i + 1]) scratch_[node.node] = 0;
      for (std::size_t k = 0; k < layers_[i].size(); ++k)
        scratch_[layers_[i][k].node] = completions[k] / most;
      SequencePosterior::Place& place = posterior.places[i];
      place.start_sd_m = deviation(m.weight, m.x, m.xx);
      place.width_sd_m = deviation(m.weight, m.w, m.ww);
      place.covariance_m2 = m.xw / m.weight - m.x / m.weight * m.w / m.weight;
      place.end_sd_m = i + 1 < path_.size() ? posterior.places[i + 1].start_sd_m : 0;
    }
  }

  const Lattice& lattice_;
  const std::vector<double>& posteriors_;
  const NodeTable& completions_;
  Edges edges_;
  std::vector<double> scratch_;  // [node]; zero but for the layer at work
  const std::vector<PathStep>& path_;
  std::vector<std::vector<bool>> fits_;  // [element of the path][element of the row]
  std::vector<std::vector<LayerNode>> layers_;
};

}  // namespace

ElementLook look(const Element& element) {
  ElementLook look;
  for (const ElementRoom& room : element.rooms) {
    look.types.push_back(room.type);
    look.depths_m.push_back(room.depth_start_m);
    look.depths_m.push_back(room.depth_m);
  }
  return look;
}

SequencePosterior sequence_posterior(const Lattice& lattice, const NodeTable& backward,
                                     const std::vector<double>& posteriors,
                                     const std::vector<PathStep>& path) {
  return Sequence(lattice, posteriors, backward, path).run();
}

}  // namespace gramap
