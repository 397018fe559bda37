#include "grammar/coarse.h"

#include <algorithm>
#include <cmath>

#include "grammar/inference.h"

namespace gramap {
namespace {

constexpr double kCoarseness = 5;        // coarse step / fine step
constexpr double kFinestCoarse_m = 0.1;  // no wider coarse steps than this: narrow rooms would vanish in them
constexpr double kNegligible = 1e-7;
constexpr int kMargin = 1;  // coarse cells kept around those that matter: what the coarse grid rounds off

}  // namespace

NodeMask coarse_mask(const RuleSet& rules, const SpaceProblem& problem, const FitOptions& options,
                     const Lattice& fine) {
  const double step_m = kCoarseness * fine.grid().step_m;
  if (step_m > kFinestCoarse_m) return {};
  const Grid grid = make_grid(problem.length_m, rules.inner_wall_m, step_m);
  const CompiledRow compiled = compile_row(rules, {problem.depth_m, problem.hallway, problem.facade}, grid);
  if (compiled.fault) return {};
  const Evidence evidence(rules, problem, options, grid);
  const Lattice coarse(compiled.row, grid, evidence);
  const NodeTable before = forward(coarse);
  if (!std::isfinite(log_total(coarse, before))) return {};
  const std::vector<double> posteriors = node_posteriors(coarse, before, backward(coarse, before));

  NodeMask mask;
  for (int e = 0; e < fine.evidence_states(); ++e) {
    const int first = fine.first_cell(e);
    mask.alive.emplace_back(static_cast<std::size_t>(fine.last_cell(e) - first + 1), false);
    std::vector<bool>& alive = mask.alive.back();
    for (int cell = coarse.first_cell(e); cell <= coarse.last_cell(e); ++cell) {
      double probability = 0;
      for (int state = 0; state < coarse.states(); ++state)
        probability += posteriors[coarse.node(cell, state, e)];
      if (probability < kNegligible) continue;
      const double ratio = grid.step_m / fine.grid().step_m;
      const int from = std::max(first, static_cast<int>(std::floor((cell - kMargin) * ratio)));
      const int to = std::min(fine.last_cell(e), static_cast<int>(std::ceil((cell + kMargin) * ratio)));
      for (int n = from; n <= to; ++n) alive[static_cast<std::size_t>(n - first)] = true;
    }
  }
  return mask;
}

}  // namespace gramap
