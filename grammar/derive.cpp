#include "grammar/derive.h"

#include <algorithm>
#include <cmath>

#include "geometry/error.h"
#include "geometry/random.h"
#include "grammar/evidence.h"
#include "grammar/explanation.h"
#include "grammar/fillable.h"
#include "grammar/placed_rooms.h"

namespace gramap {
namespace {

/// A number in [0, 1) from counters.
double uniform(std::uint64_t seed, std::uint64_t sample, std::uint64_t step) {
  return unit_interval(split_mix(split_mix(split_mix(seed) + sample) + step));
}

/// The edges that leave one node, ready to be drawn from.
struct Choices {
  std::vector<double> cumulative;
  std::vector<PathStep> steps;
  std::vector<int> states;  // after each step

  std::size_t pick(double u) const {
    const auto place = std::upper_bound(cumulative.begin(), cumulative.end(), u * cumulative.back());
    return static_cast<std::size_t>(std::min(place, cumulative.end() - 1) - cumulative.begin());
  }
};

/// Calls visit(arc index, move, i, weight) for the edges of a node, each weighed with all that can follow.
template <class Visit>
void for_each_edge(const Lattice& lattice, Edges& edges, const NodeTable& backward, int cell, int state,
                   int e, Visit visit) {
  const std::vector<Arc>& arcs = lattice.arcs(state, cell);
  const double here = backward.log_scale[static_cast<std::size_t>(cell)];
  for (std::size_t a = 0; a < arcs.size(); ++a) {
    for (const Move& move : edges.moves(cell, arcs[a].element, e)) {
      const double* target =
          &backward.value[lattice.node(move.first_cell, arcs[a].target, move.target_evidence)];
      for (int i = 0; i < move.count; ++i) {
        double weight = arcs[a].probability * move.sum[i] * target[i * move.stride];
        if (weight <= 0) continue;
        const double scale = backward.log_scale[static_cast<std::size_t>(move.first_cell + i * move.stride)];
        if (scale != here) weight *= std::exp(scale - here);
        visit(a, move, i, weight);
      }
    }
  }
}

}  // namespace

struct SpaceDeriver::Model {
  const RuleSet& rules;
  double length_m;
  Grid grid;
  CompiledRow compiled;
  Evidence none;
  Lattice lattice;
  NodeTable forward_sums;
  NodeTable backward_sums;

  Model(const RuleSet& given, const SpaceProblem& bare, double grid_m)
      : rules(given),
        length_m(bare.length_m),
        grid(make_grid(bare.length_m, given.inner_wall_m, grid_m)),
        compiled(compile_row(given, {bare.depth_m, bare.hallway, bare.facade}, grid)),
        none(given, bare, {}, grid),
        lattice(compiled.row, grid, none) {}
};

SpaceDeriver::SpaceDeriver(const RuleSet& rules, const SpaceProblem& space, double grid_m) {
  if (!(space.length_m > 0) || !std::isfinite(space.length_m))
    throw InputError({}, "space " + space.id + ": its length is not positive");
  SpaceProblem bare = space;
  bare.rooms.clear();
  bare.doors.clear();
  bare.doors_visible.clear();
  model_ = std::make_unique<Model>(rules, bare, grid_m);
  refuse_fault(rules, space, model_->compiled);
  model_->forward_sums = forward(model_->lattice);
  FitOptions options;
  options.grid_m = grid_m;
  if (!std::isfinite(log_total(model_->lattice, model_->forward_sums)))
    refuse_unfillable(rules, bare, options);
  model_->backward_sums = backward(model_->lattice, model_->forward_sums);
}

SpaceDeriver::~SpaceDeriver() = default;

const Lattice& SpaceDeriver::lattice() const {
  return model_->lattice;
}
const NodeTable& SpaceDeriver::forward_sums() const {
  return model_->forward_sums;
}
const NodeTable& SpaceDeriver::backward_sums() const {
  return model_->backward_sums;
}

// All samples walk along the line together: those that stand at one node share its choices.
std::vector<Derivation> SpaceDeriver::draw(int count, std::uint64_t seed) const {
  const Lattice& lattice = model_->lattice;
  const auto cells = static_cast<std::size_t>(lattice.grid().cells);
  std::vector<Derivation> drawn(static_cast<std::size_t>(count));
  std::vector<std::vector<std::vector<std::size_t>>> waiting(cells + 1);  // [cell][state]: samples
  const auto wait = [&](std::size_t cell, int state, std::size_t sample) {
    waiting[cell].resize(static_cast<std::size_t>(lattice.states()));
    waiting[cell][static_cast<std::size_t>(state)].push_back(sample);
  };
  for (std::size_t i = 0; i < drawn.size(); ++i) wait(0, 0, i);
  Edges edges(lattice);
  Choices choices;
  for (std::size_t cell = 0; cell < cells; ++cell) {
    for (std::size_t state = 0; state < waiting[cell].size(); ++state) {
      if (waiting[cell][state].empty()) continue;
      const int at = static_cast<int>(cell);
      choices = {};
      double sum = 0;
      for_each_edge(lattice, edges, model_->backward_sums, at, static_cast<int>(state), 0,
                    [&](std::size_t arc, const Move& move, int i, double weight) {
                      choices.cumulative.push_back(sum += weight);
                      choices.steps.push_back({at, move.first_cell + i * move.stride - at,
                                               static_cast<int>(state), 0, static_cast<int>(arc), 0, -1});
                      choices.states.push_back(lattice.arcs(static_cast<int>(state), at)[arc].target);
                    });
      for (const std::size_t sample : waiting[cell][state]) {
        Derivation& derivation = drawn[sample];
        const std::size_t pick = choices.pick(uniform(seed, sample, derivation.path.size()));
        derivation.path.push_back(choices.steps[pick]);
        wait(cell + static_cast<std::size_t>(choices.steps[pick].width), choices.states[pick], sample);
      }
    }
    waiting[cell] = {};
  }
  for (Derivation& derivation : drawn) {
    std::vector<double> starts;
    for (const PathStep& step : derivation.path) starts.push_back(lattice.grid().position_m(step.cell));
    derivation.rooms = placed_rooms(model_->rules, lattice, derivation.path, starts, model_->length_m);
    derivation.tree = trace(model_->rules, lattice, derivation.path);
  }
  return drawn;
}

DerivationStatistics exact_statistics(const RuleSet& rules, const SpaceDeriver& deriver) {
  const Lattice& lattice = deriver.lattice();
  const NodeTable& forward = deriver.forward_sums();
  const NodeTable& backward = deriver.backward_sums();
  const double total = log_total(lattice, forward);
  const std::size_t types = rules.rooms.size() + 1;
  DerivationStatistics statistics;
  statistics.log_probability = total;
  statistics.rooms.assign(types, 0);
  statistics.width_mean_m.assign(types, 0);
  statistics.width_sd_m.assign(types, 0);
  statistics.rules.assign(rules.rules.size(), 0);
  Edges edges(lattice);
  for (int cell = 0; cell < lattice.grid().cells; ++cell) {
    const auto n = static_cast<std::size_t>(cell);
    const double scale = std::exp(forward.log_scale[n] + backward.log_scale[n] - total);
    for_each_node(lattice, cell, [&](int e, int state, std::size_t node) {
      if (forward.value[node] * backward.value[node] <= 0) return;
      const std::vector<Arc>& arcs = lattice.arcs(state, cell);
      for_each_edge(
          lattice, edges, backward, cell, state, e,
          [&](std::size_t arc, const Move& move, int i, double weight) {
            const double p = forward.value[node] * weight * scale;
            const Element& element = lattice.row().elements[static_cast<std::size_t>(arcs[arc].element)];
            const double clear_m = lattice.grid().width_m(move.first_cell + i * move.stride - cell);
            for (const DerivationStep& step : arcs[arc].steps)
              if (step.rule >= 0) statistics.rules[static_cast<std::size_t>(step.rule)] += p;
            for (const InnerUse& use : element.uses)
              statistics.rules[static_cast<std::size_t>(use.rule)] += p;
            for (const ElementRoom& room : element.rooms) {
              const std::size_t type = room.type < 0 ? types - 1 : static_cast<std::size_t>(room.type);
              const double width = room.width.at(clear_m);
              statistics.rooms[type] += p;
              statistics.width_mean_m[type] += p * width;
              statistics.width_sd_m[type] += p * width * width;
            }
          });
    });
  }
  for (std::size_t type = 0; type < types; ++type) {
    if (statistics.rooms[type] <= 0) continue;
    double& mean = statistics.width_mean_m[type];
    double& sd = statistics.width_sd_m[type];
    mean /= statistics.rooms[type];
    sd = std::sqrt(std::max(0.0, sd / statistics.rooms[type] - mean * mean));
  }
  return statistics;
}

}  // namespace gramap
