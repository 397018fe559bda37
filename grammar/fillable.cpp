#include "grammar/fillable.h"

#include <cmath>
#include <string>

#include "geometry/error.h"
#include "geometry/say.h"
#include "grammar/evidence.h"
#include "grammar/inference.h"
#include "grammar/lattice.h"
#include "grammar/placed_rooms.h"

namespace gramap {
namespace {

constexpr double kSearchStep_m = 0.05;
constexpr double kFarthest_m = 10;

}  // namespace

bool can_fill(const RuleSet& rules, const SpaceProblem& problem, double length_m, double grid_m) {
  SpaceProblem bare;
  bare.id = problem.id;
  bare.length_m = length_m;
  const Grid grid = make_grid(length_m, rules.inner_wall_m, grid_m);
  const CompiledRow compiled = compile_row(rules, {problem.depth_m, problem.hallway, problem.facade}, grid);
  if (compiled.fault) return false;
  const Evidence evidence(rules, bare, {}, grid);
  const Lattice lattice(compiled.row, grid, evidence);
  return std::isfinite(log_total(lattice, forward(lattice)));
}

std::optional<double> nearest_fillable_m(const RuleSet& rules, const SpaceProblem& problem,
                                         const FitOptions& options) {
  const double grid_m = std::max(options.grid_m, 0.02);  // the message is to 5 cm, so this is fine enough
  for (int step = 1; step * kSearchStep_m <= kFarthest_m; ++step) {
    for (const int sign : {-1, 1}) {
      const double length = problem.length_m + sign * step * kSearchStep_m;
      if (length < 0.5 * problem.length_m || length > 2 * problem.length_m) continue;
      if (can_fill(rules, problem, length, grid_m)) return length;
    }
  }
  return std::nullopt;
}

void refuse_unfillable(const RuleSet& rules, const SpaceProblem& problem, const FitOptions& options) {
  std::string names;
  for (const Rule& rule : rules.rules)
    if (rule.symbol == 0) names += (names.empty() ? "" : ", ") + rule.name;
  const std::optional<double> nearest = nearest_fillable_m(rules, problem, options);
  throw InputError({},
                   "space " + problem.id + ": no layout of the rules of " + rules.symbols.front() + " (" +
                       names + ") fills its " + said_metres(problem.length_m),
                   nearest ? "the nearest length that they can fill is " + said_metres(*nearest)
                           : "they fill no length near it; see `gramap check --lengths`");
}

void refuse_fault(const RuleSet& rules, const SpaceProblem& problem, const CompiledRow& compiled) {
  if (compiled.fault)
    throw InputError({}, "space " + problem.id + ": rule " + rule_name(rules, compiled.fault->rule) + ": " +
                             compiled.fault->message);
}

}  // namespace gramap
