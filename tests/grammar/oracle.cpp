#include "tests/grammar/oracle.h"

#include <algorithm>
#include <cmath>

#include "grammar/condition.h"
#include "grammar/lattice.h"
#include "grammar/sizes.h"
#include "grammar/unit.h"

namespace gramap::test {
namespace {

constexpr int kSpaceEnd = -10;
constexpr int kNobody = -11;
constexpr int kUnknown = -1;
constexpr long kTriesPerLayout = 12;  // dead ends count, too

struct Todo {
  enum class Kind { start, item, begun_repeat, require } kind = Kind::start;
  const std::vector<Item>* row = nullptr;
  std::size_t index = 0;
  bool has_scope = false;
  int number = 0;  // repeat: times done; require: the room's type or kSpaceEnd
  int rule = -1;
  const Item& item() const { return (*row)[index]; }
};

struct Placed {
  std::vector<ElementRoom> rooms;
  int cell = 0;
  int width = 0;
};

int type_or_end(const SymbolRef& ref) {
  return ref.kind == SymbolRef::Kind::end ? kSpaceEnd : ref.index;
}

class Oracle {
 public:
  Oracle(const RuleSet& rules, const SpaceProblem& problem, const Evidence& evidence, const Grid& grid,
         long most, OracleQuestions* wanted)
      : rules_(rules),
        space_{problem.depth_m, problem.hallway, problem.facade},
        evidence_(evidence),
        grid_(grid),
        most_(most),
        wanted_(wanted) {
    result_.coverage.assign(rules.rooms.size() + 1,
                            std::vector<double>(static_cast<std::size_t>(grid.cells), 0));
  }

  std::optional<OracleResult> run() {
    go({Todo{}}, 0, 1, -1, kSpaceEnd, kNobody);
    if (result_.layouts > most_ || tried_ > kTriesPerLayout * most_) return std::nullopt;
    return result_;
  }

 private:
  using List = std::vector<Todo>;  // the head is last

  static bool only_requirements(const List& list) {
    return std::all_of(list.begin(), list.end(), [](const Todo& t) { return t.kind == Todo::Kind::require; });
  }

  static List without_head(List list) {
    if (list.back().kind == Todo::Kind::item && list.back().index + 1 < list.back().row->size())
      ++list.back().index;
    else
      list.pop_back();
    return list;
  }

  static void push(List& list, const std::vector<Item>& row, bool has_scope, int rule) {
    if (!row.empty()) list.push_back({Todo::Kind::item, &row, 0, has_scope, 0, rule});
  }

  void go(const List& list, int cell, double p, int last_rule, int last_room, int required) {
    if (p <= 0 || ++tried_ > kTriesPerLayout * most_) return;
    if (cell == grid_.cells) {
      finish(list, p, required);
      return;
    }
    if (list.empty()) return;
    const Todo head = list.back();
    if (head.kind == Todo::Kind::require) {
      if (required != kNobody && required != head.number) return;
      go(without_head(list), cell, p, last_rule, last_room, head.number);
      return;
    }
    if (head.kind == Todo::Kind::start) {
      rewrite(0, list, without_head(list), cell, p, last_rule, last_room, required);
      return;
    }
    const Item& item = head.item();
    if (head.kind == Todo::Kind::begun_repeat) {
      const double stop = stop_share(item, head.number);
      List stopped = list;
      stopped.pop_back();
      go(stopped, cell, p * stop, last_rule, last_room, required);
      List again = list;
      ++again.back().number;
      push(again, item.children, false, head.rule);
      go(again, cell, p * (1 - stop), last_rule, last_room, required);
      return;
    }
    List rest = without_head(list);
    const bool sized = !(item.size.kind == Size::Kind::own || (item.size.kind == Size::Kind::floating &&
                                                               head.has_scope && only_requirements(rest)));
    const bool is_symbol = item.kind == Item::Kind::piece && item.ref.kind == SymbolRef::Kind::symbol;
    if (is_symbol && !sized) {
      rewrite(item.ref.index, list, rest, cell, p, last_rule, last_room, required);
    } else if (item.kind == Item::Kind::repeat && !sized) {
      rest.push_back({Todo::Kind::begun_repeat, head.row, head.index, false, 0, head.rule});
      go(rest, cell, p, last_rule, last_room, required);
    } else if (item.kind == Item::Kind::split && item.axis == Axis::along && !sized) {
      const bool scope = head.has_scope && only_requirements(rest);
      push(rest, item.children, scope, head.rule);
      go(rest, cell, p, last_rule, last_room, required);
    } else {
      const std::vector<WidthMass> masses = item_masses(head, cell);
      for (const UnitVariant& variant : unit_variants(rules_, space_, item, head.rule))
        place(variant.rooms, masses, rest, cell, p * variant.probability, last_rule, required);
    }
  }

  static double stop_share(const Item& item, int done) {
    if (done < item.least) return 0;
    return item.most < 0 ? 0.5 : 1.0 / (1 + item.most - done);
  }

  void rewrite(int symbol, const List& whole, const List& rest, int cell, double p, int last_rule,
               int last_room, int required) {
    const double remaining = grid_.cells * grid_.step_m - cell * grid_.step_m - grid_.wall_m;
    std::vector<std::size_t> able;
    for (std::size_t r = 0; r < rules_.rules.size(); ++r) {
      const Rule& rule = rules_.rules[r];
      if (rule.symbol == symbol && holds(rule.condition, space_, remaining) &&
          (!rule.left || type_or_end(*rule.left) == last_room))
        able.push_back(r);
    }
    double foreseen = 1;
    if ((symbol == 0 || comes_back(symbol, symbol, 0)) && rules_.background.probability > 0) {
      foreseen -= rules_.background.probability;
      ElementRoom unknown;
      place({unknown}, {uniform()}, whole, cell, p * rules_.background.probability, last_rule, required);
    }
    std::vector<double> shares;
    for (const std::size_t r : able) shares.push_back(rules_.rules[r].probability);
    if (last_rule >= 0)
      apply_after(*rules_.rules[static_cast<std::size_t>(last_rule)].after, symbol, able, shares);
    double sum = 0;
    for (const double share : shares) sum += share;
    if (sum <= 0) return;
    for (std::size_t i = 0; i < able.size(); ++i) {
      const Rule& rule = rules_.rules[able[i]];
      List next = rest;
      const bool scope = only_requirements(rest);
      if (rule.right) next.push_back({Todo::Kind::require, nullptr, 0, false, type_or_end(*rule.right), -1});
      push(next, rule.body, scope, static_cast<int>(able[i]));
      int used = last_rule;
      if (in_after(symbol)) used = rule.after ? static_cast<int>(able[i]) : -1;
      go(next, cell, p * foreseen * shares[i] / sum, used, last_room, required);
    }
  }

  bool in_after(int symbol) const {
    return std::any_of(rules_.rules.begin(), rules_.rules.end(), [&](const Rule& rule) {
      if (!rule.after) return false;
      if (rule.symbol == symbol) return true;
      return std::any_of(rule.after->named.begin(), rule.after->named.end(), [&](const auto& named) {
        return rules_.rules[static_cast<std::size_t>(named.first)].symbol == symbol;
      });
    });
  }

  void apply_after(const Rule::After& after, int symbol, const std::vector<std::size_t>& able,
                   std::vector<double>& shares) const {
    const auto named = [&](std::size_t rule) -> const double* {
      for (const auto& [id, probability] : after.named)
        if (static_cast<std::size_t>(id) == rule) return &probability;
      return nullptr;
    };
    bool speaks = false;
    for (std::size_t r = 0; r < rules_.rules.size(); ++r)
      if (rules_.rules[r].symbol == symbol && named(r) != nullptr) speaks = true;
    if (!speaks) return;
    double others = 0;
    for (std::size_t i = 0; i < able.size(); ++i)
      if (named(able[i]) == nullptr) others += shares[i];
    for (std::size_t i = 0; i < able.size(); ++i) {
      const double* own = named(able[i]);
      shares[i] = own != nullptr ? *own : others > 0 ? after.others * shares[i] / others : 0;
    }
  }

  bool comes_back(int from, int to, int depth) const {
    if (depth > 8) return false;
    const auto inside = [&](auto&& self, const Item& item) -> bool {
      if (item.kind == Item::Kind::piece && item.ref.kind == SymbolRef::Kind::symbol)
        if (item.ref.index == to || comes_back(item.ref.index, to, depth + 1)) return true;
      return std::any_of(item.children.begin(), item.children.end(),
                         [&](const Item& c) { return self(self, c); });
    };
    for (const Rule& rule : rules_.rules)
      if (rule.symbol == from)
        for (const Item& item : rule.body)
          if (inside(inside, item)) return true;
    return false;
  }

  WidthMass uniform() const {
    const int first =
        static_cast<int>(std::ceil((rules_.background.least_m + grid_.wall_m) / grid_.step_m - 1e-9));
    const int last =
        static_cast<int>(std::floor((rules_.background.most_m + grid_.wall_m) / grid_.step_m + 1e-9));
    return {first, std::vector<double>(static_cast<std::size_t>(last - first + 1), 1.0 / (last - first + 1))};
  }

  std::vector<WidthMass> item_masses(const Todo& head, int cell) const {
    const Item& item = head.item();
    if (item.size.kind == Size::Kind::relative || item.size.kind == Size::Kind::floating) {
      const double left = (grid_.cells - cell) * grid_.step_m - grid_.wall_m;
      return mixture_mass({{{1, {share(*head.row, head.index, left), kDefaultTolerance_m}}}}, grid_);
    }
    return mixture_mass(own_density(rules_, item, head.rule), grid_);
  }

  /// Mean width of an item: the scope is solved for from what is left, all other items at their means.
  double share(const std::vector<Item>& row, std::size_t index, double left) const {
    const auto widths = [&](double scope) {
      double fixed = 0;
      double floating = 0;
      std::vector<double> w;
      for (const Item& item : row) {
        w.push_back(0);
        if (item.size.kind == Size::Kind::relative)
          w.back() = item.size.value * scope;
        else if (item.size.kind == Size::Kind::floating)
          floating += item.size.value;
        else
          w.back() = mean_m(own_density(rules_, item, -1));
        fixed += w.back();
      }
      for (std::size_t i = 0; i < row.size(); ++i)
        if (row[i].size.kind == Size::Kind::floating) w[i] = row[i].size.value / floating * (scope - fixed);
      return w;
    };
    const auto taken = [&](double scope) {
      const std::vector<double> w = widths(scope);
      double sum = grid_.wall_m * static_cast<double>(row.size() - index - 1);
      for (std::size_t i = index; i < row.size(); ++i) sum += w[i];
      return sum;
    };
    const double at_zero = taken(0);
    const double scope = (left - at_zero) / (taken(1) - at_zero);
    return widths(scope)[index];
  }

  void place(const std::vector<ElementRoom>& rooms, const std::vector<WidthMass>& masses, const List& rest,
             int cell, double p, int last_rule, int required) {
    if (required != kNobody && required != rooms.front().type) return;
    int last_room = rooms.back().type;
    for (const ElementRoom& room : rooms)
      if (room.at_hallway) last_room = room.type;
    for (const WidthMass& mass : masses) {
      for (std::size_t i = 0; i < mass.mass.size(); ++i) {
        const int width = mass.first + static_cast<int>(i);
        if (cell + width > grid_.cells || mass.mass[i] <= 0) continue;
        placed_.push_back({rooms, cell, width});
        go(rest, cell + width, p * mass.mass[i], last_rule, last_room == kUnknown ? -12 : last_room, kNobody);
        placed_.pop_back();
      }
    }
  }

  void finish(List list, double p, int required) {
    while (!list.empty()) {
      const Todo head = list.back();
      if (head.kind == Todo::Kind::require) {
        if (required != kNobody && required != head.number) return;
        required = head.number;
        list.pop_back();
      } else if (head.kind == Todo::Kind::begun_repeat) {
        p *= stop_share(head.item(), head.number);
        list.pop_back();
      } else if (head.kind == Todo::Kind::item && head.item().kind == Item::Kind::repeat &&
                 head.item().size.kind == Size::Kind::own) {
        p *= stop_share(head.item(), 0);
        list = without_head(list);
      } else {
        const bool vanishes =
            head.kind == Todo::Kind::start ||
            (head.item().kind == Item::Kind::piece && head.item().ref.kind == SymbolRef::Kind::symbol &&
             (head.item().size.kind == Size::Kind::own || head.item().size.kind == Size::Kind::floating));
        list = without_head(list);
        if (!vanishes || !only_requirements(list)) return;
      }
    }
    if (p <= 0 || (required != kNobody && required != kSpaceEnd)) return;
    record(p);
  }

  // -- evidence: every association, one by one

  Extent extent(const Placed& element) const {
    const double start = element.cell * grid_.step_m;
    return {start, start + element.width * grid_.step_m - grid_.wall_m};
  }

  double belongs(const PreparedEvidence& e, const Placed& element) const {
    double sum = 0;
    for (const ElementRoom& room : element.rooms) {
      const Extent whole = extent(element);
      const double start = whole.start_m + room.start.at(whole.width_m());
      sum += evidence_.type_factor(e, room.type) *
             evidence_.belongs(e, {start, start + room.width.at(whole.width_m())});
    }
    return sum / static_cast<double>(element.rooms.size());
  }

  /// Sum and maximum over the associations of evidence j and later ones to element `least` and later ones.
  /// `previous`: the element that explains the evidence before, whose factor `again` it has when shared.
  std::pair<double, double> associations(std::size_t j, std::size_t least, int previous, double again) const {
    if (j == evidence_.rooms().size()) return {1, 1};
    const PreparedEvidence& e = evidence_.rooms()[j];
    auto [sum, most] = associations(j + 1, least, previous, again);
    sum *= e.aside;
    most *= e.aside;
    const auto add = [&](double weight, std::pair<double, double> later) {
      sum += weight * later.first;
      most = std::max(most, weight * later.second);
    };
    for (std::size_t i = least; i < placed_.size(); ++i) {
      const double shared = static_cast<int>(i) == previous ? again : 1;
      const double weight = belongs(e, placed_[i]);
      if (weight > 0) add(shared * weight, associations(j + 1, i, static_cast<int>(i), e.again));
      if (i + 1 >= placed_.size()) continue;
      const double opens = evidence_.reading(e, Reading::opens, extent(placed_[i]));
      const double closes = evidence_.reading(e, Reading::closes, extent(placed_[i + 1]));
      if (opens * closes > 0) add(shared * opens * closes, associations(j + 1, i + 2, -1, 1));
    }
    return {sum, most};
  }

  void record(double p) {
    if (++result_.layouts > most_) return;
    if (evidence_.has_doors()) {
      for (const Placed& element : placed_)
        for (const ElementRoom& room : element.rooms) {
          if (!room.at_hallway) continue;
          const double clear = extent(element).width_m();
          const int from = static_cast<int>(std::lround(room.start.at(clear) / grid_.step_m));
          const int to = static_cast<int>(
              std::lround((room.start.at(clear) + room.width.at(clear) + grid_.wall_m) / grid_.step_m));
          p *= evidence_.doors(room.type, element.cell + from, element.cell + to);
        }
    }
    const auto [sum, most] = associations(0, 0, -1, 1);
    const double weight = p * sum;
    std::string key;
    for (const Placed& element : placed_) {
      for (const ElementRoom& room : element.rooms) {
        char text[64];
        std::snprintf(text, sizeof text, "%d@%.6f+%.6f,", room.type, room.depth_start_m, room.depth_m);
        key += text;
      }
      key += " ";
    }
    OracleSequence& sequence = result_.sequences[key];
    sequence.weight += weight;
    sequence.best_layout = std::max(sequence.best_layout, p * most);
    for (std::vector<double>* moments : {&sequence.x, &sequence.xx, &sequence.w, &sequence.ww})
      moments->resize(placed_.size(), 0);
    for (std::size_t i = 0; i < placed_.size(); ++i) {
      const double x = extent(placed_[i]).start_m;
      const double w = extent(placed_[i]).width_m();
      sequence.x[i] += weight * x;
      sequence.xx[i] += weight * x * x;
      sequence.w[i] += weight * w;
      sequence.ww[i] += weight * w * w;
      if (wanted_ != nullptr && placed_[i].rooms.size() == 1)
        for (OracleRoom& room : wanted_->rooms)
          if (placed_[i].cell <= room.middle && room.middle < placed_[i].cell + placed_[i].width) {
            const int off = placed_[i].width - room.width;
            if (placed_[i].rooms[0].type == room.type && std::abs(off) <= room.tolerance)
              room.weight += weight;
            room.square_cells += weight * off * off;
          }
      if (placed_[i].rooms.size() == 1)
        for (int cell = placed_[i].cell; cell < placed_[i].cell + placed_[i].width; ++cell)
          result_.coverage[static_cast<std::size_t>(placed_[i].rooms[0].type + 1)]
                          [static_cast<std::size_t>(cell)] += weight;
    }
    if (wanted_ != nullptr)
      for (auto& [cell, square_cells] : wanted_->walls) {
        int nearest = grid_.cells;
        for (const Placed& element : placed_)
          for (const int wall : {element.cell, element.cell + element.width})
            nearest = std::min(nearest, std::abs(wall - cell));
        square_cells += weight * nearest * nearest;
      }
    result_.total += weight;
  }

  const RuleSet& rules_;
  SpaceAttributes space_;
  const Evidence& evidence_;
  Grid grid_;
  long most_;
  OracleQuestions* wanted_;
  long tried_ = 0;
  std::vector<Placed> placed_;
  OracleResult result_;
};

}  // namespace

std::optional<OracleResult> enumerate_layouts(const RuleSet& rules, const SpaceProblem& problem,
                                              const Evidence& evidence, const Grid& grid, long most,
                                              OracleQuestions* wanted) {
  return Oracle(rules, problem, evidence, grid, most, wanted).run();
}

}  // namespace gramap::test
