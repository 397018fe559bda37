#include "floor/drawn_floor.h"

#include <doctest/doctest.h>

#include "floor/building.h"
#include "floor/fitted_geojson.h"
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

TEST_CASE("a floor without spaces cannot be drawn") {
  CHECK_THROWS_AS(drawn_floor({}, office_rules(), 1), InputError);
}
