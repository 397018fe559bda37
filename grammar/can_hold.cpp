// Conditions that never hold, found by trying values around every number that they can compare with.
#include <algorithm>

#include "grammar/condition.h"
#include "grammar/resolve.h"

namespace gramap {
namespace {

constexpr std::size_t kMostNodes = 30;       // a longer condition is taken on trust,
constexpr std::size_t kMostTrials = 500000;  // and so is one with too many values to try

bool is_arithmetic(Condition::Op op) {
  return op == Condition::Op::plus || op == Condition::Op::minus || op == Condition::Op::times ||
         op == Condition::Op::divide;
}

std::vector<double> values_to_try(const Condition& condition) {
  std::vector<double> numbers;
  bool computes = false;
  for (const Condition::Node& node : condition.nodes) {
    if (node.op == Condition::Op::number) numbers.push_back(node.number);
    computes = computes || is_arithmetic(node.op);
  }
  std::vector<double> thresholds = numbers;
  if (computes) {
    for (const double a : numbers) {
      for (const double b : numbers) {
        thresholds.insert(thresholds.end(), {a + b, a - b, a * b});
        if (b != 0) thresholds.push_back(a / b);
      }
    }
  }
  std::vector<double> values{0.01, 1, 3, 10, 30, 100, 1000};
  for (const double t : thresholds)
    for (const double value : {t - 1e-6, t, t + 1e-6})
      if (value > 0) values.push_back(value);
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

}  // namespace

bool can_hold(const Condition& condition) {
  if (condition.nodes.empty() || condition.nodes.size() > kMostNodes) return true;
  const auto asks_for = [&](Condition::Attribute attribute) {
    return std::any_of(condition.nodes.begin(), condition.nodes.end(), [&](const Condition::Node& node) {
      return node.op == Condition::Op::attribute && node.attribute == attribute;
    });
  };
  const std::vector<double> values = values_to_try(condition), one{1};
  using enum Condition::Attribute;
  std::size_t trials = 1;
  const auto choices = [&](Condition::Attribute attribute) -> const std::vector<double>& {
    if (!asks_for(attribute)) return one;
    trials *= values.size();
    return values;
  };
  const std::vector<double>&lengths = choices(length), &depths = choices(depth), &lefts = choices(left),
        &rights = choices(right);
  if (trials > kMostTrials) return true;
  std::vector<std::string> hallways{""};
  for (const Condition::Node& node : condition.nodes)
    if (node.op == Condition::Op::text) hallways.push_back(node.text);
  for (const double length_m : lengths)
    for (const double depth_m : depths)
      for (const double left_m : lefts)
        for (const double right_m : rights)
          for (const std::string& on : hallways)
            for (const bool with_facade : {false, true})
              if (holds(condition, {depth_m, on, with_facade, left_m, right_m}, length_m)) return true;
  return false;
}

}  // namespace gramap
