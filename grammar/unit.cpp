#include "grammar/unit.h"

#include <cmath>
#include <cstdio>
#include <string>

#include "grammar/sizes.h"

namespace gramap {
namespace {

constexpr std::size_t kMostVariants = 1000;
constexpr int kDeepestUnit = 32;
constexpr double kFillSigmas = 4;  // how far sizes may stretch to fill their scope, in standard deviations

[[noreturn]] void fail(int rule, const std::string& message) {
  throw RowFaultError{{rule, message}};
}

/// a item as one stretch of its scope: its size, and the variance that it can give way with.
struct Demand {
  enum class Kind { fixed, relative, floating };
  Kind kind = Kind::floating;
  double value = 1;
  double variance = 0;
};

Demand moments(const Mixture& density) {
  const double mean = mean_m(density);
  double second = 0;
  for (const Mixture::Component& c : density.components)
    second +=
        c.weight * (c.normal.sd_m * c.normal.sd_m + (c.normal.mean_m - mean) * (c.normal.mean_m - mean));
  return {Demand::Kind::fixed, mean, second};
}

/// Where a scope lies in the element.
struct Frame {
  Affine start;
  Affine width;
  double depth_start_m = 0;
  double depth_m = -1;  // < 0: the whole depth of the space
};

Affine sum(const Affine& a, const Affine& b) {
  return {a.constant + b.constant, a.slope + b.slope};
}
Affine scaled(const Affine& a, double factor) {
  return {a.constant * factor, a.slope * factor};
}

/// Sizes of the pieces as functions of the scope's extent. When nothing floats, what is missing or too much
/// is shared in proportion to the variances.
std::vector<Affine> fill(const std::vector<Demand>& pieces, double wall_m, int rule) {
  const double walls_m = wall_m * static_cast<double>(pieces.size() - 1);
  double fixed = 0;
  double relative = 0;
  double floating = 0;
  double variance = 0;
  for (const Demand& piece : pieces) {
    if (piece.kind == Demand::Kind::fixed) fixed += piece.value;
    if (piece.kind == Demand::Kind::relative) relative += piece.value;
    if (piece.kind == Demand::Kind::floating) floating += piece.value;
    variance += piece.variance;
  }
  const Affine scope{-walls_m, 1};
  const Affine rest{scope.constant * (1 - relative) - fixed, scope.slope * (1 - relative)};
  if (floating <= 0 && variance <= 0 && std::abs(relative - 1) > 1e-6)
    fail(rule, "relative sizes add up to " + std::to_string(relative) + " of their scope, not to 1");
  std::vector<Affine> sizes;
  for (const Demand& piece : pieces) {
    Affine size{0, 0};
    if (piece.kind == Demand::Kind::fixed) size.constant = piece.value;
    if (piece.kind == Demand::Kind::relative) size = scaled(scope, piece.value);
    if (piece.kind == Demand::Kind::floating) size = scaled(rest, piece.value / floating);
    if (floating <= 0 && variance > 0) size = sum(size, scaled(rest, piece.variance / variance));
    sizes.push_back(size);
  }
  return sizes;
}

class Expander {
 public:
  Expander(const RuleSet& rules, const SpaceAttributes& space) : rules_(rules), space_(space) {}

  std::vector<UnitVariant> expand(const Item& item, const Frame& frame, int rule, int depth) const {
    if (depth > kDeepestUnit) fail(rule, "a unit cannot hold recursion: its rooms would have no end");
    switch (item.kind) {
      case Item::Kind::merge:
        return room(item.ref.index, frame, rule);
      case Item::Kind::split:
        return split(item.children, item.axis, frame, rule, depth);
      case Item::Kind::repeat:
        return split({unsized(item)}, Axis::along, frame, rule, depth);
      case Item::Kind::piece:
        if (item.ref.kind == SymbolRef::Kind::room) return room(item.ref.index, frame, rule);
        return symbol(item.ref.index, frame, rule, depth);
    }
    return {};
  }

 private:
  static Item unsized(Item item) {
    item.size = {};
    return item;
  }

  static std::vector<UnitVariant> room(int type, const Frame& frame, int rule) {
    ElementRoom room;
    room.type = type;
    room.rule = rule;
    room.start = frame.start;
    room.width = frame.width;
    room.depth_start_m = frame.depth_start_m;
    room.depth_m = frame.depth_m;
    room.at_hallway = frame.depth_start_m <= 0;
    return {{1, {room}, {}}};
  }

  std::vector<UnitVariant> symbol(int index, const Frame& frame, int caller, int depth) const {
    std::vector<int> candidates;
    double sum = 0;
    for (std::size_t r = 0; r < rules_.rules.size(); ++r) {
      const Rule& rule = rules_.rules[r];
      if (rule.symbol != index) continue;
      const int id = static_cast<int>(r);
      if (rule.left || rule.right)
        fail(id, "contexts hold along the hallway only, and this rule is used inside a unit");
      if (rule.after)
        fail(id, "`after` speaks of what follows along the hallway, and this rule is used inside a unit");
      if (depends_on_length(rule.condition))
        fail(id, "a condition on the remaining length cannot be asked inside a unit");
      if (!holds(rule.condition, space_, 0)) continue;
      candidates.push_back(id);
      sum += rule.probability;
    }
    if (sum <= 0)
      fail(caller,
           "no rule of " + rules_.symbols[static_cast<std::size_t>(index)] + " applies inside this unit");
    std::vector<UnitVariant> variants;
    for (const int r : candidates) {
      const Rule& rule = rules_.rules[static_cast<std::size_t>(r)];
      for (UnitVariant& variant : split(rule.body, Axis::along, frame, r, depth)) {
        variant.probability *= rule.probability / sum;
        shift(variant.rooms, variant.uses, 1, -1);
        variant.uses.insert(variant.uses.begin(), {r, -1});
        variants.push_back(std::move(variant));
      }
    }
    check_count(variants.size(), caller);
    return variants;
  }

  /// Renumbers uses, from `least` on: -1 stands for the use that all of them belong to.
  static void shift(std::vector<ElementRoom>& rooms, std::vector<InnerUse>& uses, int by, int least) {
    for (ElementRoom& room : rooms)
      if (room.use >= least) room.use += by;
    for (InnerUse& use : uses)
      if (use.parent >= least) use.parent += by;
  }

  static void check_count(std::size_t count, int rule) {
    if (count > kMostVariants)
      fail(rule, "a unit with more than " + std::to_string(kMostVariants) + " ways to come out is too large");
  }

  /// A sequence of items with its repeats written out, in every count.
  struct Sequence {
    double probability = 1;
    std::vector<const Item*> items;
  };

  std::vector<Sequence> sequences(const std::vector<Item>& items, int rule) const {
    std::vector<Sequence> made{{}};
    for (const Item& item : items) {
      std::vector<Sequence> next;
      const bool counted = item.kind == Item::Kind::repeat && item.size.kind == Size::Kind::own;
      if (counted && item.most < 0) fail(rule, "a repeat inside a unit needs a most");
      const int least = counted ? item.least : 1;
      const int most = counted ? item.most : 1;
      const std::vector<Sequence> children =
          counted ? sequences(item.children, rule) : std::vector<Sequence>{};
      for (int count = least; count <= most; ++count) {
        std::vector<Sequence> grown = made;
        for (Sequence& sequence : grown) sequence.probability /= most - least + 1;
        for (int i = 0; i < count; ++i) {
          if (!counted) {
            for (Sequence& sequence : grown) sequence.items.push_back(&item);
            continue;
          }
          std::vector<Sequence> longer;
          for (const Sequence& sequence : grown)
            for (const Sequence& child : children) {
              longer.push_back(sequence);
              longer.back().probability *= child.probability;
              longer.back().items.insert(longer.back().items.end(), child.items.begin(), child.items.end());
            }
          grown = std::move(longer);
          check_count(grown.size(), rule);
        }
        next.insert(next.end(), grown.begin(), grown.end());
      }
      made = std::move(next);
      check_count(made.size(), rule);
    }
    return made;
  }

  Demand demand(const Item& item, Axis axis, int rule) const {
    switch (item.size.kind) {
      case Size::Kind::absolute:
        return moments(with_tolerance(item.size.width));
      case Size::Kind::relative:
        return {Demand::Kind::relative, item.size.value, 0};
      case Size::Kind::floating:
        return {Demand::Kind::floating, item.size.value, 0};
      case Size::Kind::own:
        break;
    }
    const bool is_symbol = item.kind == Item::Kind::piece && item.ref.kind == SymbolRef::Kind::symbol;
    if (axis == Axis::along) {
      if (is_symbol) return {};
      const Mixture density = own_density(rules_, item, rule);
      return density.components.empty() ? Demand{} : moments(density);
    }
    const bool is_room = (item.kind == Item::Kind::piece && !is_symbol) || item.kind == Item::Kind::merge;
    if (!is_room) return {};
    const std::optional<Normal>& depth = rules_.rooms[static_cast<std::size_t>(item.ref.index)].depth;
    return depth ? moments(with_tolerance({{{1, *depth}}})) : Demand{};
  }

  std::vector<UnitVariant> split(const std::vector<Item>& items, Axis axis, const Frame& frame, int rule,
                                 int depth) const {
    std::vector<UnitVariant> variants;
    for (const Sequence& sequence : sequences(items, rule)) {
      if (sequence.items.empty())
        fail(rule, "a split inside a unit may not be empty: it would leave its scope unfilled");
      std::vector<Demand> demands;
      for (const Item* item : sequence.items) demands.push_back(demand(*item, axis, rule));
      const std::vector<Affine> sizes = fill(demands, rules_.inner_wall_m, rule);
      if (axis == Axis::across) check_depth(demands, sizes, frame, rule);
      std::vector<UnitVariant> grown{{sequence.probability, {}, {}}};
      Frame at = frame;
      for (std::size_t i = 0; i < sizes.size(); ++i) {
        if (axis == Axis::along) {
          at.width = {sizes[i].constant + sizes[i].slope * frame.width.constant,
                      sizes[i].slope * frame.width.slope};
        } else {
          at.depth_m = sizes[i].at(depth_of(frame));
        }
        grown = joined(grown, expand(*sequence.items[i], at, rule, depth + 1), rule);
        at.start = axis == Axis::along ? sum(sum(at.start, at.width), {rules_.inner_wall_m, 0}) : at.start;
        if (axis == Axis::across) at.depth_start_m += at.depth_m + rules_.inner_wall_m;
      }
      variants.insert(variants.end(), grown.begin(), grown.end());
      check_count(variants.size(), rule);
    }
    return variants;
  }

  static std::vector<UnitVariant> joined(const std::vector<UnitVariant>& before,
                                         const std::vector<UnitVariant>& after, int rule) {
    std::vector<UnitVariant> both;
    check_count(before.size() * after.size(), rule);
    for (const UnitVariant& a : before)
      for (UnitVariant b : after) {
        shift(b.rooms, b.uses, static_cast<int>(a.uses.size()), 0);
        both.push_back(a);
        both.back().probability *= b.probability;
        both.back().rooms.insert(both.back().rooms.end(), b.rooms.begin(), b.rooms.end());
        both.back().uses.insert(both.back().uses.end(), b.uses.begin(), b.uses.end());
      }
    return both;
  }

  double depth_of(const Frame& frame) const { return frame.depth_m < 0 ? space_.depth_m : frame.depth_m; }

  /// Refuses a split across whose sizes do not fill the depth. Without a known depth nothing can be said.
  void check_depth(const std::vector<Demand>& demands, const std::vector<Affine>& sizes, const Frame& frame,
                   int rule) const {
    const double scope = depth_of(frame);
    if (scope <= 0) return;
    double floating = 0;
    double variance = 0;
    double residual = scope - rules_.inner_wall_m * static_cast<double>(demands.size() - 1);
    bool positive = true;
    for (std::size_t i = 0; i < demands.size(); ++i) {
      if (demands[i].kind == Demand::Kind::floating) floating += demands[i].value;
      if (demands[i].kind == Demand::Kind::fixed) residual -= demands[i].value;
      if (demands[i].kind == Demand::Kind::relative)
        residual -=
            demands[i].value * (scope - rules_.inner_wall_m * static_cast<double>(demands.size() - 1));
      variance += demands[i].variance;
      positive = positive && sizes[i].at(scope) > 0;
    }
    const bool fills = floating > 0 || std::abs(residual) <= kFillSigmas * std::sqrt(variance) + 1e-6;
    if (fills && positive) return;
    char text[160];
    std::snprintf(text, sizeof text, "this split does not fill the %.2f m across it: %.2f m %s", scope,
                  std::abs(residual), residual < 0 ? "too much" : "are left over");
    fail(rule, text);
  }

  const RuleSet& rules_;
  const SpaceAttributes& space_;
};

}  // namespace

std::vector<UnitVariant> unit_variants(const RuleSet& rules, const SpaceAttributes& space, const Item& item,
                                       int rule) {
  return Expander(rules, space).expand(item, {{0, 0}, {0, 1}}, rule, 0);
}

}  // namespace gramap
