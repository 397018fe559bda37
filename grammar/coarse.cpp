#include "grammar/coarse.h"

#include <algorithm>
#include <cmath>

#include "grammar/inference.h"
#include "grammar/like_scanned.h"

namespace gramap {
namespace {

constexpr double kCoarseness = 8;        // coarse step / fine step
constexpr double kFinestCoarse_m = 0.1;  // no wider coarse steps than this: narrow rooms would vanish in them
constexpr double kNegligible = 1e-7;
constexpr int kMargin = 1;  // coarse cells kept around those that matter: what the coarse grid rounds off

/// The evidence state at a cell of the fine lattice that a coarse one stands for: evidence of which the
/// coarse grid is not sure yet that it has passed by.
int without_passed(const Lattice& fine, int cell, int evidence_state) {
  if (evidence_state % 2 == 1) return evidence_state;
  const auto& rooms = fine.evidence().rooms();
  auto next = static_cast<std::size_t>(evidence_state / 2);
  while (next < rooms.size() && rooms[next].last_start < cell) ++next;
  return 2 * static_cast<int>(next);
}

}  // namespace

NodeMask coarse_mask(const RuleSet& rules, const SpaceProblem& problem, const FitOptions& options,
                     const Lattice& fine) {
  const double step_m = kCoarseness * fine.grid().step_m;
  if (step_m > kFinestCoarse_m) return {};
  const Grid grid = make_grid(problem.length_m, rules.inner_wall_m, step_m);
  CompiledRow compiled = compile_row(rules, {problem.depth_m, problem.hallway, problem.facade}, grid);
  if (compiled.fault) return {};
  const Evidence evidence(rules, problem, options, grid,
                          expect_as_scanned(rules, problem, options.likeness, compiled.row));
  const Lattice coarse(compiled.row, grid, evidence);
  const NodeTable before = forward(coarse);
  if (!std::isfinite(log_total(coarse, before))) return {};
  const std::vector<double> posteriors = node_posteriors(coarse, before, backward(coarse, before));

  NodeMask mask;
  for (int e = 0; e < fine.evidence_states(); ++e)
    mask.alive.emplace_back(static_cast<std::size_t>(fine.last_cell(e) - fine.first_cell(e) + 1), false);
  const double ratio = grid.step_m / fine.grid().step_m;
  for (int e = 0; e < coarse.evidence_states(); ++e) {
    for (int cell = coarse.first_cell(e); cell <= coarse.last_cell(e); ++cell) {
      double probability = 0;
      for (int state = 0; state < coarse.states(); ++state)
        probability += posteriors[coarse.node(cell, state, e)];
      if (probability < kNegligible) continue;
      const int from = std::max(0, static_cast<int>(std::floor((cell - kMargin) * ratio)));
      const int to = std::min(fine.grid().cells, static_cast<int>(std::ceil((cell + kMargin) * ratio)));
      for (int n = from; n <= to; ++n) {
        const int passed = without_passed(fine, n, e);
        if (n < fine.first_cell(passed) || n > fine.last_cell(passed)) continue;
        mask.alive[static_cast<std::size_t>(passed)][static_cast<std::size_t>(n - fine.first_cell(passed))] =
            true;
      }
    }
  }
  return mask;
}

}  // namespace gramap
