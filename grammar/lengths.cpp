#include "grammar/lengths.h"

#include <cmath>

#include "grammar/derive.h"
#include "grammar/fillable.h"

namespace gramap {
namespace {

constexpr double kGrid_m = 0.02;

}  // namespace

std::vector<UnfillableRange> unfillable_ranges(const RuleSet& rules, const SpaceProblem& space,
                                               double least_m, double most_m, double step_m) {
  std::vector<UnfillableRange> ranges;
  const int steps = static_cast<int>(std::floor((most_m - least_m) / step_m + 1e-9));
  bool filled_before = true;
  for (int i = 0; i <= steps; ++i) {
    const double length_m = least_m + i * step_m;
    const bool fills = can_fill(rules, space, length_m, kGrid_m);
    if (!fills && filled_before) ranges.push_back({length_m, length_m});
    if (!fills) ranges.back().last_m = length_m;
    filled_before = fills;
  }
  return ranges;
}

std::vector<RuleFrequency> rule_frequencies(const RuleSet& rules, const SpaceProblem& space,
                                            double length_m) {
  SpaceProblem of_length = space;
  of_length.length_m = length_m;
  const SpaceDeriver deriver(rules, of_length, kGrid_m);
  const DerivationStatistics statistics = exact_statistics(rules, deriver);
  std::vector<double> stated(rules.symbols.size());
  std::vector<double> expected(rules.symbols.size());
  for (std::size_t i = 0; i < rules.rules.size(); ++i) {
    stated[static_cast<std::size_t>(rules.rules[i].symbol)] += rules.rules[i].probability;
    expected[static_cast<std::size_t>(rules.rules[i].symbol)] += statistics.rules[i];
  }
  std::vector<RuleFrequency> uses;
  for (std::size_t i = 0; i < rules.rules.size(); ++i) {
    const auto symbol = static_cast<std::size_t>(rules.rules[i].symbol);
    RuleFrequency use;
    use.expected = statistics.rules[i];
    if (stated[symbol] > 0) use.stated = rules.rules[i].probability / stated[symbol];
    if (expected[symbol] > 0) use.share = statistics.rules[i] / expected[symbol];
    uses.push_back(use);
  }
  return uses;
}

}  // namespace gramap
