// Syntax tree to rule set, and all that can be wrong with it before any data is read.
#include <algorithm>
#include <utility>

#include "grammar/language.h"
#include "grammar/resolve.h"
#include "grammar/suggest.h"

namespace gramap {

Diagnostic& Resolver::error(std::string code, Span span, std::string message, std::string help) {
  diagnostics.push_back(
      {Severity::error, std::move(code), std::move(message), span, {}, {}, std::move(help)});
  return diagnostics.back();
}

Diagnostic& Resolver::warning(std::string code, Span span, std::string message, std::string help) {
  Diagnostic& diagnostic = error(std::move(code), span, std::move(message), std::move(help));
  diagnostic.severity = Severity::warning;
  return diagnostic;
}

std::optional<SymbolRef> Resolver::reference(const syntax::Name& name) {
  used.insert(name.text);
  if (const auto it = rooms.find(name.text); it != rooms.end())
    return SymbolRef{SymbolRef::Kind::room, it->second};
  if (const auto it = symbols.find(name.text); it != symbols.end())
    return SymbolRef{SymbolRef::Kind::symbol, it->second};
  if (file.broken.contains(name.text)) return std::nullopt;
  std::vector<std::string_view> names;
  for (const auto& [known, index] : rooms) names.push_back(known);
  for (const auto& [known, index] : symbols) names.push_back(known);
  const std::string near = nearest(name.text, names);
  used.insert(near);
  error("E0201", name.span, "there is no room or symbol `" + name.text + "`",
        !near.empty() ? "did you mean `" + near + "`?"
                      : "define it: `room " + name.text + " { width 2.80 m +- 5 cm; }`, or a rule `" +
                            name.text + "_row: " + name.text + " -> …;`");
  return std::nullopt;
}

namespace {

using syntax::Setting;

/// Symbols are what rules replace; the start symbol is the first.
void collect_symbols(Resolver& r, const Setting* start) {
  const auto add = [&](const std::string& name) {
    if (r.rooms.contains(name)) return;
    if (r.symbols.try_emplace(name, static_cast<int>(r.rules.symbols.size())).second)
      r.rules.symbols.push_back(name);
  };
  if (start != nullptr) add(start->name.text);
  for (const syntax::Rule& rule : r.file.rules)
    if (!rule.predecessor.is_end()) add(rule.predecessor.name.text);
}

void resolve_settings(Resolver& r) {
  std::map<std::string, const Setting*> seen;
  for (const Setting& setting : r.file.settings) {
    const auto [it, fresh] = seen.try_emplace(setting.word, &setting);
    if (!fresh)
      r.error("E0203", setting.span, "`" + setting.word + "` is given twice", "keep one of them")
          .labels.push_back({it->second->span, "first given here"});
  }
  const auto length = [&](const char* word, const char* what, double& target) {
    if (const auto it = seen.find(word); it != seen.end())
      target = r.quantities.positive_length(it->second->values[0], what).value_or(target);
  };
  length("inner", "the thickness of the inner walls", r.rules.inner_wall_m);
  length("outer", "the thickness of the outer walls", r.rules.outer_wall_m);
  length("height", "the ceiling's height", r.rules.height_m);
  if (const auto it = seen.find("grammar"); it != seen.end())
    r.rules.name = it->second->name.text;
  else if (!r.file.broken.contains("grammar"))
    r.error("E0601", {0, 0}, "the rule file has no name", "begin it with `grammar my_building;`");

  if (const auto it = seen.find("background"); it != seen.end()) {
    const Setting& source = *it->second;
    Background& background = r.rules.background;
    background.probability = r.quantities.weight(source.values[0]).value_or(0);
    r.quantities.expect_same_unit(source.values[1], source.values[2]);
    background.least_m = r.quantities.positive_length(source.values[1], "a width").value_or(1);
    background.most_m = r.quantities.positive_length(source.values[2], "a width").value_or(1000);
    if (background.probability >= 1)
      r.error("E0404", source.values[0].span,
              "the background's probability must be below 1, or no rule would ever be used",
              "write a small one: `0.02` or `2 %`");
    if (background.most_m <= background.least_m)
      r.error("E0312", source.values[2].span, "this range is empty: its end is not above its start",
              "write the smaller width first: `1 m .. 12 m`");
  }
  const auto start = seen.find("start");
  collect_symbols(r, start == seen.end() ? nullptr : start->second);
  if (start == seen.end()) {
    if (!r.file.broken.contains("start"))
      r.error("E0602", {0, 0}, "the rule file does not say with which symbol a space starts",
              "write `start Space;`");
  } else if (r.rooms.contains(start->second->name.text)) {
    r.error(
        "E0207", start->second->name.span,
        "a space starts with a symbol, and `" + start->second->name.text + "` is a room",
        "write a rule that makes the room, and start with its symbol: `start Space;` and `one: Space -> " +
            start->second->name.text + ";`");
  } else {
    r.used.insert(start->second->name.text);
    const bool has_rule = std::any_of(
        r.file.rules.begin(), r.file.rules.end(),
        [&](const syntax::Rule& rule) { return rule.predecessor.name.text == start->second->name.text; });
    if (!has_rule && !r.file.broken.contains(start->second->name.text)) {
      std::vector<std::string_view> names(r.rules.symbols.begin(), r.rules.symbols.end());
      const std::string near = nearest(start->second->name.text, names);
      r.error("E0201", start->second->name.span,
              "no rule says what the start symbol `" + start->second->name.text + "` is made of",
              near.empty() ? "write a rule: `all: " + start->second->name.text + " -> …;`"
                           : "did you mean `" + near + "`?");
    }
  }
}

std::optional<SymbolRef> resolve_context(Resolver& r, const std::optional<syntax::Context>& context) {
  if (!context) return std::nullopt;
  if (context->is_end()) return SymbolRef{SymbolRef::Kind::end, 0};
  const std::optional<SymbolRef> ref = r.reference(context->name);
  if (ref && ref->kind == SymbolRef::Kind::symbol)
    r.error("E0208", context->name.span,
            "a neighbour is a room or the end of the space `|`, and `" + context->name.text + "` is a symbol",
            "write the room that may stand there");
  return ref;
}

void resolve_rules(Resolver& r) {
  for (const syntax::Rule& source : r.file.rules) {
    Rule rule;
    rule.name = source.name.text;
    const auto [it, fresh] = r.rule_indices.try_emplace(rule.name, static_cast<int>(r.rules.rules.size()));
    if (fresh)
      r.defined.try_emplace(rule.name + ":", source.name.span);
    else
      r.error("E0203", source.name.span, "the rule `" + rule.name + "` is defined twice",
              "give one of them another name")
          .labels.push_back({r.defined.at(rule.name + ":"), "first defined here"});
    if (source.predecessor.is_end())
      r.error("E0209", source.predecessor.name.span,
              "a rule replaces a symbol, and `|` is the end of the space",
              "write the symbol between the neighbours: `| < Space -> …`");
    else if (r.rooms.contains(source.predecessor.name.text))
      r.error("E0207", source.predecessor.name.span,
              "a rule replaces a symbol, and `" + source.predecessor.name.text +
                  "` is a room, which stays as it is",
              "write a symbol before `->`")
          .labels.push_back({r.defined.at(source.predecessor.name.text), "the room"});
    else
      rule.symbol = r.symbols.at(source.predecessor.name.text);
    rule.left = resolve_context(r, source.left);
    rule.right = resolve_context(r, source.right);
    if (source.condition) rule.condition = resolve_condition(r, *source.condition, ConditionOf::space);
    rule.body = resolve_body(r, source.body);
    if (source.probability) rule.probability = r.quantities.weight(*source.probability).value_or(1);
    r.rules.rules.push_back(std::move(rule));
  }
}

int find_rule(Resolver& r, const syntax::Name& name) {
  if (const auto it = r.rule_indices.find(name.text); it != r.rule_indices.end()) return it->second;
  if (r.file.broken.contains(name.text)) return -1;
  std::vector<std::string_view> names;
  for (const auto& [known, index] : r.rule_indices) names.push_back(known);
  const std::string near = nearest(name.text, names);
  r.error("E0210", name.span, "there is no rule `" + name.text + "`",
          !near.empty() ? "did you mean `" + near + "`?"
          : r.rooms.contains(name.text) || r.symbols.contains(name.text)
              ? "`after` speaks of rules: write a rule's name, which stands before its `:`"
              : "write the name of a rule, which stands before its `:`");
  return -1;
}

void resolve_afters(Resolver& r) {
  std::map<int, Span> seen;
  for (const syntax::After& source : r.file.afters) {
    const int index = find_rule(r, source.rule);
    Rule::After after;
    std::map<std::string, Span> named;
    double sum = 0;
    bool sound = true;
    for (const syntax::After::Entry& entry : source.entries) {
      const std::optional<double> share = r.quantities.weight(entry.share);
      const auto [it, fresh] = named.try_emplace(entry.rule.text, entry.rule.span);
      if (!fresh)
        r.error("E0203", entry.rule.span, "`" + entry.rule.text + "` is named twice", "keep one of them")
            .labels.push_back({it->second, "the first one"});
      sound = sound && share.has_value();
      sum += share.value_or(0);
      if (entry.rule.text == "others") {
        after.others = share.value_or(0);
        continue;
      }
      const int next = find_rule(r, entry.rule);
      if (next >= 0 && fresh) after.named.emplace_back(next, share.value_or(0));
    }
    if (sound && !(sum > 0))
      r.error(
          "E0402", source.rule.span,
          "after `" + source.rule.text + "` no rule has a probability above zero, so nothing can follow it",
          "give at least one rule a probability above zero");
    if (index < 0) continue;
    const auto [it, fresh] = seen.try_emplace(index, source.rule.span);
    if (!fresh)
      r.error("E0203", source.rule.span, "`after " + source.rule.text + "` is given twice",
              "join the two blocks")
          .labels.push_back({it->second, "first given here"});
    else
      r.rules.rules[static_cast<std::size_t>(index)].after = std::move(after);
  }
}

void report_unused(Resolver& r) {
  r.quantities.report_unused();
  for (const syntax::Room& room : r.file.rooms)
    if (!r.used.contains(room.name.text) && !r.file.broken.contains(room.name.text))
      r.warning("W0204", room.name.span, "no rule makes the room `" + room.name.text + "`",
                "use it in a rule's body, or remove it");
  std::set<std::string> reported;
  for (const syntax::Rule& rule : r.file.rules) {
    const std::string& symbol = rule.predecessor.name.text;
    if (rule.predecessor.is_end() || r.rooms.contains(symbol) || r.used.contains(symbol) ||
        r.file.broken.contains(symbol))
      continue;
    if (reported.insert(symbol).second)
      r.warning("W0204", rule.predecessor.name.span,
                "no rule's body names the symbol `" + symbol + "`, so its rules are never used",
                "use it in a body, or write `start " + symbol + ";`");
  }
}

/// A derivation can begin: the start symbol is known, and some rule replaces it.
bool has_start(const Resolver& r) {
  return std::any_of(r.file.settings.begin(), r.file.settings.end(), [&](const Setting& setting) {
    return setting.word == "start" && !r.rooms.contains(setting.name.text) &&
           std::any_of(r.rules.rules.begin(), r.rules.rules.end(),
                       [](const Rule& rule) { return rule.symbol == 0; });
  });
}

}  // namespace

CheckedRules check_rules(std::string_view text, const std::string&) {
  const syntax::File file = syntax::parse(text);
  Resolver r(file);
  resolve_rooms(r);
  resolve_settings(r);
  resolve_rules(r);
  resolve_afters(r);
  resolve_hallways(r);
  report_unused(r);
  if (has_start(r)) check_statically(r, text);

  CheckedRules checked;
  checked.diagnostics = file.diagnostics;
  checked.diagnostics.insert(checked.diagnostics.end(), r.diagnostics.begin(), r.diagnostics.end());
  std::stable_sort(checked.diagnostics.begin(), checked.diagnostics.end(),
                   [](const Diagnostic& a, const Diagnostic& b) {
                     return std::pair(a.span.begin, a.span.end) < std::pair(b.span.begin, b.span.end);
                   });
  const auto same = [](const Diagnostic& a, const Diagnostic& b) {
    return a.code == b.code && a.span.begin == b.span.begin && a.span.end == b.span.end &&
           a.message == b.message;
  };
  checked.diagnostics.erase(std::unique(checked.diagnostics.begin(), checked.diagnostics.end(), same),
                            checked.diagnostics.end());
  const bool sound = std::none_of(checked.diagnostics.begin(), checked.diagnostics.end(),
                                  [](const Diagnostic& d) { return d.severity == Severity::error; });
  if (sound) checked.rules = std::move(r.rules);
  return checked;
}

}  // namespace gramap
