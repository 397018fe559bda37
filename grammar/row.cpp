#include "grammar/row.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include "grammar/sizes.h"
#include "grammar/unit.h"

namespace gramap {
namespace {

// Codes for rooms in contexts, besides indices into RuleSet::rooms.
constexpr int kEnd = -2;        // an end of the space
constexpr int kAny = -3;        // no requirement
constexpr int kUntracked = -4;  // a room that no left context asks for

constexpr std::size_t kMostStates = 20000;
constexpr int kLongestList = 64;
constexpr int kDeepestRewriting = 64;

/// What is still to be placed: an interned list. Index 0 is the empty list.
struct Cell {
  enum class Kind { symbol, items, repeat, require };
  Kind kind = Kind::symbol;
  const std::vector<Item>* row =
      nullptr;             // items: (*row)[index], then the rest of *row; repeat: (*row)[index]
  int index = 0;           // symbol: which; require: the room's code; repeat and items: see above
  int count = 0;           // repeat: times placed so far
  bool has_scope = false;  // items: relative and floating sizes refer to what is left of the space
  int rule = -1;           // whose items they are
  int next = 0;
  int length = 0;  // of the list from here

  auto key() const { return std::tie(kind, row, index, count, has_scope, rule, next); }
  bool operator<(const Cell& other) const { return key() < other.key(); }
};

struct Configuration {
  int list = 0;
  int last_rule = -1;
  int last_room = kUntracked;
  int required = kAny;
  auto operator<=>(const Configuration&) const = default;
};

int code(const SymbolRef& ref) {
  return ref.kind == SymbolRef::Kind::end ? kEnd : ref.index;
}

class Compiler {
 public:
  Compiler(const RuleSet& rules, const SpaceAttributes& space, std::vector<std::vector<bool>> classes)
      : rules_(rules), space_(space), classes_(std::move(classes)), recursive_(recursive_symbols(rules)) {
    tracked_rooms_.resize(rules.rooms.size());
    after_.resize(rules.symbols.size());
    for (const Rule& rule : rules.rules) {
      if (rule.left && rule.left->kind == SymbolRef::Kind::room)
        tracked_rooms_[static_cast<std::size_t>(rule.left->index)] = true;
      if (rule.left && rule.left->kind == SymbolRef::Kind::end) tracks_start_ = true;
      if (!rule.after) continue;
      after_[static_cast<std::size_t>(rule.symbol)] = true;
      for (const auto& [named, probability] : rule.after->named)
        after_[static_cast<std::size_t>(rules.rules[static_cast<std::size_t>(named)].symbol)] = true;
    }
    recursive_[0] = true;  // the start symbol comes back behind a background room
    cells_.push_back({});  // the empty list
  }

  Row compile() {
    Configuration start;
    start.list = push({Cell::Kind::symbol}, 0);
    start.last_room = tracks_start_ ? kEnd : kUntracked;
    state_of(start);
    for (std::size_t state = 0; state < states_.size(); ++state) {
      row_.arcs.emplace_back(classes_.size());
      for (std::size_t c = 0; c < classes_.size(); ++c) {
        class_ = c;
        expand(Configuration(states_[state]), 1, 0);
        row_.arcs[state][c] = std::exchange(pending_, {});
      }
      row_.accept.push_back(accepts(states_[state]));
    }
    return std::move(row_);
  }

 private:
  int push(Cell cell, int next) {
    cell.next = next;
    cell.length = next == 0 ? 1 : cells_[static_cast<std::size_t>(next)].length + 1;
    if (cell.length > kLongestList) not_a_row(commonest_rule(next));
    const auto [place, is_new] = interned_.try_emplace(cell, static_cast<int>(cells_.size()));
    if (is_new) cells_.push_back(cell);
    return place->second;
  }

  /// The rule that has left most in a list: the one that makes it grow.
  int commonest_rule(int list) const {
    std::map<int, int> counts;
    for (; list != 0; list = cells_[static_cast<std::size_t>(list)].next)
      ++counts[cells_[static_cast<std::size_t>(list)].rule];
    return std::max_element(counts.begin(), counts.end(),
                            [](const auto& a, const auto& b) { return a.second < b.second; })
        ->first;
  }

  /// The list after the first item of a cell of items.
  int rest_of(const Cell& cell) {
    if (cell.index + 1 >= static_cast<int>(cell.row->size())) return cell.next;
    Cell rest = cell;
    ++rest.index;
    return push(rest, cell.next);
  }

  int state_of(const Configuration& configuration) {
    const auto [place, is_new] = state_ids_.try_emplace(configuration, static_cast<int>(states_.size()));
    if (is_new) {
      if (states_.size() >= kMostStates) not_a_row(current_rule_);
      states_.push_back(configuration);
    }
    return place->second;
  }

  [[noreturn]] void fail(int rule, const std::string& message) const { throw RowFaultError{{rule, message}}; }

  [[noreturn]] void not_a_row(int rule) const {
    fail(rule,
         "this recursion cannot be reduced to a row of rooms: a symbol that recurs has to be the last "
         "item of its rule");
  }

  /// Nothing but requirements follows: the head has all that is left of the space.
  bool is_last(int list) const {
    while (list != 0 && cells_[static_cast<std::size_t>(list)].kind == Cell::Kind::require)
      list = cells_[static_cast<std::size_t>(list)].next;
    return list == 0;
  }

  // -- expansion: all that can be placed next

  void expand(const Configuration& c, double probability, int depth) {
    if (c.list == 0 || probability <= 0) return;
    const Cell cell = cells_[static_cast<std::size_t>(c.list)];
    Configuration rest = c;
    switch (cell.kind) {
      case Cell::Kind::require:
        rest.list = cell.next;
        if (rest.required == kAny) rest.required = cell.index;
        if (rest.required == cell.index) expand(rest, probability, depth);
        return;
      case Cell::Kind::symbol:
        rest.list = cell.next;
        rewrite(cell.index, rest, probability, depth, c.list);
        return;
      case Cell::Kind::repeat:
        repeat(cell, c, probability, depth);
        return;
      case Cell::Kind::items:
        rest.list = rest_of(cell);
        place(cell, c, rest, probability, depth);
        return;
    }
  }

  void place(const Cell& cell, const Configuration& c, const Configuration& rest, double probability,
             int depth) {
    const Item& item = (*cell.row)[static_cast<std::size_t>(cell.index)];
    const bool takes_rest = cell.has_scope && is_last(rest.list);
    if (is_written_out(item, takes_rest)) {
      if (item.kind == Item::Kind::piece) {
        rewrite(item.ref.index, rest, probability, depth, c.list);
        return;
      }
      Configuration next = c;
      if (item.kind == Item::Kind::repeat) {
        Cell counted{Cell::Kind::repeat, cell.row, cell.index};
        counted.rule = cell.rule;
        next.list = push(counted, rest.list);
      } else {
        next.list = push_items(item.children, cell.rule, takes_rest, rest.list);
      }
      expand(next, probability, depth);
      return;
    }
    for (const auto& [element, share] : elements_of(cell)) emit(element, rest, probability * share);
  }

  int push_items(const std::vector<Item>& items, int rule, bool has_scope, int next) {
    if (items.empty()) return next;
    Cell cell{Cell::Kind::items, &items};
    cell.rule = rule;
    cell.has_scope = has_scope;
    return push(cell, next);
  }

  void check_depth(int depth) const {
    if (depth > kDeepestRewriting)
      fail(current_rule_, "this rule comes back to its symbol without placing a room");
  }

  void repeat(const Cell& cell, const Configuration& c, double probability, int depth) {
    check_depth(depth);
    const Item& item = (*cell.row)[static_cast<std::size_t>(cell.index)];
    const double stop = stop_probability(item, cell.count);
    Configuration next = c;
    if (stop > 0) {
      next.list = cell.next;
      step({DerivationStep::Kind::stop}, [&] { expand(next, probability * stop, depth + 1); });
    }
    if (stop < 1) {
      Cell counted = cell;
      counted.count = item.most < 0 ? std::min(cell.count + 1, item.least) : cell.count + 1;
      next.list = push_items(item.children, cell.rule, false, push(counted, cell.next));
      step({DerivationStep::Kind::again}, [&] { expand(next, probability * (1 - stop), depth + 1); });
    }
  }

  /// Each count between least and most is equally likely; without a most, one half each time.
  static double stop_probability(const Item& item, int count) {
    if (count < item.least) return 0;
    return item.most < 0 ? 0.5 : 1.0 / (item.most - count + 1);
  }

  void rewrite(int symbol, const Configuration& rest, double probability, int depth, int whole_list) {
    check_depth(depth);
    std::vector<int> candidates;
    std::vector<double> weights;
    double sum = 0;
    for (std::size_t r = 0; r < rules_.rules.size(); ++r) {
      const Rule& rule = rules_.rules[r];
      if (rule.symbol != symbol || !classes_[class_][r]) continue;
      if (rule.left && code(*rule.left) != rest.last_room) continue;
      candidates.push_back(static_cast<int>(r));
    }
    weights = weigh(candidates, symbol, rest.last_rule);
    for (const double weight : weights) sum += weight;

    double foreseen = 1;
    if (recursive_[static_cast<std::size_t>(symbol)] && rules_.background.probability > 0) {
      foreseen = 1 - rules_.background.probability;
      Configuration again = rest;
      again.list = whole_list;
      step({DerivationStep::Kind::background},
           [&] { emit(background(), again, probability * rules_.background.probability); });
    }
    if (sum <= 0) return;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      if (weights[i] <= 0) continue;
      const int r = candidates[i];
      const Rule& rule = rules_.rules[static_cast<std::size_t>(r)];
      Configuration next = rest;
      if (after_[static_cast<std::size_t>(symbol)]) next.last_rule = rule.after ? r : -1;
      const bool has_scope = is_last(rest.list);
      if (rule.right) {
        Cell required{Cell::Kind::require};
        required.index = code(*rule.right);
        required.rule = r;
        const bool said = next.list != 0 &&
                          cells_[static_cast<std::size_t>(next.list)].kind == Cell::Kind::require &&
                          cells_[static_cast<std::size_t>(next.list)].index == required.index;
        if (!said) next.list = push(required, next.list);
      }
      next.list = push_items(rule.body, r, has_scope, next.list);
      const int caller = std::exchange(current_rule_, r);
      step({DerivationStep::Kind::rewrite, r},
           [&] { expand(next, probability * foreseen * weights[i] / sum, depth + 1); });
      current_rule_ = caller;
    }
  }

  /// P(R), or P(Rj | the rule used last) where that rule speaks of one of the symbol's rules.
  std::vector<double> weigh(const std::vector<int>& candidates, int symbol, int last_rule) {
    std::vector<double> weights;
    for (const int r : candidates) weights.push_back(rules_.rules[static_cast<std::size_t>(r)].probability);
    if (last_rule < 0) return weights;
    const Rule::After& after = *rules_.rules[static_cast<std::size_t>(last_rule)].after;
    const bool speaks = std::any_of(after.named.begin(), after.named.end(), [&](const auto& named) {
      return rules_.rules[static_cast<std::size_t>(named.first)].symbol == symbol;
    });
    if (!speaks) return weights;
    for (const int r : candidates) row_.sequels.emplace(last_rule, r);
    double unnamed = 0;
    std::vector<bool> is_named(candidates.size(), false);
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      for (const auto& [rule, probability] : after.named) {
        if (rule != candidates[i]) continue;
        is_named[i] = true;
        weights[i] = probability;
      }
      if (!is_named[i]) unnamed += weights[i];
    }
    for (std::size_t i = 0; i < candidates.size(); ++i)
      if (!is_named[i]) weights[i] = unnamed > 0 ? after.others * weights[i] / unnamed : 0;
    return weights;
  }

  template <class Then>
  void step(DerivationStep taken, Then then) {
    steps_.push_back(taken);
    then();
    steps_.pop_back();
  }

  void emit(int element, Configuration rest, double probability) {
    const Element& placed = row_.elements[static_cast<std::size_t>(element)];
    if (rest.required != kAny && rest.required != placed.first_type()) return;
    rest.required = kAny;
    const int last = placed.last_type();
    rest.last_room = last >= 0 && tracked_rooms_[static_cast<std::size_t>(last)] ? last : kUntracked;
    const int target = state_of(rest);
    const auto [place, is_new] =
        emissions_.try_emplace({element, target}, static_cast<int>(row_.emissions.size()));
    if (is_new) row_.emissions.push_back({element, target});
    pending_.push_back({element, target, place->second, probability, steps_});
  }

  // -- elements

  int background() {
    if (background_ >= 0) return background_;
    Element element;
    element.kind = Element::Width::uniform;
    element.least_m = rules_.background.least_m;
    element.most_m = rules_.background.most_m;
    element.rooms.push_back({});
    background_ = static_cast<int>(row_.elements.size());
    row_.elements.push_back(element);
    return background_;
  }

  /// The elements that the first item of a cell may become, each with its probability.
  std::vector<std::pair<int, double>> elements_of(const Cell& cell) {
    const Item& item = (*cell.row)[static_cast<std::size_t>(cell.index)];
    const auto known = elements_.find({&item, cell.rule});
    if (known != elements_.end()) return known->second;

    Element element;
    if (item.size.kind == Size::Kind::relative || item.size.kind == Size::Kind::floating) {
      if (!cell.has_scope)
        fail(cell.rule,
             "a relative or floating size needs a scope of known length: its rule has to be used in "
             "last place, or in an item that has a size");
      element.kind = Element::Width::share;
      element.share = share_of_rest(rules_, *cell.row, static_cast<std::size_t>(cell.index), cell.rule);
    } else {
      element.mixture = own_density(rules_, item, cell.rule);
      if (element.mixture.components.empty()) {
        element.kind = Element::Width::uniform;
        element.least_m = rules_.background.least_m;
        element.most_m = rules_.background.most_m;
      }
    }
    std::vector<std::pair<int, double>> made;
    for (const UnitVariant& variant : unit_variants(rules_, space_, item, cell.rule)) {
      element.rooms = variant.rooms;
      element.uses = variant.uses;
      made.push_back({static_cast<int>(row_.elements.size()), variant.probability});
      row_.elements.push_back(element);
    }
    elements_[{&item, cell.rule}] = made;
    return made;
  }

  // -- the end

  double accepts(const Configuration c) {
    double probability = 1;
    int required = c.required;
    int list = c.list;
    while (list != 0) {
      const Cell cell = cells_[static_cast<std::size_t>(list)];
      if (cell.kind == Cell::Kind::require) {
        if (required == kAny) required = cell.index;
        if (required != cell.index) return 0;
        list = cell.next;
      } else if (cell.kind == Cell::Kind::repeat) {
        probability *= stop_probability((*cell.row)[static_cast<std::size_t>(cell.index)], cell.count);
        list = cell.next;
      } else if (is_unbegun_repeat(cell)) {
        probability *= stop_probability((*cell.row)[static_cast<std::size_t>(cell.index)], 0);
        list = rest_of(cell);
      } else if (is_vanishing_symbol(cell)) {
        list = cell.next;
        if (!is_last(list)) return 0;
      } else {
        return 0;
      }
    }
    return required == kAny || required == kEnd ? probability : 0;
  }

  static bool is_unbegun_repeat(const Cell& cell) {
    if (cell.kind != Cell::Kind::items) return false;
    const Item& item = (*cell.row)[static_cast<std::size_t>(cell.index)];
    return item.kind == Item::Kind::repeat && item.size.kind == Size::Kind::own;
  }

  bool is_vanishing_symbol(const Cell& cell) const {
    if (cell.kind == Cell::Kind::symbol) return true;
    if (cell.index + 1 < static_cast<int>(cell.row->size())) return false;
    const Item& item = (*cell.row)[static_cast<std::size_t>(cell.index)];
    return item.kind == Item::Kind::piece && item.ref.kind == SymbolRef::Kind::symbol &&
           (item.size.kind == Size::Kind::own || item.size.kind == Size::Kind::floating);
  }

  const RuleSet& rules_;
  const SpaceAttributes& space_;
  std::vector<std::vector<bool>> classes_;  // [class][rule]: whether its condition holds
  std::vector<bool> recursive_;             // symbols that a background room may stand before
  std::vector<bool> tracked_rooms_;         // some left context asks for them
  std::vector<bool> after_;                 // symbols whose rules `after` blocks speak of
  bool tracks_start_ = false;

  std::vector<Cell> cells_;
  std::map<Cell, int> interned_;
  std::vector<Configuration> states_;
  std::map<Configuration, int> state_ids_;
  std::map<std::pair<const Item*, int>, std::vector<std::pair<int, double>>> elements_;
  std::map<std::pair<int, int>, int> emissions_;
  int background_ = -1;
  int current_rule_ = -1;

  Row row_;
  std::size_t class_ = 0;
  std::vector<Arc> pending_;
  std::vector<DerivationStep> steps_;
};

CompiledRow compile(const RuleSet& rules, const SpaceAttributes& space,
                    std::vector<std::vector<bool>> classes) {
  CompiledRow compiled;
  try {
    compiled.row = Compiler(rules, space, std::move(classes)).compile();
  } catch (const RowFaultError& error) {
    compiled.fault = error.fault;
  }
  return compiled;
}

}  // namespace

std::vector<bool> recursive_symbols(const RuleSet& rules) {
  const std::size_t n = rules.symbols.size();
  std::vector<std::vector<std::size_t>> leads_to(n);
  const auto visit = [&](auto&& self, const Item& item, std::size_t from) -> void {
    if (item.kind == Item::Kind::piece && item.ref.kind == SymbolRef::Kind::symbol)
      leads_to[from].push_back(static_cast<std::size_t>(item.ref.index));
    for (const Item& child : item.children) self(self, child, from);
  };
  for (const Rule& rule : rules.rules)
    for (const Item& item : rule.body) visit(visit, item, static_cast<std::size_t>(rule.symbol));
  std::vector<bool> recursive(n);
  for (std::size_t i = 0; i < n; ++i) {
    std::vector<bool> reached(n, false);
    std::vector<std::size_t> open{i};
    while (!open.empty() && !recursive[i]) {
      const std::size_t from = open.back();
      open.pop_back();
      for (const std::size_t to : leads_to[from]) {
        if (to == i) recursive[i] = true;
        if (!reached[to]) reached[to] = true, open.push_back(to);
      }
    }
  }
  return recursive;
}

bool is_written_out(const Item& item, bool takes_rest) {
  const bool has_no_size =
      item.size.kind == Size::Kind::own || (takes_rest && item.size.kind == Size::Kind::floating);
  if (!has_no_size) return false;
  if (item.kind == Item::Kind::piece) return item.ref.kind == SymbolRef::Kind::symbol;
  return item.kind == Item::Kind::repeat || (item.kind == Item::Kind::split && item.axis == Axis::along);
}

int Element::last_type() const {
  for (auto room = rooms.rbegin(); room != rooms.rend(); ++room)
    if (room->at_hallway) return room->type;
  return rooms.back().type;
}

CompiledRow compile_row(const RuleSet& rules, const SpaceAttributes& space, const Grid& grid) {
  std::vector<bool> constant(rules.rules.size());
  std::vector<std::size_t> varying;
  for (std::size_t r = 0; r < rules.rules.size(); ++r) {
    constant[r] = holds(rules.rules[r].condition, space, grid.remaining_m(0));
    if (depends_on_length(rules.rules[r].condition)) varying.push_back(r);
  }
  std::vector<std::vector<bool>> classes;
  std::map<std::vector<bool>, int> ids;
  std::vector<int> position_class(static_cast<std::size_t>(grid.cells) + 1, 0);
  std::vector<bool> truth = constant;
  for (int n = 0; n < grid.cells; ++n) {
    for (const std::size_t r : varying)
      truth[r] = holds(rules.rules[r].condition, space, grid.remaining_m(n));
    const auto [place, is_new] = ids.try_emplace(truth, static_cast<int>(classes.size()));
    if (is_new) classes.push_back(truth);
    position_class[static_cast<std::size_t>(n)] = place->second;
    if (varying.empty()) break;
  }
  CompiledRow compiled = compile(rules, space, std::move(classes));
  compiled.row.position_class = std::move(position_class);
  return compiled;
}

std::optional<RowFault> check_row(const RuleSet& rules) {
  return compile(rules, {}, {std::vector<bool>(rules.rules.size(), true)}).fault;
}

}  // namespace gramap
