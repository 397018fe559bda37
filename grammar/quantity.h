// Arithmetic of the rule file: named constants, units, plain numbers that become metres where a length is
// expected.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "grammar/rules.h"
#include "grammar/syntax.h"

namespace gramap {

/// A number with its dimension. A plain number serves as a count, a factor, a share, or metres.
struct Value {
  enum class Kind { plain, length, share };
  Kind kind = Kind::plain;
  double number = 0;  ///< metres, or parts of one
};

/// A word that stands for something of a space or of a hallway's end; known in conditions only.
inline bool is_attribute(std::string_view word) {
  return word == "length" || word == "depth" || word == "hallway" || word == "facade" || word == "left" ||
         word == "right";
}

class Quantities {
 public:
  Quantities(const syntax::File& file, std::vector<Diagnostic>& diagnostics);

  /// None when a fault in it was reported (or its name belongs to a statement that could not be read).
  std::optional<Value> evaluate(const syntax::Expr& expr);
  /// Metres; a plain number counts as metres.
  std::optional<double> length(const syntax::Expr& expr);
  /// A length that must be greater than zero.
  std::optional<double> positive_length(const syntax::Expr& expr, const std::string& what);
  std::optional<Normal> normal(const syntax::Quantity& quantity, const std::string& what);
  /// A probability or weight: a plain number or per cent, not negative.
  std::optional<double> weight(const syntax::Expr& expr);
  /// Both of `1.00 x 2.10 m`, `+-` and `..`: a bare number beside one with a unit other than metres is a
  /// fault.
  void expect_same_unit(const syntax::Expr& a, const syntax::Expr& b);

  bool is_constant(const std::string& name) const { return lets_.contains(name); }
  /// Reports constants that nothing uses.
  void report_unused();

 private:
  std::optional<Value> binary(const syntax::Expr& expr);
  std::optional<Value> named(const syntax::Expr& expr);
  void fault(std::string code, const syntax::Expr& at, std::string message, std::string help = "");

  struct Constant {
    const syntax::Let* let = nullptr;
    std::optional<Value> value;
    enum class State { unseen, working, done } state = State::unseen;
    bool used = false;
  };
  const syntax::File& file_;
  std::vector<Diagnostic>& diagnostics_;
  std::map<std::string, Constant> lets_;
};

}  // namespace gramap
