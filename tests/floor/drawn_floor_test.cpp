#include "floor/drawn_floor.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "floor/building.h"
#include "floor/facade.h"
#include "floor/fitted_geojson.h"
#include "floor/verify.h"
#include "geometry/error.h"
#include "geometry/overlap.h"
#include "geometry/polygon.h"
#include "grammar/language.h"

using namespace gramap;

namespace {

RuleSet office_rules() {
  return *check_rules(
              "grammar offices;\nwall inner 0.1 m, outer 0.3 m;\nheight 2.7 m;\n"
              "room Office { width 2.8 m +- 10 cm; door 0.90 x 2.10 m at 0.15 m; "
              "windows 1.10 x 1.60 m sill 0.85 m every 1.35 m; furniture table, chair; }\n"
              "start Row;\noffices: Row -> repeat { Office };\n",
              "offices.grammar")
              .rules;
}

}  // namespace

TEST_CASE("a floor drawn from rules fills its spaces, has doors, and differs by seed alone") {
  const RuleSet rules = office_rules();
  const FloorGroundTruth floor = plain_floor(rules, {});
  const FittedFloor drawn = drawn_floor(floor, rules, 1);
  CHECK(drawn.rooms.size() > 12);
  CHECK(to_geojson(drawn) == to_geojson(drawn_floor(floor, rules, 1)));
  CHECK(to_geojson(drawn) != to_geojson(drawn_floor(floor, rules, 2)));
  for (const Space& space : floor.spaces) {
    double clear_m = 0;
    int rooms = 0;
    for (const FittedRoom& room : drawn.rooms)
      if (room.space == space.id) clear_m += room.width_m, ++rooms;
    CHECK(clear_m + (rooms - 1) * rules.inner_wall_m == doctest::Approx(24).epsilon(1e-9));
  }
  const Building building = building_of(truth_of(drawn));
  for (std::size_t i = 0; i < building.rooms.size(); ++i) {
    INFO(building.rooms[i].id);
    CHECK(!building.rooms[i].openings.empty());
    for (std::size_t j = 0; j < i; ++j)
      CHECK(shared_area(building.rooms[i].outline, building.rooms[j].outline) < 1e-6);
  }
}

TEST_CASE("every room of a unit can be entered, and has windows where the outside is") {
  const RuleSet rules =
      *check_rules(
           "grammar inn;\nwall inner 0.15 m, outer 0.3 m;\nroom Bed { door 0.90 x 2.10 m; "
           "windows 1.60 x 1.50 m sill 0.60 m every 2.40 m; }\n"
           "room Bath { windows 0.60 x 0.60 m sill 1.50 m every 1.00 m; }\nroom Hall { door 0.95 x 2.10 m; "
           "}\n"
           "start Row;\nrow: Row -> split x { 3.60 m +- 30 cm : Unit, ~ : Row };\n"
           "unit: Unit -> split y { 2.20 m : split x { 1.70 m : Bath, ~ : Hall }, ~ : Bed };\n",
           "inn")
           .rules;
  PlainFloorOptions options;
  options.depth_m = 6.5;
  const FittedFloor drawn = drawn_floor(plain_floor(rules, options), rules, 1);
  CHECK(verify(build_model(drawn)).warnings.empty());
  for (const FittedRoom& room : drawn.rooms) {
    INFO(room.id, " ", room.type);
    const auto count = [&](const std::string& kind) {
      return std::count_if(room.openings.begin(), room.openings.end(),
                           [&](const FittedOpening& opening) { return opening.kind == kind; });
    };
    CHECK(count("door") == (room.type == "Hall" ? 3 : 1));
    CHECK((count("window") > 0) == (room.type == "Bed"));
  }
}

TEST_CASE("a space has a façade where the outside or a courtyard lies behind it") {
  const RuleSet rules = office_rules();
  FloorGroundTruth floor = plain_floor(rules, {});
  REQUIRE(floor.spaces.size() == 2);
  for (const Space& space : floor.spaces) CHECK(has_facade(floor, rules.outer_wall_m, space));
  // The building goes on to the north; in it, a courtyard.
  for (Vec2& point : floor.outline)
    if (point.y() > 0) point.y() += 10;
  CHECK_FALSE(has_facade(floor, rules.outer_wall_m, floor.spaces[0]));
  CHECK(has_facade(floor, rules.outer_wall_m, floor.spaces[1]));
  floor.courtyards = {{{4, 7.4}, {12, 7.4}, {12, 12}, {4, 12}}};
  CHECK(has_facade(floor, rules.outer_wall_m, floor.spaces[0]));
  std::vector<SetAsideInput> set_aside;
  for (const SpaceProblem& problem : space_problems(floor, rules, {}, {}, set_aside)) CHECK(problem.facade);
}

TEST_CASE("a floor without spaces cannot be drawn") {
  CHECK_THROWS_AS(drawn_floor({}, office_rules(), 1), InputError);
}
