#include "floor/spaces.h"

#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "geometry/error.h"
#include "geometry/polygon.h"
#include "tests/support/rectangle.h"

using namespace gramap;
using test::rectangle;

namespace {

FloorGroundTruth floor_with(Polygon outline, std::vector<Polygon> hallways, std::vector<Polygon> fixed = {}) {
  FloorGroundTruth floor;
  floor.outline = std::move(outline);
  int number = 0;
  for (Polygon& ring : hallways)
    floor.hallways.push_back({"H" + std::to_string(++number), "", std::move(ring)});
  for (Polygon& ring : fixed)
    floor.fixed.push_back({"F" + std::to_string(++number), "Stairs", "", std::move(ring)});
  return floor;
}

double area_of_spaces(const FloorGroundTruth& floor) {
  double area = 0;
  for (const Space& space : floor.spaces) area += signed_area(space.outline);
  return area;
}

/// Spaces are counter-clockwise, on the left of their lines, and the floor with them is without
/// contradiction.
void check_spaces(const FloorGroundTruth& floor) {
  for (const Space& space : floor.spaces) {
    CAPTURE(space.id);
    CHECK(signed_area(space.outline) > 0);
    const Vec2 along = space.end - space.start, to = centroid(space.outline) - space.start;
    CHECK(along.x() * to.y() - along.y() * to.x() > 0);
  }
  CHECK_NOTHROW(check_floor(floor, "floor.geojson"));
}

std::string refusal(const FloorGroundTruth& floor) {
  try {
    check_floor(floor, "floor.geojson");
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace

TEST_CASE("a straight hallway from wall to wall has a space on both sides") {
  FloorGroundTruth floor = floor_with(rectangle(0, 0, 20, 12), {rectangle(0.3, 5, 19.7, 7)});
  const auto said = derive_spaces(floor, 0.2, 0.3);
  CHECK(said.size() == 2);
  REQUIRE(floor.spaces.size() == 2);
  CHECK(area_of_spaces(floor) == doctest::Approx(19.4 * (4.8 - 0.3) * 2).epsilon(1e-3));
  for (const Space& space : floor.spaces) CHECK(space.hallway == "H1");
  check_spaces(floor);
}

TEST_CASE("inside the corner of an L each wing is served from its own hallway") {
  // Two wings of 12 m breadth; the hallway runs along their middles.
  const Polygon outline = {{0, 0}, {40, 0}, {40, 40}, {28, 40}, {28, 12}, {0, 12}};
  const Polygon hallway = {{0.3, 5}, {35, 5}, {35, 39.7}, {33, 39.7}, {33, 7}, {0.3, 7}};
  FloorGroundTruth floor = floor_with(outline, {hallway});
  derive_spaces(floor, 0.2, 0.3);
  check_spaces(floor);
  for (const Space& space : floor.spaces) {
    CAPTURE(space.id);
    const double length = (space.end - space.start).norm();
    CHECK(signed_area(space.outline) / length < 8);
  }
}

TEST_CASE("a dead end: one side takes the corner behind the hallway's end, and it is said") {
  FloorGroundTruth floor = floor_with(rectangle(0, 0, 20, 12), {rectangle(0.3, 5, 14, 7)});
  const auto said = derive_spaces(floor, 0.2, 0.3);
  check_spaces(floor);
  bool corner = false;
  for (const std::string& sentence : said)
    corner = corner || sentence.find("takes the corner") != std::string::npos;
  CHECK(corner);
  // Both sides to the outer wall, and what lies straight behind the end.
  CHECK(area_of_spaces(floor) > 19.4 * 4.5 * 2);
  CHECK(floor.spaces.size() == 3);
}

TEST_CASE("stairs between two hallways: the side that passes them is one space") {
  FloorGroundTruth floor =
      floor_with(rectangle(0, 2, 42, 16), {rectangle(0.3, 7, 18, 9), rectangle(24, 7, 41.7, 9)},
                 {rectangle(18.3, 7, 23.7, 15.7)});
  derive_spaces(floor, 0.2, 0.3);
  check_spaces(floor);
  REQUIRE(floor.spaces.size() == 3);
  double longest = 0;
  for (const Space& space : floor.spaces) longest = std::max(longest, (space.end - space.start).norm());
  CHECK(longest == doctest::Approx(41.4).epsilon(1e-3));
}

TEST_CASE("an L, a T, a ring around a core, a ring around a courtyard") {
  FloorGroundTruth floor;
  SUBCASE("L") {
    floor = floor_with({{0, 0}, {30, 0}, {30, 12}, {12, 12}, {12, 30}, {0, 30}},
                       {{{5, 5}, {29.7, 5}, {29.7, 7}, {7, 7}, {7, 29.7}, {5, 29.7}}});
    CHECK(derive_spaces(floor, 0.2, 0.3).size() >= 4);
  }
  SUBCASE("T") {
    floor = floor_with(
        rectangle(0, 0, 30, 20),
        {{{0.3, 14}, {14, 14}, {14, 0.3}, {16, 0.3}, {16, 14}, {29.7, 14}, {29.7, 16}, {0.3, 16}}});
    CHECK(derive_spaces(floor, 0.2, 0.3).size() >= 3);
  }
  SUBCASE("ring around a core: its four straights") {
    floor = floor_with(rectangle(0, 0, 30, 30), {rectangle(5, 5, 25, 7), rectangle(5, 23, 25, 25),
                                                 rectangle(5, 7, 7, 23), rectangle(23, 7, 25, 23)});
    CHECK(derive_spaces(floor, 0.2, 0.3).size() >= 6);
  }
  SUBCASE("ring around a courtyard") {
    floor = floor_with(rectangle(0, 0, 30, 30), {rectangle(5, 5, 25, 7), rectangle(5, 23, 25, 25),
                                                 rectangle(5, 7, 7, 23), rectangle(23, 7, 25, 23)});
    floor.courtyards = {rectangle(12, 12, 18, 18)};
    CHECK(derive_spaces(floor, 0.2, 0.3).size() >= 6);
    for (const Space& space : floor.spaces) CHECK_FALSE(contains(space.outline, Vec2(15, 15)));
  }
  check_spaces(floor);
}

TEST_CASE("turned by any angle the spaces are the same") {
  const auto build = [](double angle) {
    FloorGroundTruth floor = floor_with(rectangle(0, 0, 20, 12), {rectangle(0.3, 5, 14, 7)});
    const auto turn = [angle](Polygon& ring) {
      for (Vec2& p : ring)
        p = Vec2(std::cos(angle) * p.x() - std::sin(angle) * p.y(),
                 std::sin(angle) * p.x() + std::cos(angle) * p.y());
    };
    turn(floor.outline);
    turn(floor.hallways[0].outline);
    derive_spaces(floor, 0.2, 0.3);
    check_spaces(floor);
    return floor;
  };
  const FloorGroundTruth straight = build(0), turned = build(0.7);
  REQUIRE(turned.spaces.size() == straight.spaces.size());
  for (std::size_t i = 0; i < straight.spaces.size(); ++i)
    CHECK(signed_area(turned.spaces[i].outline) ==
          doctest::Approx(signed_area(straight.spaces[i].outline)).epsilon(1e-6));
}

TEST_CASE("without outline, without hallways, without room for rooms: refused") {
  FloorGroundTruth floor = floor_with({}, {rectangle(0, 0, 10, 2)});
  CHECK_THROWS_AS(derive_spaces(floor, 0.2, 0.3), InputError);
  floor = floor_with(rectangle(0, 0, 10, 10), {});
  CHECK_THROWS_AS(derive_spaces(floor, 0.2, 0.3), InputError);
  floor = floor_with(rectangle(0, 0, 10, 2.8), {rectangle(0.3, 0.3, 9.7, 2.5)});
  CHECK_THROWS_AS(derive_spaces(floor, 0.2, 0.3), InputError);
}

TEST_CASE("contradictions of a floor file are named before any fit") {
  FloorGroundTruth floor =
      floor_with(rectangle(0, 0, 20, 12), {rectangle(0.3, 5, 19.7, 7)}, {rectangle(15, 7.2, 19.7, 11.7)});
  CHECK(refusal(floor) == "accepted");
  SUBCASE("hallway at the outline") {
    floor.hallways[0].outline = rectangle(0, 5, 19.7, 7);
    CHECK(refusal(floor).find("hallway 'H1' touches the floor's outline") == 0);
  }
  SUBCASE("stairs in the hallway") {
    floor.fixed[0].outline = rectangle(15, 6, 19.7, 11.7);
    CHECK(refusal(floor).find("hallway 'H1' and fixed room 'F2' overlap by 4.7 m²") == 0);
  }
  SUBCASE("a space beyond the outline") {
    floor.spaces = {{"S", "H1", rectangle(0.3, 0.3, 22, 4.8), {22, 4.8}, {0.3, 4.8}}};
    CHECK(refusal(floor).find("space 'S' reaches 9 m² out of the floor's outline") == 0);
  }
  SUBCASE("a reference line of no length") {
    floor.spaces = {{"S", "H1", rectangle(0.3, 0.3, 19.7, 4.8), {5, 4.8}, {5, 4.8}}};
    CHECK(refusal(floor) == "the reference line of space 'S' has no length");
  }
}
