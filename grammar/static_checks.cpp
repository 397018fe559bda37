// What is wrong with rules that are each well formed: found on the automaton that derivation and fit use.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>
#include <string_view>

#include "grammar/resolve.h"
#include "grammar/row.h"
#include "grammar/sizes.h"

namespace gramap {
namespace {

constexpr double kFillSigmas = 5;
constexpr int kMostFaults = 20;
constexpr int kDeepestUnit = 32;

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

bool is_error(const Diagnostic& diagnostic) {
  return diagnostic.severity == Severity::error;
}

Span body_span(const syntax::Rule& rule) {
  return {rule.body.front().span.begin, rule.body.back().span.end};
}

// ---- splits that never fill their scope

/// A size's mean and variance where they are known whatever the space.
struct Known {
  double mean_m = 0;
  double variance = 0;
};

std::optional<Known> known(const Mixture& stated) {
  const Mixture mixture = with_tolerance(stated);
  if (mixture.components.size() != 1) return std::nullopt;
  const Normal& normal = mixture.components[0].normal;
  return Known{normal.mean_m, normal.sd_m * normal.sd_m};
}

/// The extent along `axis` of a piece of a split in that direction.
std::optional<Known> known_extent(const RuleSet& rules, const Item& item, Axis axis) {
  if (item.size.kind == Size::Kind::absolute) return known(item.size.width);
  const bool is_room = item.kind == Item::Kind::piece && item.ref.kind == SymbolRef::Kind::room;
  if (item.size.kind != Size::Kind::own || !is_room) return std::nullopt;
  const RoomType& room = rules.rooms[at(item.ref.index)];
  if (axis == Axis::along) return known(room.width);
  return room.depth ? known(Mixture{{{1, *room.depth}}}) : std::nullopt;
}

bool takes_share(const Item& item) {
  return item.size.kind == Size::Kind::floating || item.size.kind == Size::Kind::relative;
}

/// Reports the splits in `item` whose pieces cannot add up to their scope, where that is known. Symbols that
/// recur are no units: what they make is not looked at.
void check_fills(Resolver& r, const std::vector<bool>& recursive, const Item& item,
                 std::optional<Known> along, std::optional<Known> across, Span span, int depth = 0) {
  const bool is_symbol = item.kind == Item::Kind::piece && item.ref.kind == SymbolRef::Kind::symbol;
  if (is_symbol && along && !recursive[at(item.ref.index)] && depth < kDeepestUnit) {
    for (std::size_t i = 0; i < r.rules.rules.size(); ++i) {
      if (r.rules.rules[i].symbol != item.ref.index) continue;
      Item body;
      body.kind = Item::Kind::split;
      body.children = r.rules.rules[i].body;
      check_fills(r, recursive, body, along, across, body_span(r.file.rules[i]), depth + 1);
    }
  }
  if (item.kind != Item::Kind::split) return;
  const std::optional<Known> scope = item.axis == Axis::along ? along : across;
  double left_m = -r.rules.inner_wall_m * static_cast<double>(item.children.size() - 1);
  double variance = 0;
  bool all_known = scope.has_value();
  bool shares = false;
  if (scope) left_m += scope->mean_m, variance += scope->variance;
  for (const Item& child : item.children) {
    // What is alone in its scope has all of it.
    const bool alone = item.children.size() == 1 && child.size.kind == Size::Kind::floating;
    const std::optional<Known> extent = alone ? scope : known_extent(r.rules, child, item.axis);
    if (item.axis == Axis::along)
      check_fills(r, recursive, child, extent, across, span, depth);
    else
      check_fills(r, recursive, child, along, extent, span, depth);
    shares = shares || takes_share(child);
    all_known = all_known && (extent || takes_share(child));
    if (extent && !alone) left_m -= extent->mean_m, variance += extent->variance;
  }
  const bool fills = shares ? left_m > 0 : std::abs(left_m) <= kFillSigmas * std::sqrt(variance);
  if (!all_known || fills) return;
  char text[160];
  std::snprintf(text, sizeof text,
                "this split can never fill its %.2f m: its pieces and the walls between them %s %.2f m %s",
                scope->mean_m, left_m < 0 ? "need" : "leave", std::abs(left_m), left_m < 0 ? "more" : "over");
  r.error("E0702", span, text,
          shares ? "make the split larger or its pieces smaller"
                 : "let one of the pieces take what is left: write `~` as its size");
}

/// The same of an item of a row, and of what a repeat or merge holds.
void check_items(Resolver& r, const std::vector<bool>& recursive, const Item& item, Span span) {
  if (item.kind == Item::Kind::split || item.kind == Item::Kind::piece)
    return check_fills(r, recursive, item, known_extent(r.rules, item, Axis::along), std::nullopt, span);
  for (const Item& child : item.children) check_items(r, recursive, child, span);
}

// ---- the automaton

/// The symbols that a rule's body names: in the row, or with a scope of their own.
struct Mentioned {
  std::set<int> in_row, inside;

  explicit Mentioned(const std::vector<Item>& body) { add(body, false, true); }

 private:
  /// `whole`: the last of the items has all that is left of the space.
  void add(const std::vector<Item>& items, bool is_inside, bool whole) {
    for (const Item& item : items) {
      const bool takes_rest = whole && &item == &items.back();
      const bool in_unit = is_inside || !is_written_out(item, takes_rest);
      if (item.kind == Item::Kind::piece && item.ref.kind == SymbolRef::Kind::symbol)
        (in_unit ? inside : in_row).insert(item.ref.index);
      add(item.children, in_unit, takes_rest && item.kind == Item::Kind::split);
    }
  }
};

/// Puts a room in place of what a faulty rule makes, and behind it each of the symbols that it names: so what
/// is wrong with their rules comes to light in the same run. `source` maps the rules added to the faulty one.
/// `alone`: the room and no symbols.
void stand_in(RuleSet& rules, int rule, bool alone, std::vector<int>& source) {
  const Mentioned symbols(rules.rules[at(rule)].body);
  Rule plain = rules.rules[at(rule)];
  plain.left = plain.right = std::nullopt;
  plain.after = std::nullopt;
  Item room;
  room.ref = {SymbolRef::Kind::room, static_cast<int>(rules.rooms.size()) - 1};
  room.size.kind = Size::Kind::absolute;
  room.size.width.components.push_back({1, {1, 0.1}});
  plain.body = {room};
  if (alone) {
    for (std::size_t i = 0; i < source.size(); ++i)
      if (source[i] == rule) rules.rules[i] = plain;
    return;
  }
  for (const int symbol : symbols.inside) {
    Item unit = room;
    unit.ref = {SymbolRef::Kind::symbol, symbol};
    unit.size.width.components[0].normal.mean_m = 1000;  // whatever stands in it
    plain.body.push_back(unit);
  }
  const std::vector<Item> units = plain.body;
  bool first = true;
  for (const int symbol : symbols.in_row) {
    plain.body = units;
    Item rest;
    rest.ref = {SymbolRef::Kind::symbol, symbol};
    plain.body.push_back(rest);
    if (!first) {
      rules.rules.push_back(plain);
      source.push_back(rule);
    } else {
      rules.rules[at(rule)] = plain;
    }
    first = false;
  }
  if (first) rules.rules[at(rule)] = plain;
}

/// Symbols that units hold, at any depth.
std::set<int> symbols_inside(const RuleSet& rules) {
  std::set<int> inside;
  for (const Rule& rule : rules.rules) inside.merge(std::set(Mentioned(rule.body).inside));
  for (std::size_t before = 0; before != inside.size();) {
    before = inside.size();
    for (const Rule& rule : rules.rules)
      if (inside.contains(rule.symbol)) inside.merge(std::set(Mentioned(rule.body).in_row));
  }
  return inside;
}

/// States from which the end can be reached.
std::vector<bool> completing(const Row& row) {
  std::vector<std::vector<std::size_t>> sources(row.arcs.size());
  for (std::size_t state = 0; state < row.arcs.size(); ++state)
    for (const auto& arcs : row.arcs[state])
      for (const Arc& arc : arcs) sources[at(arc.target)].push_back(state);
  std::vector<bool> completes(row.arcs.size(), false);
  std::vector<std::size_t> open;
  for (std::size_t state = 0; state < row.accept.size(); ++state)
    if (row.accept[state] > 0) completes[state] = true, open.push_back(state);
  while (!open.empty()) {
    const std::size_t state = open.back();
    open.pop_back();
    for (const std::size_t source : sources[state])
      if (!completes[source]) completes[source] = true, open.push_back(source);
  }
  return completes;
}

void check_use(Resolver& r, const RuleSet& rules, const Row& row) {
  const std::vector<bool> completes = completing(row);
  const auto& first = row.arcs.front();
  const bool can_begin = std::any_of(first.begin(), first.end(), [&](const std::vector<Arc>& arcs) {
    return std::any_of(arcs.begin(), arcs.end(), [&](const Arc& arc) { return completes[at(arc.target)]; });
  });
  if (!can_begin) {
    const auto start = std::find_if(r.file.settings.begin(), r.file.settings.end(),
                                    [](const syntax::Setting& s) { return s.word == "start"; });
    r.error("E0704", start->name.span, "no derivation of `" + start->name.text + "` fills a space",
            "some rule has to be possible at the start, and some at the end: look at the neighbours that "
            "they ask for");
    return;
  }
  std::vector<bool> used(rules.rules.size(), false);
  for (std::size_t state = 0; state < row.arcs.size(); ++state)
    for (const auto& arcs : row.arcs[state])
      for (const Arc& arc : arcs)
        if (arc.probability > 0 && completes[at(arc.target)]) {
          for (const DerivationStep& step : arc.steps)
            if (step.rule >= 0) used[at(step.rule)] = true;
          for (const InnerUse& use : row.elements[at(arc.element)].uses) used[at(use.rule)] = true;
        }
  for (std::size_t i = 0; i < used.size(); ++i) {
    const Rule& rule = r.rules.rules[i];
    if (used[i] || !r.used.contains(rules.symbols[at(rule.symbol)])) continue;
    const bool no_weight = rule.probability <= 0;
    r.warning("W0703", r.file.rules[i].name.span, "the rule `" + rule.name + "` is never applied",
              no_weight ? "its probability is zero; give it one, or remove the rule"
              : rule.left || rule.right
                  ? "no layout has these neighbours around it; change them, or remove the rule"
                  : "no derivation comes to its symbol; name the symbol in a body that is used");
  }
}

/// Rules inside a unit whose condition asks for what is known along the hallway only.
void check_inside(Resolver& r, const std::set<int>& doubtful) {
  const std::set<int> inside = symbols_inside(r.rules);
  for (std::size_t i = 0; i < r.rules.rules.size(); ++i)
    if (!doubtful.contains(static_cast<int>(i)) && inside.contains(r.rules.rules[i].symbol) &&
        depends_on_length(r.rules.rules[i].condition))
      r.error("E0701", r.file.rules[i].condition->span,
              "the rule `" + r.rules.rules[i].name +
                  "` cannot be used: a condition on the remaining length cannot be asked inside a unit",
              "ask in the rule that gives the unit its place in the row");
}

/// Entries of `after` blocks that never have a say.
void check_sequels(Resolver& r, const Row& row) {
  for (const syntax::After& after : r.file.afters) {
    const int rule = r.rule_indices.at(after.rule.text);
    const auto named = [&](const std::string& name) { return r.rule_indices.at(name); };
    for (const syntax::After::Entry& entry : after.entries)
      if (entry.rule.text != "others" && !row.sequels.contains({rule, named(entry.rule.text)}))
        r.warning("W0707", entry.rule.span,
                  "`" + entry.rule.text + "` never competes right after `" + after.rule.text + "`",
                  "behind `" + after.rule.text +
                      "` another symbol is to be replaced, or none; name one of its rules, or remove this");
  }
}

/// Rules whose meaning is in doubt, because there is an error in them or in something that they name.
std::set<int> doubtful_rules(const Resolver& r, std::string_view text) {
  std::set<std::string> doubtful(r.file.broken.begin(), r.file.broken.end());
  for (const auto* known : {&r.rooms, &r.symbols})
    for (const auto& [name, index] : *known) doubtful.erase(name);
  for (const syntax::Let& let : r.file.lets) doubtful.erase(let.name.text);
  std::set<std::size_t> errors;  // where they begin
  for (const Diagnostic& diagnostic : r.diagnostics)
    if (is_error(diagnostic)) errors.insert(diagnostic.span.begin);
  const auto has_doubt = [&](Span span) {
    const auto error = errors.lower_bound(span.begin);
    if (error != errors.end() && *error < span.end) return true;
    const Tokens tokens = tokenize(text.substr(span.begin, span.end - span.begin));
    return std::any_of(tokens.tokens.begin(), tokens.tokens.end(), [&](const Token& token) {
      return token.kind == Token::Kind::name && doubtful.contains(token.text);
    });
  };
  for (std::size_t before = doubtful.size() + 1; before != doubtful.size();) {
    before = doubtful.size();
    for (const syntax::Let& let : r.file.lets)
      if (has_doubt(let.span)) doubtful.insert(let.name.text);
  }
  for (const syntax::Room& room : r.file.rooms)
    if (has_doubt(room.span)) doubtful.insert(room.name.text);
  std::set<int> rules;
  for (const syntax::Setting& setting : r.file.settings)
    if ((setting.word == "inner" || setting.word == "background") && has_doubt(setting.span))
      for (std::size_t i = 0; i < r.file.rules.size(); ++i) rules.insert(static_cast<int>(i));
  for (std::size_t i = 0; i < r.file.rules.size(); ++i)
    if (has_doubt(r.file.rules[i].span)) rules.insert(static_cast<int>(i));
  return rules;
}

}  // namespace

void check_statically(Resolver& r, std::string_view text) {
  const bool is_sound =
      r.file.diagnostics.empty() && std::none_of(r.diagnostics.begin(), r.diagnostics.end(), is_error);
  const std::set<int> doubtful = is_sound ? std::set<int>() : doubtful_rules(r, text);
  const std::size_t faults_before = r.diagnostics.size();
  const std::vector<bool> recursive = recursive_symbols(r.rules);
  for (std::size_t i = 0; i < r.rules.rules.size(); ++i) {
    if (doubtful.contains(static_cast<int>(i))) continue;
    for (const Item& item : r.rules.rules[i].body)
      check_items(r, recursive, item, body_span(r.file.rules[i]));
    if (!can_hold(r.rules.rules[i].condition))
      r.warning("W0705", r.file.rules[i].condition->span,
                "this condition never holds, so the rule `" + r.rules.rules[i].name + "` is never applied",
                "change the condition, or remove the rule");
  }
  check_inside(r, doubtful);

  RuleSet bare = r.rules;
  bare.rooms.push_back({});  // that stands in for faulty pieces
  std::vector<int> source;   // of each rule, the one in the file
  for (std::size_t i = 0; i < bare.rules.size(); ++i) source.push_back(static_cast<int>(i));
  for (Rule& rule : bare.rules) rule.condition = {};
  std::map<int, int> faults;  // by rule, how often it was at fault
  for (const int rule : doubtful) {
    stand_in(bare, rule, false, source);
    faults[rule] = 1;
  }
  for (int count = 0; count < kMostFaults; ++count) {
    const CompiledRow compiled = compile_row(bare, {}, make_grid(1, bare.inner_wall_m, 1));
    if (!compiled.fault) {
      if (!is_sound || r.diagnostics.size() != faults_before) return;
      check_use(r, bare, compiled.row);
      if (r.diagnostics.size() == faults_before) check_sequels(r, compiled.row);
      return;
    }
    if (compiled.fault->rule < 0) {
      if (is_sound) r.error("E0701", {0, 0}, "the rules cannot be used: " + compiled.fault->message);
      return;
    }
    const int rule = source[at(compiled.fault->rule)];
    const int times = ++faults[rule];
    if (times > 2) return;
    stand_in(bare, rule, times == 2, source);
    if (times == 2) continue;
    const syntax::Rule& written = r.file.rules[at(rule)];
    // A split that never fills has been said already, with what is missing.
    const Span body = body_span(written);
    if (std::any_of(r.diagnostics.begin(), r.diagnostics.end(), [&](const Diagnostic& said) {
          return said.code == "E0702" && body.begin <= said.span.begin && said.span.end <= body.end;
        }))
      continue;
    Diagnostic& fault = r.error(
        "E0701", body, "the rule `" + written.name.text + "` cannot be used: " + compiled.fault->message);
    const bool recurs = compiled.fault->message.find("symbol") != std::string::npos;
    if (recurs)
      fault.help =
          "a rule's body is a row of rooms and units, and what is left goes to a symbol in last place: `" +
          written.name.text + ": " + written.predecessor.name.text + " -> … " +
          written.predecessor.name.text + ";`";
  }
}

}  // namespace gramap
