// What is wrong with rules that are each well formed: found on the automaton that derivation and fit use.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

#include "grammar/resolve.h"
#include "grammar/row.h"
#include "grammar/sizes.h"

namespace gramap {
namespace {

constexpr double kFillSigmas = 5;
constexpr int kMostFaults = 20;

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
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

/// Reports the splits in `item` whose pieces cannot add up to their scope, where that is known.
void check_fills(Resolver& r, const Item& item, std::optional<Known> along, std::optional<Known> across,
                 Span span) {
  if (item.kind != Item::Kind::split) return;
  const std::optional<Known> scope = item.axis == Axis::along ? along : across;
  double left_m = -r.rules.inner_wall_m * static_cast<double>(item.children.size() - 1);
  double variance = 0;
  bool all_known = scope.has_value();
  bool shares = false;
  if (scope) left_m += scope->mean_m, variance += scope->variance;
  for (const Item& child : item.children) {
    const std::optional<Known> extent = known_extent(r.rules, child, item.axis);
    if (item.axis == Axis::along)
      check_fills(r, child, extent, across, span);
    else
      check_fills(r, child, along, extent, span);
    shares = shares || takes_share(child);
    all_known = all_known && (extent || takes_share(child));
    if (extent) left_m -= extent->mean_m, variance += extent->variance;
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
void check_items(Resolver& r, const Item& item, Span span) {
  if (item.kind == Item::Kind::split)
    return check_fills(r, item, known_extent(r.rules, item, Axis::along), std::nullopt, span);
  for (const Item& child : item.children) check_items(r, child, span);
}

// ---- the automaton

/// So that the rest of the rules can be looked at.
void disable(RuleSet& rules, int rule) {
  rules.rules[at(rule)].probability = 0;
  for (Rule& other : rules.rules)
    if (other.after)
      for (auto& [named, share] : other.after->named)
        if (named == rule) share = 0;
}

/// Symbols that a unit holds, at any depth: how their rules are used does not show in the row.
void collect_inside(const RuleSet& rules, const Item& item, bool inside, std::set<int>& symbols) {
  if (inside && item.kind == Item::Kind::piece && item.ref.kind == SymbolRef::Kind::symbol &&
      symbols.insert(item.ref.index).second)
    for (const Rule& rule : rules.rules)
      if (rule.symbol == item.ref.index)
        for (const Item& piece : rule.body) collect_inside(rules, piece, true, symbols);
  for (const Item& child : item.children)
    collect_inside(rules, child, inside || !is_written_out(item, false), symbols);
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
        if (completes[at(arc.target)])
          for (const DerivationStep& step : arc.steps)
            if (step.rule >= 0) used[at(step.rule)] = true;
  std::set<int> inside;
  for (const Rule& rule : rules.rules)
    for (const Item& item : rule.body) collect_inside(rules, item, false, inside);
  for (std::size_t i = 0; i < used.size(); ++i) {
    const Rule& rule = r.rules.rules[i];
    if (used[i] || inside.contains(rule.symbol) || !r.used.contains(rules.symbols[at(rule.symbol)])) continue;
    const bool no_weight = rule.probability <= 0;
    r.warning("W0703", r.file.rules[i].name.span, "the rule `" + rule.name + "` is never applied",
              no_weight ? "its probability is zero; give it one, or remove the rule"
              : rule.left || rule.right
                  ? "no layout has these neighbours around it; change them, or remove the rule"
                  : "no derivation comes to its symbol; name the symbol in a body that is used");
  }
}

}  // namespace

void check_statically(Resolver& r) {
  const auto faults_before = r.diagnostics.size();
  RuleSet bare = r.rules;
  for (std::size_t i = 0; i < r.rules.rules.size(); ++i) {
    for (const Item& item : r.rules.rules[i].body) check_items(r, item, body_span(r.file.rules[i]));
    if (!can_hold(r.rules.rules[i].condition))
      r.warning("W0705", r.file.rules[i].condition->span,
                "this condition never holds, so the rule `" + r.rules.rules[i].name + "` is never applied",
                "change the condition, or remove the rule");
  }
  for (Rule& rule : bare.rules) rule.condition = {};
  std::set<int> faulty;
  for (int count = 0; count < kMostFaults; ++count) {
    const CompiledRow compiled = compile_row(bare, {}, make_grid(1, bare.inner_wall_m, 1));
    if (!compiled.fault) {
      if (faulty.empty() && r.diagnostics.size() == faults_before) check_use(r, bare, compiled.row);
      return;
    }
    const int rule = compiled.fault->rule;
    if (rule < 0 || !faulty.insert(rule).second) {
      if (faulty.empty()) r.error("E0701", {0, 0}, "the rules cannot be used: " + compiled.fault->message);
      return;
    }
    const syntax::Rule& source = r.file.rules[at(rule)];
    disable(bare, rule);
    // A split that never fills has been said already, with what is missing.
    const Span body = body_span(source);
    if (std::any_of(r.diagnostics.begin(), r.diagnostics.end(), [&](const Diagnostic& said) {
          return said.code == "E0702" && body.begin <= said.span.begin && said.span.end <= body.end;
        }))
      continue;
    Diagnostic& fault =
        r.error("E0701", body_span(source),
                "the rule `" + source.name.text + "` cannot be used: " + compiled.fault->message);
    const bool recurs = compiled.fault->message.find("symbol") != std::string::npos;
    if (recurs)
      fault.help =
          "a rule's body is a row of rooms and units, and what is left goes to a symbol in last place: `" +
          source.name.text + ": " + source.predecessor.name.text + " -> … " + source.predecessor.name.text +
          ";`";
  }
}

}  // namespace gramap
