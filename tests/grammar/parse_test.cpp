// Every construct of the language becomes the rule set that it means.
#include <doctest/doctest.h>

#include "grammar/language.h"

namespace gramap {
namespace {

RuleSet read(const std::string& text) {
  const CheckedRules checked = check_rules(text, "t");
  if (!checked.diagnostics.empty()) MESSAGE(render(checked.diagnostics, text, "t"));
  REQUIRE(checked.rules.has_value());
  return *checked.rules;
}

/// A file with two rooms, `extra` statements and one rule.
RuleSet with_rule(const std::string& rule, const std::string& extra = "") {
  return read(
      "grammar t; let axis = 3 m; room A { width axis - 20 cm; depth 4 m; } room B { width 2*axis; depth 3 "
      "m; } "
      "start S; both: S -> A B : 1;\n" +
      rule + "\n" + extra);
}
const std::vector<Item>& body(const RuleSet& rules) {
  return rules.rules[1].body;
}

TEST_CASE("quantities: units, constants, arithmetic, either spelling of the signs") {
  const RuleSet rules = read(
      "grammar t;\nlet axis = 3.00;\nlet gap = (axis / 10 - 100 mm) / 2;\nwall inner 10 cm, outer axis / "
      "10;\n"
      "height 2700 mm;\nroom A { width 2 * axis − gap ± 5 cm; }\nroom B { width -(-3 m) / 2 * 2 +- 0.5 "
      "%*axis; }\n"
      "start S;\nr: S → A B;\n");
  CHECK(rules.name == "t");
  CHECK(rules.inner_wall_m == doctest::Approx(0.10));
  CHECK(rules.outer_wall_m == doctest::Approx(0.30));
  CHECK(rules.height_m == doctest::Approx(2.70));
  REQUIRE(rules.rooms[0].width.components.size() == 1);
  CHECK(rules.rooms[0].width.components[0].normal.mean_m == doctest::Approx(5.9));
  CHECK(rules.rooms[0].width.components[0].normal.sd_m == doctest::Approx(0.05));
  CHECK(rules.rooms[1].width.components[0].normal.mean_m == doctest::Approx(3));
  CHECK(rules.rooms[1].width.components[0].normal.sd_m == doctest::Approx(0.015));
}

TEST_CASE("a room: mixture widths, depth, door, windows, furniture") {
  const RuleSet rules = read(
      "grammar t;\nroom Office {\n  width 2.80 m +- 5 cm : 3 or 5.80 m : 1;\n  depth 4.40 m +- 10 cm;\n"
      "  door 1.00 x 2.10 m at 0.85 m +- 3 cm : 80 % or 0.10 m from end : 20 %;\n"
      "  windows 1.00 x 1.50 m sill 0.90 m every 1.40 m;\n  windows 0.60 × 0.60 m sill 1.80 m every 3 m;\n"
      "  furniture 2 table, chair;\n}\nstart S;\nr: S -> Office S;\n");
  const RoomType& room = rules.rooms[0];
  REQUIRE(room.width.components.size() == 2);
  CHECK(room.width.components[0].weight == doctest::Approx(0.75));
  CHECK(room.width.components[1].normal.mean_m == doctest::Approx(5.8));
  CHECK(room.width.components[1].normal.sd_m == 0);
  CHECK(room.depth->mean_m == doctest::Approx(4.4));
  REQUIRE(room.door.has_value());
  CHECK(room.door->height_m == doctest::Approx(2.1));
  REQUIRE(room.door->places.size() == 2);
  CHECK(room.door->places[0].weight == doctest::Approx(0.8));
  CHECK_FALSE(room.door->places[0].from_end);
  CHECK(room.door->places[1].from_end);
  CHECK(room.door->places[1].offset.mean_m == doctest::Approx(0.1));
  REQUIRE(room.windows.size() == 2);
  CHECK(room.windows[0].sill_m == doctest::Approx(0.9));
  CHECK(room.windows[1].spacing_m == doctest::Approx(3));
  CHECK(room.furniture == std::vector<std::string>{"table", "table", "chair"});
}

TEST_CASE("a row of rooms and symbols; its probability") {
  const RuleSet rules = with_rule("r: S -> A S : 30 %;");
  REQUIRE(body(rules).size() == 2);
  CHECK(body(rules)[0].kind == Item::Kind::piece);
  CHECK(body(rules)[0].ref.kind == SymbolRef::Kind::room);
  CHECK(body(rules)[1].ref.kind == SymbolRef::Kind::symbol);
  CHECK(rules.rules[1].probability == doctest::Approx(0.3));
  CHECK(rules.symbols == std::vector<std::string>{"S"});
}

TEST_CASE("single split: absolute size and the rest") {
  const RuleSet rules = with_rule("r: S -> split x { axis - 10 cm +- 2 cm : A, ~ : S };");
  REQUIRE(body(rules).size() == 2);
  CHECK(body(rules)[0].size.kind == Size::Kind::absolute);
  CHECK(body(rules)[0].size.width.components[0].normal.mean_m == doctest::Approx(2.9));
  CHECK(body(rules)[1].size.kind == Size::Kind::own);  // what is left goes to the last symbol anyway
}

TEST_CASE("relative and floating sizes") {
  const RuleSet rules = with_rule("r: S -> split x { 25 % : A, ~2 : B, ~ : A };");
  REQUIRE(body(rules).size() == 3);
  CHECK(body(rules)[0].size.kind == Size::Kind::relative);
  CHECK(body(rules)[0].size.value == doctest::Approx(0.25));
  CHECK(body(rules)[1].size.kind == Size::Kind::floating);
  CHECK(body(rules)[1].size.value == 2);
  CHECK(body(rules)[2].size.value == 1);
}

TEST_CASE("repeat split: bounds") {
  const auto bounds = [](const std::string& text) {
    const RuleSet rules = with_rule("r: S -> repeat " + text + " { A, B } S;");
    const Item& item = body(rules)[0];
    CHECK(item.kind == Item::Kind::repeat);
    CHECK(item.children.size() == 2);
    return std::pair(item.least, item.most);
  };
  CHECK(bounds("") == std::pair(1, -1));
  CHECK(bounds("3") == std::pair(3, 3));
  CHECK(bounds("1..8") == std::pair(1, 8));
  CHECK(bounds("2..") == std::pair(2, -1));
}

TEST_CASE("string split is part of its row") {
  CHECK(body(with_rule("r: S -> string { A, B } S;")).size() == 3);
}

TEST_CASE("multi split: nested, both directions") {
  const RuleSet rules =
      with_rule("r: S -> split x { 4 m : split y { 1.5 m : split x { ~ : A, 1 m : B }, ~ : B }, ~ : S };");
  const Item& unit = body(rules)[0];
  CHECK(unit.kind == Item::Kind::split);
  CHECK(unit.axis == Axis::across);
  REQUIRE(unit.children.size() == 2);
  CHECK(unit.children[0].kind == Item::Kind::split);
  CHECK(unit.children[0].axis == Axis::along);
  CHECK(unit.children[0].size.width.components[0].normal.mean_m == doctest::Approx(1.5));
  CHECK(unit.children[0].children[0].size.kind == Size::Kind::floating);
  CHECK(unit.children[1].ref.index == 1);
}

TEST_CASE("merge") {
  const RuleSet rules = with_rule("r: S -> merge { A, A } as B;");
  CHECK(body(rules)[0].kind == Item::Kind::merge);
  CHECK(body(rules)[0].children.size() == 2);
  CHECK(body(rules)[0].ref.index == 1);
}

TEST_CASE("contexts: rooms and the ends of the space") {
  const RuleSet rules = with_rule("r: | < S > B -> A S;\nq: A < S > | -> A;");
  CHECK(rules.rules[1].left->kind == SymbolRef::Kind::end);
  CHECK(rules.rules[1].right->kind == SymbolRef::Kind::room);
  CHECK(rules.rules[1].right->index == 1);
  CHECK(rules.rules[2].left->index == 0);
  CHECK(rules.rules[2].right->kind == SymbolRef::Kind::end);
  CHECK_FALSE(rules.rules[0].left.has_value());
}

TEST_CASE("conditions become trees, leaves first") {
  const RuleSet rules =
      with_rule("r: S : length > 2*axis and not (hallway == \"west\" or depth <= 4 m) and facade -> A S;");
  const auto& nodes = rules.rules[1].condition.nodes;
  REQUIRE(!nodes.empty());
  CHECK(nodes.back().op == Condition::Op::land);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    CHECK(nodes[i].left < static_cast<int>(i));
    CHECK(nodes[i].right < static_cast<int>(i));
  }
  CHECK(nodes[0].attribute == Condition::Attribute::length);
  CHECK(nodes[1].number == doctest::Approx(6));
  CHECK(nodes[2].op == Condition::Op::greater);
  CHECK(rules.rules[0].condition.nodes.empty());
}

TEST_CASE("after: context-aware probabilities") {
  const RuleSet rules = with_rule("r: S -> A S;\nq: S -> B S;", "after r { q 0.7, others 30 % }");
  REQUIRE(rules.rules[1].after.has_value());
  CHECK(rules.rules[1].after->named == std::vector<std::pair<int, double>>{{2, 0.7}});
  CHECK(rules.rules[1].after->others == doctest::Approx(0.3));
  CHECK_FALSE(rules.rules[2].after.has_value());
}

TEST_CASE("background") {
  const RuleSet rules = with_rule("r: S -> A S;", "background 2 % width 1 m .. 1200 cm;");
  CHECK(rules.background.probability == doctest::Approx(0.02));
  CHECK(rules.background.least_m == doctest::Approx(1));
  CHECK(rules.background.most_m == doctest::Approx(12));
}

TEST_CASE("words of one statement are not reserved from units, axes and names that contain them") {
  const RuleSet rules = read(
      "grammar roomy;\nroom m { width 3 m; }\nroom x { width 2 m; }\nroom rooms { width 1 m; }\n"
      "start s;\nr: s -> m x rooms s;\n");
  CHECK(rules.rooms.size() == 3);
}

}  // namespace
}  // namespace gramap
