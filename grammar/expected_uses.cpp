#include "grammar/expected_uses.h"

#include <algorithm>
#include <cmath>

#include "grammar/inference.h"

namespace gramap {
namespace {

/// Whether the element is a room of a type in one of the widths that the type itself says.
bool has_own_width(const RuleSet& rules, const Element& element) {
  if (element.kind != Element::Width::mixture || element.rooms.size() != 1) return false;
  const int type = element.first_type();
  if (type < 0) return false;
  const auto& own = rules.rooms[static_cast<std::size_t>(type)].width.components;
  return std::equal(own.begin(), own.end(), element.mixture.components.begin(),
                    element.mixture.components.end(), [](const auto& a, const auto& b) {
                      return a.weight == b.weight && a.normal.mean_m == b.normal.mean_m &&
                             a.normal.sd_m == b.normal.sd_m;
                    });
}

/// Adds a room of known width to the components of its type's width that may have made it.
void add_width(const Mixture& mixture, double width_m, double sigma_m, double probability,
               std::vector<WidthSums>& sums) {
  std::vector<double> shares;
  double all = 0;
  for (const Mixture::Component& component : mixture.components) {
    const double sd = std::hypot(component.normal.sd_m, sigma_m);
    const double u = (width_m - component.normal.mean_m) / sd;
    shares.push_back(component.weight / sd * std::exp(-0.5 * u * u));
    all += shares.back();
  }
  if (all <= 0) return;
  for (std::size_t c = 0; c < shares.size(); ++c) {
    const double share = probability * shares[c] / all;
    const double off = width_m - mixture.components[c].normal.mean_m;
    sums[c].count += share;
    sums[c].off += share * off;
    sums[c].square += share * off * off;
  }
}

}  // namespace

ExpectedUses::ExpectedUses(const RuleSet& of) : rules(of.rules.size(), 0), of_(of) {
  for (const RoomType& room : of.rooms) widths.emplace_back(room.width.components.size());
}

bool ExpectedUses::add(const SpaceProblem& problem, double grid_m) {
  FitOptions options;
  options.grid_m = grid_m;
  const Grid grid = make_grid(problem.length_m, of_.inner_wall_m, grid_m);
  const CompiledRow compiled = compile_row(of_, {problem.depth_m, problem.hallway, problem.facade}, grid);
  if (compiled.fault) return false;
  const Evidence evidence(of_, problem, options, grid);
  const Lattice lattice(compiled.row, grid, evidence);
  const NodeTable before = forward(lattice);
  const double total = log_total(lattice, before);
  if (!std::isfinite(total)) return false;
  const NodeTable behind = backward(lattice, before);
  std::vector<bool> own_width;  // by element
  for (const Element& element : compiled.row.elements) own_width.push_back(has_own_width(of_, element));
  Edges edges(lattice);
  for (int cell = 0; cell < grid.cells; ++cell) {
    const double scale = before.log_scale[static_cast<std::size_t>(cell)] - total;
    for_each_node(lattice, cell, [&](int e, int state, std::size_t node) {
      if (before.value[node] <= 0) return;
      for (const Arc& arc : lattice.arcs(state, cell)) {
        const Element& element = compiled.row.elements[static_cast<std::size_t>(arc.element)];
        const double departing = before.value[node] * arc.probability;
        double probability = 0;
        for (const Move& move : edges.moves(cell, arc.element, e)) {
          double of_move = 0;
          const double* target =
              &behind.value[lattice.node(move.first_cell, arc.target, move.target_evidence)];
          for (int i = 0; i < move.count; ++i) {
            const double weight = move.sum[i] * target[i * move.stride];
            if (weight <= 0) continue;
            const auto reached = static_cast<std::size_t>(move.first_cell + i * move.stride);
            of_move += departing * weight * std::exp(behind.log_scale[reached] + scale);
          }
          probability += of_move;
          if (!own_width[static_cast<std::size_t>(arc.element)] || move.matched < 0 ||
              move.target_evidence % 2 == 1)
            continue;
          const PreparedEvidence& seen = evidence.rooms()[static_cast<std::size_t>(move.matched)];
          const auto type = static_cast<std::size_t>(element.first_type());
          add_width(of_.rooms[type].width, seen.width_m, seen.width_sd_m, of_move, widths[type]);
        }
        for (const DerivationStep& step : arc.steps)
          if (step.rule >= 0) rules[static_cast<std::size_t>(step.rule)] += probability;
        for (const InnerUse& use : element.uses) rules[static_cast<std::size_t>(use.rule)] += probability;
      }
    });
  }
  return true;
}

}  // namespace gramap
