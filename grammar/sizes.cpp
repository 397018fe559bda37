#include "grammar/sizes.h"

#include <cmath>

namespace gramap {
namespace {

[[noreturn]] void fail(int rule, const std::string& message) {
  throw RowFaultError{{rule, message}};
}

/// Sums over some items of a row: what they take, by kind of size.
struct Demand {
  double absolute_m = 0;
  double relative = 0;
  double floating = 0;
};

Demand demand(const RuleSet& rules, const std::vector<Item>& row, std::size_t begin, std::size_t end,
              int rule) {
  Demand sum;
  for (std::size_t i = begin; i < end; ++i) {
    const Item& item = row[i];
    if (item.size.kind == Size::Kind::relative) {
      sum.relative += item.size.value;
    } else if (item.size.kind == Size::Kind::floating) {
      sum.floating += item.size.value;
    } else {
      const Mixture density = own_density(rules, item, rule);
      if (density.components.empty())
        fail(rule, "a relative or floating size beside a room of no stated width cannot be computed");
      sum.absolute_m += mean_m(density);
    }
  }
  return sum;
}

}  // namespace

Mixture with_tolerance(Mixture mixture) {
  for (Mixture::Component& component : mixture.components)
    if (component.normal.sd_m <= 0) component.normal.sd_m = kDefaultTolerance_m;
  return mixture;
}

double mean_m(const Mixture& mixture) {
  double mean = 0;
  for (const Mixture::Component& component : mixture.components)
    mean += component.weight * component.normal.mean_m;
  return mean;
}

Mixture side_by_side(const std::vector<Mixture>& parts, double wall_m) {
  Mixture sum{{{1.0, {-wall_m, 0}}}};
  for (const Mixture& part : parts) {
    Mixture next;
    for (const Mixture::Component& a : sum.components)
      for (const Mixture::Component& b : part.components)
        next.components.push_back(
            {a.weight * b.weight,
             {a.normal.mean_m + wall_m + b.normal.mean_m, std::hypot(a.normal.sd_m, b.normal.sd_m)}});
    sum = next;
  }
  return sum;
}

Mixture own_density(const RuleSet& rules, const Item& item, int rule) {
  if (item.size.kind == Size::Kind::absolute) return with_tolerance(item.size.width);
  if (item.size.kind != Size::Kind::own) fail(rule, "a relative or floating size has no scope here");
  switch (item.kind) {
    case Item::Kind::piece:
      if (item.ref.kind == SymbolRef::Kind::room)
        return with_tolerance(rules.rooms[static_cast<std::size_t>(item.ref.index)].width);
      fail(rule, "how much " + rules.symbols[static_cast<std::size_t>(item.ref.index)] +
                     " takes is not known here; give it a size");
    case Item::Kind::repeat:
      fail(rule, "how much a repeat takes is not known here; give it a size");
    case Item::Kind::split:
      if (item.axis == Axis::across) {
        for (const Item& child : item.children) {
          Item along = child;
          along.size = {};  // its size is across
          if (along.kind == Item::Kind::piece && along.ref.kind == SymbolRef::Kind::symbol) continue;
          const Mixture density = own_density(rules, along, rule);
          if (!density.components.empty()) return density;
        }
        return {};
      }
      [[fallthrough]];
    case Item::Kind::merge:
      break;
  }
  std::vector<Mixture> parts;
  for (const Item& child : item.children) {
    parts.push_back(own_density(rules, child, rule));
    if (parts.back().components.empty())
      fail(rule, "a room of no stated width cannot be summed up with others; give it a width");
  }
  return side_by_side(parts, rules.inner_wall_m);
}

Affine share_of_rest(const RuleSet& rules, const std::vector<Item>& row, std::size_t index, int rule) {
  const Demand all = demand(rules, row, 0, row.size(), rule);
  const Demand before = demand(rules, row, 0, index, rule);
  const Demand now = demand(rules, row, index, row.size(), rule);
  // Clear length from here on, less walls: rest = left - walls. The scope's own, S, follows from it:
  // S = rest + absolute before + relative before * S + floating taken before.
  const double walls_m = rules.inner_wall_m * static_cast<double>(row.size() - index - 1);
  const double floated = all.floating > 0 ? before.floating / all.floating : 0;
  const double denominator = 1 - before.relative - floated * (1 - all.relative);
  if (denominator <= 1e-9) fail(rule, "the sizes before this one leave nothing of the scope");
  const Affine scope{(before.absolute_m - floated * all.absolute_m - walls_m) / denominator, 1 / denominator};
  const Size& size = row[index].size;
  if (size.kind == Size::Kind::relative) return {size.value * scope.constant, size.value * scope.slope};
  const double part = size.value / now.floating;
  return {part * (-walls_m - now.absolute_m - now.relative * scope.constant),
          part * (1 - now.relative * scope.slope)};
}

}  // namespace gramap
