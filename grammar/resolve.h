// The steps from syntax tree to rule set; check.cpp runs them.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "grammar/quantity.h"
#include "grammar/rules.h"
#include "grammar/syntax.h"

namespace gramap {

/// What resolving one file shares.
struct Resolver {
  explicit Resolver(const syntax::File& source) : file(source), quantities(source, diagnostics) {}

  const syntax::File& file;
  std::vector<Diagnostic> diagnostics;
  Quantities quantities;
  RuleSet rules;
  std::map<std::string, int> rooms;    ///< name to index into rules.rooms
  std::map<std::string, int> symbols;  ///< name to index into rules.symbols
  std::map<std::string, int> rule_indices;
  std::map<std::string, Span> defined;  ///< where each room, symbol and rule is defined
  std::set<std::string> used;           ///< rooms and symbols that some rule's body names
  std::set<std::pair<std::string, std::string>>
      said;  ///< room and `width` or `depth`: given, though perhaps with a fault

  Diagnostic& error(std::string code, Span span, std::string message, std::string help = "");
  Diagnostic& warning(std::string code, Span span, std::string message, std::string help = "");

  /// The room or symbol of that name; reports it when there is none.
  std::optional<SymbolRef> reference(const syntax::Name& name);
};

/// Rooms with their widths, doors, windows and furniture.
void resolve_rooms(Resolver& resolver);

/// The pieces of a rule's body as one row.
std::vector<Item> resolve_body(Resolver& resolver, const std::vector<syntax::Term>& body);

/// A condition, its operands' kinds checked.
enum class ConditionOf { space, hallway };
Condition resolve_condition(Resolver& resolver, const syntax::Expr& expr, ConditionOf of);

/// The productions of hallways, their symbols resolved; endless ones and unused ones reported.
void resolve_hallways(Resolver& resolver);

/// False when no values of the attributes are found with which the condition holds.
bool can_hold(const Condition& condition);

/// Faults of the rules as a whole, once each is well formed: recursion that is no row, splits that never fill
/// their scope, rules that are never applied. Where the file has other errors, rules that they touch are
/// passed over.
void check_statically(Resolver& resolver, std::string_view text);

}  // namespace gramap
