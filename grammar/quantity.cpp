#include "grammar/quantity.h"

#include <cmath>

#include "grammar/suggest.h"

namespace gramap {

using syntax::Expr;

Quantities::Quantities(const syntax::File& file, std::vector<Diagnostic>& diagnostics)
    : file_(file), diagnostics_(diagnostics) {
  for (const syntax::Let& let : file.lets) {
    const auto [it, fresh] = lets_.try_emplace(let.name.text);
    if (fresh) {
      it->second.let = &let;
      continue;
    }
    diagnostics_.push_back({Severity::error,
                            "E0203",
                            "the constant `" + let.name.text + "` is defined twice",
                            let.name.span,
                            {{it->second.let->name.span, "first defined here"}},
                            {},
                            "give one of them another name"});
  }
  for (const syntax::Let& let : file.lets) {  // faults of constants that nothing uses are faults, too
    Constant& constant = lets_.at(let.name.text);
    const bool used = constant.used;
    if (constant.let == &let) named(Expr{Expr::Kind::name, let.name.span, 0, let.name.text, {}, 1});
    constant.used = used;
  }
}

void Quantities::fault(std::string code, const Expr& at, std::string message, std::string help) {
  diagnostics_.push_back(
      {Severity::error, std::move(code), std::move(message), at.span, {}, {}, std::move(help)});
}

std::optional<Value> Quantities::named(const Expr& expr) {
  const auto it = lets_.find(expr.text);
  if (it == lets_.end()) {
    if (file_.broken.contains(expr.text)) return std::nullopt;
    if (expr.text == "left" || expr.text == "right") {
      fault("E0304", expr,
            "`" + expr.text + "` is known only where a hallway grows, so it can stand only in a condition",
            "write it in a production's condition: `name: Trunk : " + expr.text +
                " > 9 m -> …;`; a branch to that side is `" + expr.text + " { … }`");
      return std::nullopt;
    }
    if (is_attribute(expr.text)) {
      fault("E0304", expr,
            "`" + expr.text + "` is known only when a space is split, so it can stand only in a condition",
            "write it in a rule's condition: `name: Space : " + expr.text + " … -> …;`");
      return std::nullopt;
    }
    std::vector<std::string_view> names;
    for (const auto& [name, constant] : lets_) names.push_back(name);
    const std::string near = nearest(expr.text, names);
    if (!near.empty()) lets_.at(near).used = true;
    fault("E0202", expr, "there is no constant `" + expr.text + "`",
          near.empty() ? "define it: `let " + expr.text + " = 1.00 m;`" : "did you mean `" + near + "`?");
    return std::nullopt;
  }
  Constant& constant = it->second;
  constant.used = true;
  if (constant.state == Constant::State::working) {
    fault("E0205", expr, "the constant `" + expr.text + "` is defined by itself",
          "give it a value that does not depend on it");
    return std::nullopt;
  }
  if (constant.state == Constant::State::unseen) {
    constant.state = Constant::State::working;
    constant.value = evaluate(constant.let->value);
    constant.state = Constant::State::done;
  }
  return constant.value;
}

namespace {

std::string kind_name(Value::Kind kind) {
  return kind == Value::Kind::length  ? "a length"
         : kind == Value::Kind::share ? "a share in per cent"
                                      : "a number";
}

}  // namespace

std::optional<Value> Quantities::binary(const Expr& expr) {
  const std::optional<Value> left = evaluate(expr.children[0]);
  const std::optional<Value> right = evaluate(expr.children[1]);
  if (!left || !right) return std::nullopt;
  using enum Value::Kind;
  const bool adds = expr.kind == Expr::Kind::plus || expr.kind == Expr::Kind::minus;
  Value value;
  if (adds) {
    if (left->kind != right->kind && (left->kind == share || right->kind == share)) {
      fault("E0301", expr,
            kind_name(left->kind) + " and " + kind_name(right->kind) + " cannot be " +
                (expr.kind == Expr::Kind::plus ? "added" : "subtracted"),
            "add lengths to lengths: `axis + 0.20 m`");
      return std::nullopt;
    }
    value.kind = left->kind == length || right->kind == length ? length : left->kind;
    value.number =
        expr.kind == Expr::Kind::plus ? left->number + right->number : left->number - right->number;
  } else if (expr.kind == Expr::Kind::times) {
    if (left->kind == length && right->kind == length) {
      fault("E0301", expr, "the product of two lengths is an area, and nothing here takes an area",
            "multiply a length by a number: `2*axis`");
      return std::nullopt;
    }
    value.kind = left->kind == length || right->kind == length ? length
                 : left->kind == share && right->kind == share ? share
                                                               : plain;
    value.number = left->number * right->number;
  } else {
    if (right->kind == length && left->kind != length) {
      fault("E0301", expr, kind_name(left->kind) + " cannot be divided by a length",
            "divide a length by a length or by a number");
      return std::nullopt;
    }
    if (right->number == 0) {
      fault("E0302", expr.children[1], "this divides by zero");
      return std::nullopt;
    }
    value.kind = left->kind == length && right->kind != length ? length
                 : left->kind == share && right->kind == plain ? share
                                                               : plain;
    value.number = left->number / right->number;
  }
  if (!std::isfinite(value.number)) {
    fault("E0004", expr, "this number is too large or too small to be stored");
    return std::nullopt;
  }
  return value;
}

std::optional<Value> Quantities::evaluate(const Expr& expr) {
  switch (expr.kind) {
    case Expr::Kind::number: {
      if (expr.text.empty()) return Value{Value::Kind::plain, expr.number};
      if (expr.text == "m") return Value{Value::Kind::length, expr.number};
      if (expr.text == "cm") return Value{Value::Kind::length, expr.number / 100};
      if (expr.text == "mm") return Value{Value::Kind::length, expr.number / 1000};
      if (expr.text == "%") return Value{Value::Kind::share, expr.number / 100};
      fault("E0303", expr, "there is no unit `" + expr.text + "`",
            "lengths are in `m`, `cm` or `mm`, shares in `%`; a product is written with `*`");
      return std::nullopt;
    }
    case Expr::Kind::name:
      return named(expr);
    case Expr::Kind::negate: {
      std::optional<Value> value = evaluate(expr.children[0]);
      if (value) value->number = -value->number;
      return value;
    }
    case Expr::Kind::plus:
    case Expr::Kind::minus:
    case Expr::Kind::times:
    case Expr::Kind::divide:
      return binary(expr);
    default:
      fault("E0305", expr,
            expr.kind == Expr::Kind::text ? "a text stands where a quantity is expected"
                                          : "a condition stands where a quantity is expected",
            "write a length, such as `2.80 m`, or a number");
      return std::nullopt;
  }
}

std::optional<double> Quantities::length(const Expr& expr) {
  const std::optional<Value> value = evaluate(expr);
  if (!value) return std::nullopt;
  if (value->kind == Value::Kind::share) {
    fault("E0301", expr, "a share in per cent stands where a length is expected",
          "write a length, such as `2.80 m`");
    return std::nullopt;
  }
  return value->number;
}

std::optional<double> Quantities::positive_length(const Expr& expr, const std::string& what) {
  const std::optional<double> metres = length(expr);
  if (!metres) return std::nullopt;
  if (*metres > 0 && *metres <= 1000) return metres;
  if (*metres <= 0)
    fault("E0306", expr, what + " must be greater than zero");
  else
    fault("E0306", expr, what + " is more than 1000 m",
          "numbers without a unit are metres; write `cm` or `mm` behind the number");
  return std::nullopt;
}

void Quantities::expect_same_unit(const Expr& a, const Expr& b) {
  const auto bare = [](const Expr& e) { return e.kind == Expr::Kind::number && e.text.empty(); };
  const auto small = [](const Expr& e) {
    return e.kind == Expr::Kind::number && (e.text == "cm" || e.text == "mm");
  };
  const Expr* alone = bare(a) && small(b) ? &a : bare(b) && small(a) ? &b : nullptr;
  if (alone != nullptr)
    fault("E0307", *alone,
          "this number has no unit, and the one beside it is in `" + (alone == &a ? b : a).text + "`",
          "write the unit of both");
}

std::optional<Normal> Quantities::normal(const syntax::Quantity& quantity, const std::string& what) {
  const std::optional<double> mean = positive_length(quantity.mean, what);
  if (!quantity.sd) return mean ? std::optional(Normal{*mean, 0}) : std::nullopt;
  expect_same_unit(quantity.mean, *quantity.sd);
  const std::optional<double> sd = length(*quantity.sd);
  if (!mean || !sd) return std::nullopt;
  if (*sd < 0 || *sd > *mean) {
    fault("E0308", *quantity.sd, "a spread must be between zero and the value that it belongs to",
          "write a standard deviation: `2.80 m +- 5 cm`");
    return std::nullopt;
  }
  return Normal{*mean, *sd};
}

std::optional<double> Quantities::weight(const Expr& expr) {
  const std::optional<Value> value = evaluate(expr);
  if (!value) return std::nullopt;
  if (value->kind == Value::Kind::length || value->number < 0) {
    fault("E0401", expr,
          value->kind == Value::Kind::length ? "a length stands where a probability is expected"
                                             : "a probability cannot be negative",
          "write a number such as `0.5`, or per cent such as `50 %`");
    return std::nullopt;
  }
  return value->number;
}

void Quantities::report_unused() {
  for (const syntax::Let& let : file_.lets) {
    const Constant& constant = lets_.at(let.name.text);
    if (constant.let == &let && !constant.used && !file_.broken.contains(let.name.text))
      diagnostics_.push_back({Severity::warning,
                              "W0204",
                              "nothing uses the constant `" + let.name.text + "`",
                              let.name.span,
                              {},
                              {},
                              "use it or remove it"});
  }
}

}  // namespace gramap
