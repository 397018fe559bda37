// Short ways to write rule sets in tests.
#pragma once

#include <string>
#include <vector>

#include "grammar/rules.h"

namespace gramap::test {

inline RoomType room_type(const std::string& name, std::vector<Mixture::Component> width) {
  RoomType type;
  type.name = name;
  type.width.components = std::move(width);
  return type;
}

inline Item room(int type, Size size = {}) {
  Item item;
  item.ref = {SymbolRef::Kind::room, type};
  item.size = std::move(size);
  return item;
}

inline Item symbol(int index, Size size = {}) {
  Item item;
  item.ref = {SymbolRef::Kind::symbol, index};
  item.size = std::move(size);
  return item;
}

inline Item repeat(std::vector<Item> children, int least, int most) {
  Item item;
  item.kind = Item::Kind::repeat;
  item.children = std::move(children);
  item.least = least;
  item.most = most;
  return item;
}

inline Item split(Axis axis, std::vector<Item> children, Size size = {}) {
  Item item;
  item.kind = Item::Kind::split;
  item.axis = axis;
  item.children = std::move(children);
  item.size = std::move(size);
  return item;
}

inline Item merge(int type, std::vector<Item> children) {
  Item item;
  item.kind = Item::Kind::merge;
  item.ref = {SymbolRef::Kind::room, type};
  item.children = std::move(children);
  return item;
}

inline Size absolute(double mean_m, double sd_m) {
  Size size;
  size.kind = Size::Kind::absolute;
  size.width.components = {{1, {mean_m, sd_m}}};
  return size;
}

inline Size relative(double value) {
  Size size;
  size.kind = Size::Kind::relative;
  size.value = value;
  return size;
}

inline Size floating(double weight = 1) {
  Size size;
  size.kind = Size::Kind::floating;
  size.value = weight;
  return size;
}

inline Rule rule(const std::string& name, int symbol, std::vector<Item> body, double probability) {
  Rule rule;
  rule.name = name;
  rule.symbol = symbol;
  rule.body = std::move(body);
  rule.probability = probability;
  return rule;
}

/// Cells of 2.8 m, doubles of 5.8 m and a WC of 1.8 m, in any order: a floor's space as the institute has
/// them.
inline RuleSet office_rules() {
  RuleSet rules;
  rules.name = "office";
  rules.inner_wall_m = 0.2;
  rules.rooms = {room_type("Cell", {{1, {2.8, 0.05}}}), room_type("Double", {{1, {5.8, 0.05}}}),
                 room_type("WC", {{1, {1.8, 0.05}}})};
  rules.symbols = {"Space"};
  rules.rules = {rule("cells", 0, {repeat({room(0)}, 1, 4), symbol(0)}, 0.5),
                 rule("pair", 0, {room(1), symbol(0)}, 0.3), rule("wet", 0, {room(2), symbol(0)}, 0.2)};
  rules.background = {0.01, 1, 12};
  return rules;
}

}  // namespace gramap::test
