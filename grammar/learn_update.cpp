#include "grammar/learn_update.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "geometry/error.h"
#include "grammar/inference.h"
#include "grammar/language.h"
#include "grammar/row_evidence.h"
#include "grammar/space.h"
#include "grammar/syntax.h"

namespace gramap {
namespace {

SpaceProblem problem_of(const KnownRow& row, double wall_m, double sigma_m) {
  SpaceProblem problem;
  problem.id = row.space;
  problem.length_m = row.length_m;
  problem.hallway = row.hallway;
  for (const KnownRoom& room : row.rooms) problem.depth_m = std::max(problem.depth_m, room.depth_m);
  problem.rooms = row_evidence(row, wall_m, sigma_m, sigma_m, 0.9);
  return problem;
}

/// Adds the expected uses of each rule, given the evidence; false when no derivation fills the space.
bool add_expected_uses(const RuleSet& rules, const SpaceProblem& problem, double grid_m,
                       std::vector<double>& uses) {
  FitOptions options;
  options.grid_m = grid_m;
  const Grid grid = make_grid(problem.length_m, rules.inner_wall_m, grid_m);
  const CompiledRow compiled = compile_row(rules, {problem.depth_m, problem.hallway, problem.facade}, grid);
  if (compiled.fault) return false;
  const Evidence evidence(rules, problem, options, grid);
  const Lattice lattice(compiled.row, grid, evidence);
  const NodeTable before = forward(lattice);
  const double total = log_total(lattice, before);
  if (!std::isfinite(total)) return false;
  const NodeTable behind = backward(lattice, before);
  Edges edges(lattice);
  for (int cell = 0; cell < grid.cells; ++cell) {
    const double scale = before.log_scale[static_cast<std::size_t>(cell)] - total;
    for_each_node(lattice, cell, [&](int e, int state, std::size_t node) {
      if (before.value[node] <= 0) return;
      for (const Arc& arc : lattice.arcs(state, cell)) {
        double probability = 0;
        for (const Move& move : edges.moves(cell, arc.element, e)) {
          const double* target =
              &behind.value[lattice.node(move.first_cell, arc.target, move.target_evidence)];
          for (int i = 0; i < move.count; ++i) {
            const double weight = move.sum[i] * target[i * move.stride];
            if (weight <= 0) continue;
            const auto reached = static_cast<std::size_t>(move.first_cell + i * move.stride);
            probability += weight * std::exp(behind.log_scale[reached] + scale);
          }
        }
        probability *= before.value[node] * arc.probability;
        for (const DerivationStep& step : arc.steps)
          if (step.rule >= 0) uses[static_cast<std::size_t>(step.rule)] += probability;
        for (const InnerUse& use : compiled.row.elements[static_cast<std::size_t>(arc.element)].uses)
          uses[static_cast<std::size_t>(use.rule)] += probability;
      }
    });
  }
  return true;
}

struct Replacement {
  Span span;
  std::string text;
};

std::string as_written(double share, const std::string& unit) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", unit == "%" ? 100 * share : share);
  return text + (unit == "%" ? std::string(" %") : std::string());
}

}  // namespace

UpdatedRules update_rules(const std::string& text, const std::string& name, const LearnData& data,
                          const UpdateOptions& options) {
  const CheckedRules checked = check_rules(text, name);
  if (!checked.rules)
    throw InputError({name}, "this rule file has errors", "gramap check names them; mend them first");
  const RuleSet& rules = *checked.rules;
  UpdatedRules updated;
  std::vector<double> uses(rules.rules.size(), 0);
  std::size_t made = 0;
  for (const KnownRow& row : data.rows) {
    if (!row.whole || row.rooms.empty()) continue;
    const SpaceProblem problem = problem_of(row, data.inner_wall_m, options.width_sigma_m);
    if (add_expected_uses(rules, problem, options.grid_m, uses))
      ++made;
    else
      updated.unfilled.push_back(row.floor + ", " + row.space);
  }
  if (made == 0)
    throw InputError({name}, "these rules can make none of the rows to learn from",
                     "learn without --update, or give the rules a background");

  // Rules compete with those of their symbol.
  std::map<std::string, const syntax::Rule*> written;
  const syntax::File file = syntax::parse(text);
  for (const syntax::Rule& rule : file.rules) written[rule.name.text] = &rule;
  struct Symbol {
    double shares = 0, uses = 0;
    std::vector<std::size_t> rules;
  };
  std::map<int, Symbol> symbols;
  for (std::size_t r = 0; r < rules.rules.size(); ++r) {
    const Rule& rule = rules.rules[r];
    const auto found = written.find(rule.name);
    const bool plain = found != written.end() && found->second->probability &&
                       found->second->probability->kind == syntax::Expr::Kind::number;
    if (!plain) {
      if (uses[r] > 0.5) updated.left_alone.push_back(rule.name);
      continue;
    }
    Symbol& symbol = symbols[rule.symbol];
    symbol.shares += rule.probability;
    symbol.uses += uses[r];
    symbol.rules.push_back(r);
  }
  std::vector<Replacement> replacements;
  for (const auto& [index, symbol] : symbols) {
    if (symbol.rules.size() < 2 || symbol.uses <= 0 || symbol.shares <= 0) continue;
    for (const std::size_t r : symbol.rules) {
      const double share = rules.rules[r].probability / symbol.shares;
      const double now = (options.weight * share + uses[r]) / (options.weight + symbol.uses);
      const syntax::Expr& number = *written.at(rules.rules[r].name)->probability;
      replacements.push_back({number.span, as_written(symbol.shares * now, number.text)});
    }
  }
  updated.text = text;
  std::sort(replacements.begin(), replacements.end(),
            [](const Replacement& a, const Replacement& b) { return a.span.begin > b.span.begin; });
  for (const Replacement& replacement : replacements)
    updated.text.replace(replacement.span.begin, replacement.span.end - replacement.span.begin,
                         replacement.text);
  updated.probabilities = static_cast<int>(replacements.size());
  return updated;
}

}  // namespace gramap
