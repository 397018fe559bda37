#include "grammar/likelihood.h"

#include <cmath>
#include <limits>

#include "geometry/error.h"
#include "grammar/inference.h"
#include "grammar/like_scanned.h"

namespace gramap {
namespace {

double log_sum(const RuleSet& rules, const Row& row, const Grid& grid, const SpaceProblem& problem,
               const FitOptions& options, const std::vector<double>& whole_factor = {}) {
  const Evidence evidence(rules, problem, options, grid, whole_factor);
  const Lattice lattice(row, grid, evidence, Lattice::Passes::one);
  return log_total(lattice, forward(lattice));
}

}  // namespace

double log_joint(const RuleSet& rules, const SpaceProblem& problem, const FitOptions& options) {
  const Grid grid = make_grid(problem.length_m, rules.inner_wall_m, options.grid_m);
  const CompiledRow compiled = compile_row(rules, {problem.depth_m, problem.hallway, problem.facade}, grid);
  if (compiled.fault) throw InputError({}, "space " + problem.id + ": " + compiled.fault->message);
  return log_sum(rules, compiled.row, grid, problem, options);
}

double log_likelihood(const RuleSet& rules, const SpaceProblem& problem, const FitOptions& options) {
  const Grid grid = make_grid(problem.length_m, rules.inner_wall_m, options.grid_m);
  const CompiledRow compiled = compile_row(rules, {problem.depth_m, problem.hallway, problem.facade}, grid);
  if (compiled.fault) throw InputError({}, "space " + problem.id + ": " + compiled.fault->message);
  SpaceProblem bare = problem;
  bare.rooms.clear();
  bare.doors.clear();
  bare.doors_visible.clear();
  const double filling = log_sum(rules, compiled.row, grid, bare, options);
  if (!std::isfinite(filling)) return -std::numeric_limits<double>::infinity();
  return log_sum(rules, compiled.row, grid, problem, options) - filling;
}

double log_predictive(const RuleSet& rules, const SpaceProblem& observed,
                      const std::vector<RoomEvidence>& rooms, const FitOptions& options) {
  const Grid grid = make_grid(observed.length_m, rules.inner_wall_m, options.grid_m);
  CompiledRow compiled = compile_row(rules, {observed.depth_m, observed.hallway, observed.facade}, grid);
  if (compiled.fault) throw InputError({}, "space " + observed.id + ": " + compiled.fault->message);
  std::vector<double> factors = expect_as_scanned(rules, observed, options.likeness, compiled.row);
  const double before = log_sum(rules, compiled.row, grid, observed, options, factors);
  if (!std::isfinite(before)) return -std::numeric_limits<double>::infinity();
  SpaceProblem all = observed;
  all.rooms.insert(all.rooms.end(), rooms.begin(), rooms.end());
  if (!factors.empty()) factors.resize(all.rooms.size(), 1);
  return log_sum(rules, compiled.row, grid, all, options, factors) - before;
}

}  // namespace gramap
