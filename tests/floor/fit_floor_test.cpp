#include "floor/fit_floor.h"

#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include "geometry/polygon.h"

using namespace gramap;

namespace {

/// Rooms of 3 m and 5 m in any order along one side of a hallway.
RuleSet two_types() {
  RuleSet rules;
  rules.inner_wall_m = 0.2;
  rules.symbols = {"Row"};
  for (const auto& [name, width] : {std::pair{"Small", 3.0}, std::pair{"Large", 5.0}}) {
    RoomType type;
    type.name = name;
    type.width.components = {{1, {width, 0.05}}};
    rules.rooms.push_back(type);
    Rule rule;
    rule.name = std::string("take_") + name;
    Item room, rest;
    room.ref = {SymbolRef::Kind::room, static_cast<int>(rules.rooms.size()) - 1};
    rest.ref = {SymbolRef::Kind::symbol, 0};
    rule.body = {room, rest};
    rules.rules.push_back(rule);
  }
  return rules;
}

FloorGroundTruth one_space(double length) {
  FloorGroundTruth floor;
  floor.inner_wall_m = 0.2;
  floor.spaces.push_back({"s", "h", {{0, 0}, {length, 0}, {length, 4}, {0, 4}}, {0, 0}, {length, 0}});
  return floor;
}

RoomEvidence scanned(const std::string& id, double width, double centre) {
  RoomEvidence evidence;
  evidence.id = id;
  evidence.width_m = width;
  evidence.width_sigma_m = 0.01;
  evidence.centre_m = centre;
  evidence.centre_sigma_m = 0.2;
  return evidence;
}

}  // namespace

TEST_CASE("slabs of a space share their cuts and add up to it") {
  const Space space{"s", "h", {{0, 0}, {20, 0}, {20, 4.8}, {0, 4.8}}, {20, 4.8}, {0, 4.8}};
  const Polygon first = slab(space, 0, 7), wall = slab(space, 7, 7.2), second = slab(space, 7.2, 20);
  CHECK(signed_area(first) + signed_area(wall) + signed_area(second) ==
        doctest::Approx(signed_area(space.outline)));
  CHECK(contains(first, {19, 1}));
  CHECK(contains(second, {1, 1}));
}

TEST_CASE("rooms that nobody scanned are derived, and the widths fill the space exactly") {
  const double length = 3.02 + 0.2 + 5.01 + 0.2 + 3.0;
  const FloorGroundTruth floor = one_space(length);
  SpaceProblem problem;
  problem.id = "s";
  problem.length_m = length;
  problem.depth_m = 4;
  problem.rooms = {scanned("a", 3.02, 1.5), scanned("b", 5.01, 5.7)};
  const FittedFloor fitted = fit_floor(floor, two_types(), {problem}, {});
  REQUIRE(fitted.rooms.size() == 3);
  CHECK(fitted.rooms[0].id == "a");
  CHECK(fitted.rooms[1].type == "Large");
  CHECK(fitted.rooms[2].origin == Origin::derived);
  CHECK(fitted.rooms[2].id == "s_3");
  CHECK(fitted.rooms[2].width_m == doctest::Approx(3.0).epsilon(0.01));
  CHECK(fitted.rooms[0].width_m + fitted.rooms[1].width_m + fitted.rooms[2].width_m + 0.4 ==
        doctest::Approx(length).epsilon(1e-12));
  CHECK(fitted.rooms[2].width_sigma_m > 0.5 * fitted.rooms[0].width_sigma_m);
  CHECK(fitted.rooms[2].outline.size() == 4);
}

TEST_CASE("scans of a whole row that do not add up to it by a hand are taken all the same") {
  RuleSet rules = two_types();
  for (RoomType& type : rules.rooms) type.width.components[0].normal.sd_m = 0.4;
  const std::vector<double> widths = {3.1, 4.8, 2.7, 3.3, 5.1, 2.9, 3.2, 5.3};
  SpaceProblem problem;
  problem.id = "s";
  problem.depth_m = 4;
  double start = 0;
  for (const double width : widths) {
    // Each room was drawn askew: its scan is 3 cm narrower than the room at its door.
    RoomEvidence evidence =
        scanned("r" + std::to_string(problem.rooms.size()), width - 0.03, start + width / 2);
    evidence.width_sigma_m = 0.005;
    evidence.centre_sigma_m = 0.1;
    problem.rooms.push_back(evidence);
    start += width + 0.2;
  }
  problem.length_m = start - 0.2;
  const FittedFloor fitted = fit_floor(one_space(problem.length_m), rules, {problem}, {});
  CHECK(fitted.set_aside.empty());
  CHECK(fitted.floor.remarks.empty());
  REQUIRE(fitted.rooms.size() == widths.size());
  for (std::size_t i = 0; i < widths.size(); ++i) CHECK(std::abs(fitted.rooms[i].width_m - widths[i]) < 0.03);
}

TEST_CASE("a floor turned, mirrored in its line's direction or shifted far away gives the same layout") {
  const double length = 11.4;
  SpaceProblem problem;
  problem.id = "s";
  problem.length_m = length;
  problem.depth_m = 4;
  problem.rooms = {scanned("a", 5.0, 2.5)};
  const FittedFloor straight = fit_floor(one_space(length), two_types(), {problem}, {});
  FloorGroundTruth turned = one_space(length);
  const double c = std::cos(0.7), s = std::sin(0.7);
  const auto moved = [&](const Vec2& p) {
    return Vec2(1e4 + c * p.x() - s * p.y(), -2e4 + s * p.x() + c * p.y());
  };
  for (Vec2& point : turned.spaces[0].outline) point = moved(point);
  turned.spaces[0].start = moved(turned.spaces[0].start), turned.spaces[0].end = moved(turned.spaces[0].end);
  const FittedFloor other = fit_floor(turned, two_types(), {problem}, {});
  REQUIRE(other.rooms.size() == straight.rooms.size());
  for (std::size_t i = 0; i < other.rooms.size(); ++i) {
    CHECK(other.rooms[i].type == straight.rooms[i].type);
    CHECK(other.rooms[i].width_m == doctest::Approx(straight.rooms[i].width_m).epsilon(1e-9));
    CHECK(std::abs(signed_area(other.rooms[i].outline)) ==
          doctest::Approx(std::abs(signed_area(straight.rooms[i].outline))).epsilon(1e-6));
  }
}
