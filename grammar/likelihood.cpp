#include "grammar/likelihood.h"

#include <cmath>
#include <limits>

#include "geometry/error.h"
#include "grammar/inference.h"

namespace gramap {
namespace {

double log_sum(const RuleSet& rules, const Row& row, const Grid& grid, const SpaceProblem& problem,
               const FitOptions& options) {
  const Evidence evidence(rules, problem, options, grid);
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

}  // namespace gramap
