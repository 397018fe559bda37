#include "grammar/resolve.h"

namespace gramap {
namespace {

using syntax::Expr;

enum class Type { number, length, text, truth, fault };

std::string type_name(Type type) {
  return type == Type::number   ? "a number"
         : type == Type::length ? "a length"
         : type == Type::text   ? "a text"
                                : "a condition";
}

class Builder {
 public:
  Builder(Resolver& resolver, ConditionOf of) : r_(resolver), of_(of) {}

  Condition build(const Expr& expr) {
    const Type type = add(expr);
    if (type != Type::truth && type != Type::fault)
      fault(expr, type_name(type) + " stands where a condition is expected", "compare it: `length > 6 m`");
    return std::move(condition_);
  }

 private:
  void fault(const Expr& at, std::string message, std::string help) {
    r_.error("E0311", at.span, std::move(message), std::move(help));
  }

  int push(Condition::Node node) {
    condition_.nodes.push_back(std::move(node));
    return static_cast<int>(condition_.nodes.size()) - 1;
  }

  static bool has_attribute(const Expr& expr) {
    if (expr.kind == Expr::Kind::name) return is_attribute(expr.text);
    for (const Expr& child : expr.children)
      if (has_attribute(child)) return true;
    return false;
  }

  /// Adds the tree's nodes, its root last.
  Type add(const Expr& expr) {
    using enum Expr::Kind;
    if (expr.kind == text) {
      push({Condition::Op::text, 0, expr.text, {}, -1, -1});
      return Type::text;
    }
    if (expr.kind == name && has_attribute(expr)) return attribute(expr);
    const bool arithmetic = expr.kind == number || expr.kind == name || expr.kind == negate ||
                            expr.kind == plus || expr.kind == minus || expr.kind == times ||
                            expr.kind == divide;
    if (arithmetic && !has_attribute(expr)) {
      const std::optional<Value> value = r_.quantities.evaluate(expr);
      push({Condition::Op::number, value ? value->number : 0, "", {}, -1, -1});
      return !value ? Type::fault : value->kind == Value::Kind::length ? Type::length : Type::number;
    }
    if (expr.kind == negate || expr.kind == lnot) return unary(expr);
    return binary(expr);
  }

  Type attribute(const Expr& expr) {
    using enum Condition::Attribute;
    const auto which = expr.text == "length"    ? length
                       : expr.text == "depth"   ? depth
                       : expr.text == "hallway" ? hallway
                       : expr.text == "left"    ? left
                       : expr.text == "right"   ? right
                                                : facade;
    push({Condition::Op::attribute, 0, "", which, -1, -1});
    const bool of_hallways = which == left || which == right;
    if (which != length && of_hallways != (of_ == ConditionOf::hallway)) {
      if (of_hallways)
        r_.error("E0511", expr.span, "`" + expr.text + "` is known only where a hallway grows",
                 "a rule for rooms asks for `length`, `depth`, `hallway` or `facade`");
      else
        r_.error("E0511", expr.span, "`" + expr.text + "` is not yet known where a hallway grows",
                 "a production asks for `length`, `left` or `right`: how far the hallway can go there");
      return Type::fault;
    }
    return which == hallway ? Type::text : which == facade ? Type::truth : Type::length;
  }

  Type unary(const Expr& expr) {
    const bool negates = expr.kind == Expr::Kind::negate;
    const int zero = negates ? push({Condition::Op::number, 0, "", {}, -1, -1}) : -1;
    const Type type = add(expr.children[0]);
    const int operand = static_cast<int>(condition_.nodes.size()) - 1;
    if (negates)
      push({Condition::Op::minus, 0, "", {}, zero, operand});
    else
      push({Condition::Op::lnot, 0, "", {}, operand, -1});
    if (type == Type::fault) return type;
    if (negates ? type == Type::truth || type == Type::text : type != Type::truth) {
      fault(expr.children[0], type_name(type) + " cannot stand behind " + (negates ? "`-`" : "`not`"),
            "compare it: `not length > 6 m`");
      return Type::fault;
    }
    return type;
  }

  Type binary(const Expr& expr) {
    const Type left = add(expr.children[0]);
    const int left_index = static_cast<int>(condition_.nodes.size()) - 1;
    const Type right = add(expr.children[1]);
    const int right_index = static_cast<int>(condition_.nodes.size()) - 1;
    push({operation(expr.kind), 0, "", {}, left_index, right_index});
    if (left == Type::fault || right == Type::fault) return Type::fault;
    const auto is_numeric = [](Type t) { return t == Type::number || t == Type::length; };
    switch (expr.kind) {
      case Expr::Kind::land:
      case Expr::Kind::lor:
        if (left == Type::truth && right == Type::truth) return Type::truth;
        fault(left == Type::truth ? expr.children[1] : expr.children[0],
              type_name(left == Type::truth ? right : left) + " stands where a condition is expected",
              "`and` and `or` join conditions: `length > 6 m and length < 9 m`");
        return Type::fault;
      case Expr::Kind::equal:
      case Expr::Kind::not_equal:
        if (left == right || (is_numeric(left) && is_numeric(right))) return Type::truth;
        break;
      case Expr::Kind::plus:
      case Expr::Kind::minus:
        if (is_numeric(left) && is_numeric(right))
          return left == Type::length || right == Type::length ? Type::length : Type::number;
        break;
      case Expr::Kind::times:
        if (is_numeric(left) && is_numeric(right) && !(left == Type::length && right == Type::length))
          return left == Type::length || right == Type::length ? Type::length : Type::number;
        break;
      case Expr::Kind::divide:
        if (left == Type::length && is_numeric(right))
          return right == Type::length ? Type::number : Type::length;
        if (left == Type::number && right == Type::number) return Type::number;
        break;
      default:
        if (is_numeric(left) && is_numeric(right)) return Type::truth;
        break;
    }
    fault(expr, type_name(left) + " and " + type_name(right) + " do not go together here",
          "compare lengths with lengths: `length > 2*axis`, and texts with texts: `hallway == \"west\"`");
    return Type::fault;
  }

  static Condition::Op operation(Expr::Kind kind) {
    using enum Expr::Kind;
    switch (kind) {
      case plus:
        return Condition::Op::plus;
      case minus:
        return Condition::Op::minus;
      case times:
        return Condition::Op::times;
      case divide:
        return Condition::Op::divide;
      case less:
        return Condition::Op::less;
      case less_equal:
        return Condition::Op::less_equal;
      case greater:
        return Condition::Op::greater;
      case greater_equal:
        return Condition::Op::greater_equal;
      case equal:
        return Condition::Op::equal;
      case not_equal:
        return Condition::Op::not_equal;
      case land:
        return Condition::Op::land;
      default:
        return Condition::Op::lor;
    }
  }

  Resolver& r_;
  ConditionOf of_;
  Condition condition_;
};

}  // namespace

Condition resolve_condition(Resolver& resolver, const Expr& expr, ConditionOf of) {
  return Builder(resolver, of).build(expr);
}

}  // namespace gramap
