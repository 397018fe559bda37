#include "grammar/learn_filling.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "grammar/design_effect.h"
#include "grammar/expected_uses.h"
#include "grammar/language.h"
#include "grammar/row_evidence.h"

namespace gramap {
namespace {

constexpr double kGrid_m = 0.05;
constexpr int kRounds = 6;
constexpr double kPrior = 10;            // uses that the untilted probabilities are worth
constexpr std::size_t kMostSpaces = 40;  // of different lengths; more tell no more

/// The data's spaces by length, alike ones once: what derivations have to fill.
struct Space {
  SpaceProblem problem;
  double count = 0;
};

std::vector<Space> spaces_of(const LearnData& data) {
  std::map<std::pair<long, long>, Space> by_size;
  for (const KnownRow& row : data.rows) {
    if (!row.whole) continue;
    SpaceProblem problem = bare_problem(row);
    Space& space = by_size[{std::lround(problem.length_m / kGrid_m), std::lround(problem.depth_m / kGrid_m)}];
    space.problem = std::move(problem);
    space.count += 1;
  }
  std::vector<Space> spaces;
  for (auto& [size, space] : by_size) spaces.push_back(std::move(space));
  return spaces;
}

/// How often each rule is expected in the spaces; those that cannot be filled are left out.
std::vector<double> expected_uses(const LearnedRules& learned, const std::vector<Space>& spaces) {
  std::vector<double> uses(learned.rules.size(), 0);
  const CheckedRules checked = check_rules(to_text(learned), "learned");
  if (!checked.rules) return uses;
  std::map<std::string, std::size_t> index;
  for (std::size_t r = 0; r < learned.rules.size(); ++r) index[learned.rules[r].name] = r;
  const std::size_t stride = (spaces.size() + kMostSpaces - 1) / kMostSpaces;
  double asked = 0, all = 0;
  for (std::size_t i = 0; i < spaces.size(); ++i) {
    all += spaces[i].count;
    if (i % stride != 0) continue;
    ExpectedUses expected(*checked.rules);
    if (!expected.add(spaces[i].problem, kGrid_m)) continue;
    asked += spaces[i].count;
    for (std::size_t r = 0; r < checked.rules->rules.size(); ++r)
      if (const auto known = index.find(checked.rules->rules[r].name); known != index.end())
        uses[known->second] += spaces[i].count * expected.rules[r];
  }
  for (double& use : uses) use *= asked > 0 ? all / asked : 0;
  return uses;
}

/// Every symbol's probabilities add up to what they did before.
void tilt(LearnedRules& rules, const std::vector<double>& factors) {
  for (const bool first : {true, false}) {
    double before = 0, after = 0;
    for (std::size_t r = 0; r < rules.rules.size(); ++r) {
      LearnedRule& rule = rules.rules[r];
      if (rule.first != first) continue;
      before += rule.probability;
      rule.probability *= factors[r];
      after += rule.probability;
    }
    for (LearnedRule& rule : rules.rules)
      if (rule.first == first && after > 0) rule.probability *= before / after;
  }
  for (LearnedRule& rule : rules.rules) {
    double named = 0, tilted = 0;
    for (auto& [next, share] : rule.after) {
      named += share;
      share *= factors[static_cast<std::size_t>(next)];
      tilted += share;
    }
    const double all = tilted + (1 - named);
    for (auto& [next, share] : rule.after) share /= all;
  }
}

}  // namespace

void match_filling(LearnedRules& rules, const std::vector<std::vector<int>>& uses) {
  std::vector<double> used(rules.rules.size(), 0);
  std::vector<std::set<std::string>> floors(rules.rules.size());
  for (std::size_t row = 0; row < uses.size(); ++row) {
    if (!rules.data.rows[row].whole) continue;
    for (const int rule : uses[row]) {
      used[static_cast<std::size_t>(rule)] += 1;
      floors[static_cast<std::size_t>(rule)].insert(rules.data.rows[row].floor);
    }
  }
  const std::vector<Space> spaces = spaces_of(rules.data);
  std::vector<double> logarithms(rules.rules.size(), 0);
  for (int round = 0; round < kRounds; ++round) {
    const std::vector<double> expected = expected_uses(rules, spaces);
    std::vector<double> factors(rules.rules.size(), 1);
    for (std::size_t r = 0; r < factors.size(); ++r) {
      if (rules.rules[r].any_type >= 0) continue;
      const double design = used[r] > 0 ? design_effect(used[r], static_cast<double>(floors[r].size())) : 1;
      // Newton's step, as if uses were Poisson's.
      const double slope = (used[r] - expected[r]) / design - kPrior * logarithms[r];
      const double step = std::clamp(slope / (expected[r] / design + kPrior), -1.0, 1.0);
      logarithms[r] += step;
      factors[r] = std::exp(step);
    }
    tilt(rules, factors);
  }
}

}  // namespace gramap
