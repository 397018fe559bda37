#include <algorithm>

#include "grammar/resolve.h"
#include "grammar/suggest.h"

namespace gramap {
namespace {

using syntax::HallwayItem;

class HallwayResolver {
 public:
  HallwayResolver(Resolver& resolver, const syntax::Hallways& block) : r_(resolver), block_(block) {}

  void run() {
    const auto faults_before = static_cast<std::ptrdiff_t>(r_.diagnostics.size());
    collect();
    settings();
    for (const HallwayItem* item : productions_) production(*item);
    const bool sound = std::none_of(r_.diagnostics.begin() + faults_before, r_.diagnostics.end(),
                                    [](const Diagnostic& d) { return d.severity == Severity::error; });
    if (sound && !broken_) check_uses();
    r_.rules.hallways = std::move(grammar_);
  }

 private:
  bool is_broken(const std::string& name) const { return r_.file.broken.contains(name); }

  void collect() {
    std::map<std::string, Span> seen;
    for (const HallwayItem& item : block_.items) {
      const bool is_production = item.word.text.empty();
      const syntax::Name& name = is_production ? item.name : item.word;
      const auto [it, fresh] = seen.try_emplace(name.text, name.span);
      if (!fresh)
        r_.error("E0203", name.span,
                 is_production ? "the production `" + name.text + "` is defined twice"
                               : "the hallways have a second `" + name.text + "`",
                 is_production ? "give one of them another name" : "keep one of them")
            .labels.push_back({it->second, "the first one"});
      if (is_production)
        productions_.push_back(&item);
      else if (fresh)
        settings_[name.text] = &item;
    }
    if (const auto axiom = settings_.find("axiom"); axiom != settings_.end())
      symbol_id(axiom->second->name.text);
    for (const HallwayItem* item : productions_) symbol_id(item->predecessor.text);
    for (const HallwayItem* item : productions_) made_.insert(item->predecessor.text);
  }

  int symbol_id(const std::string& name) {
    const auto [it, fresh] = symbols_.try_emplace(name, static_cast<int>(grammar_.symbols.size()));
    if (fresh) grammar_.symbols.push_back(name);
    return it->second;
  }

  const HallwayItem* setting(const char* word, const std::string& example, std::string& missing) {
    const auto it = settings_.find(word);
    if (it != settings_.end()) return it->second;
    broken_ = true;
    if (!is_broken(word)) missing += (missing.empty() ? "add `" : " `") + example + "`";
    return nullptr;
  }

  void settings() {
    std::string missing;
    const HallwayItem* const width = setting("width", "width 2.00 m;", missing);
    const HallwayItem* const depth = setting("depth", "depth 4.50 m;", missing);
    const HallwayItem* const axiom = setting("axiom", "axiom Trunk;", missing);
    if (!missing.empty())
      r_.error("E0603", block_.word.span, "the hallways do not say all that growing takes", missing);
    if (width) grammar_.width = spread(*width->quantity, "a hallway's width");
    if (axiom) reference(axiom->name);
    if (depth) {
      grammar_.depth_m =
          r_.quantities.normal(*depth->quantity, "the depth of rooms").value_or(Normal()).mean_m;
      if (depth->quantity->sd)
        r_.error("E0313", depth->quantity->span, "this is the least depth of rooms, so it has no spread",
                 "leave out what begins with `+-`");
    }
  }

  /// Values are drawn within two standard deviations, and are lengths.
  Normal spread(const syntax::Quantity& quantity, const char* what) {
    const std::optional<Normal> normal = r_.quantities.normal(quantity, what);
    if (normal && 2 * normal->sd_m >= normal->mean_m)
      r_.error("E0313", quantity.span, std::string(what) + " could come out as nothing with this spread",
               "make the standard deviation less than half of the length");
    return normal.value_or(Normal{1, 0});
  }

  int reference(const syntax::Name& name) {
    if (made_.contains(name.text)) return symbols_.at(name.text);
    broken_ = true;
    if (is_broken(name.text)) return 0;
    std::vector<std::string_view> known(made_.begin(), made_.end());
    known.insert(known.end(), {"straight", "left", "right"});
    const std::string near = nearest(name.text, known);
    r_.error("E0211", name.span, "no production says how the hallway `" + name.text + "` grows",
             near.empty() ? "write one: `on: " + name.text + " -> straight 9 m;`"
                          : "did you mean `" + near + "`?");
    return 0;
  }

  std::vector<HallwayModule> modules(const std::vector<syntax::HallwayModule>& source) {
    std::vector<HallwayModule> row;
    for (const syntax::HallwayModule& from : source) {
      using enum HallwayModule::Kind;
      HallwayModule module;
      module.kind = from.word.empty()      ? symbol
                    : from.word == "left"  ? left
                    : from.word == "right" ? right
                                           : straight;
      module.to_end = from.to_end;
      if (from.quantity) module.length = spread(*from.quantity, "a straight's length");
      if (module.kind == symbol) module.symbol = reference(from.name);
      module.branch = modules(from.branch);
      row.push_back(std::move(module));
    }
    return row;
  }

  void production(const HallwayItem& item) {
    HallwayProduction production;
    production.name = item.name.text;
    production.symbol = symbols_.at(item.predecessor.text);
    if (item.condition) production.condition = resolve_condition(r_, *item.condition, ConditionOf::hallway);
    production.body = modules(item.body);
    if (item.probability) production.probability = r_.quantities.weight(*item.probability).value_or(1);
    grammar_.productions.push_back(std::move(production));
  }

  /// Symbols that a body can come to before its hallway has become any longer; all that it names, with
  /// `moved` at first.
  static void follow(const std::vector<HallwayModule>& row, bool moved, bool all, std::set<int>& symbols) {
    for (const HallwayModule& module : row) {
      if (module.kind == HallwayModule::Kind::symbol && (all || !moved)) symbols.insert(module.symbol);
      follow(module.branch, moved, all, symbols);
      moved = moved || module.kind == HallwayModule::Kind::straight;
    }
  }

  std::set<int> reachable(std::set<int> from, bool all) const {
    std::vector<int> open(from.begin(), from.end());
    while (!open.empty()) {
      const int symbol = open.back();
      open.pop_back();
      std::set<int> next;
      for (const HallwayProduction& production : grammar_.productions)
        if (production.symbol == symbol) follow(production.body, false, all, next);
      for (const int other : next)
        if (from.insert(other).second) open.push_back(other);
    }
    return from;
  }

  void check_uses() {
    const std::set<int> used = reachable({0}, true);
    std::set<int> reported;
    for (std::size_t i = 0; i < grammar_.productions.size(); ++i) {
      const HallwayProduction& production = grammar_.productions[i];
      const HallwayItem& source = *productions_[i];
      std::set<int> at_once;
      follow(production.body, false, false, at_once);
      if (reachable(at_once, false).contains(production.symbol) && !at_once.empty())
        r_.error("E0706", source.name.span,
                 "the production `" + production.name + "` can come back to `" + source.predecessor.text +
                     "` without the hallway growing, again and again",
                 "write a `straight` before the symbol that comes back");
      if (!used.contains(production.symbol) && reported.insert(production.symbol).second)
        r_.warning("W0204", source.predecessor.span,
                   "no production names the hallway `" + source.predecessor.text + "`, so it never grows",
                   "name it in a production, or write `axiom " + source.predecessor.text + ";`");
      else if (production.probability <= 0)
        r_.warning("W0703", source.name.span, "the production `" + production.name + "` is never applied",
                   "its probability is zero; give it one, or remove the production");
      else if (!can_hold(production.condition))
        r_.warning("W0705", source.condition->span,
                   "this condition never holds, so the production `" + production.name + "` is never applied",
                   "change the condition, or remove the production");
    }
  }

  Resolver& r_;
  const syntax::Hallways& block_;
  HallwayGrammar grammar_;
  std::map<std::string, int> symbols_;
  std::set<std::string_view> made_;  ///< symbols that have a production
  std::map<std::string, const HallwayItem*> settings_;
  std::vector<const HallwayItem*> productions_;
  bool broken_ = false;
};

}  // namespace

void resolve_hallways(Resolver& r) {
  for (const syntax::Hallways& block : r.file.hallways) {
    if (&block != &r.file.hallways.front()) {
      r.error("E0203", block.word.span, "`hallways` is given twice", "join the two blocks")
          .labels.push_back({r.file.hallways.front().word.span, "first given here"});
      continue;
    }
    HallwayResolver(r, block).run();
  }
}

}  // namespace gramap
