#include "grammar/condition.h"

#include <algorithm>
#include <variant>
#include <vector>

namespace gramap {
namespace {

using Value = std::variant<double, std::string>;

double number(const Value& value) {
  const double* number = std::get_if<double>(&value);
  return number != nullptr ? *number : 0.0;
}

Value attribute_value(Condition::Attribute attribute, const SpaceAttributes& space, double remaining_m) {
  switch (attribute) {
    case Condition::Attribute::length:
      return remaining_m;
    case Condition::Attribute::depth:
      return space.depth_m;
    case Condition::Attribute::hallway:
      return space.hallway;
    case Condition::Attribute::facade:
      return space.facade ? 1.0 : 0.0;
    case Condition::Attribute::left:
      return space.left_m;
    case Condition::Attribute::right:
      return space.right_m;
  }
  return 0.0;
}

bool compare(Condition::Op op, const Value& left, const Value& right) {
  using Op = Condition::Op;
  if (op == Op::equal) return left == right;
  if (op == Op::not_equal) return left != right;
  if (left.index() != 0 || right.index() != 0) return false;
  const double a = number(left);
  const double b = number(right);
  switch (op) {
    case Op::less:
      return a < b;
    case Op::less_equal:
      return a <= b;
    case Op::greater:
      return a > b;
    default:
      return a >= b;
  }
}

Value evaluate(const Condition::Node& node, const std::vector<Value>& values, const SpaceAttributes& space,
               double remaining_m) {
  using Op = Condition::Op;
  const auto left = [&] { return values[static_cast<std::size_t>(node.left)]; };
  const auto right = [&] { return values[static_cast<std::size_t>(node.right)]; };
  switch (node.op) {
    case Op::number:
      return node.number;
    case Op::text:
      return node.text;
    case Op::attribute:
      return attribute_value(node.attribute, space, remaining_m);
    case Op::plus:
      return number(left()) + number(right());
    case Op::minus:
      return number(left()) - number(right());
    case Op::times:
      return number(left()) * number(right());
    case Op::divide:
      return number(left()) / number(right());
    case Op::land:
      return number(left()) != 0 && number(right()) != 0 ? 1.0 : 0.0;
    case Op::lor:
      return number(left()) != 0 || number(right()) != 0 ? 1.0 : 0.0;
    case Op::lnot:
      return number(left()) == 0 ? 1.0 : 0.0;
    default:
      return compare(node.op, left(), right()) ? 1.0 : 0.0;
  }
}

}  // namespace

bool holds(const Condition& condition, const SpaceAttributes& space, double remaining_m) {
  if (condition.nodes.empty()) return true;
  std::vector<Value> values;
  values.reserve(condition.nodes.size());
  for (const Condition::Node& node : condition.nodes)
    values.push_back(evaluate(node, values, space, remaining_m));
  return number(values.back()) != 0;
}

bool depends_on_length(const Condition& condition) {
  return std::any_of(condition.nodes.begin(), condition.nodes.end(), [](const Condition::Node& node) {
    return node.op == Condition::Op::attribute && node.attribute == Condition::Attribute::length;
  });
}

}  // namespace gramap
