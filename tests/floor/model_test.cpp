#include "floor/model.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <set>
#include <string>

#include "floor/floor_of_truth.h"
#include "floor/gltf.h"
#include "floor/verify.h"
#include "geometry/error.h"
#include "geometry/file.h"
#include "geometry/polygon.h"
#include "tests/floor/saved_model.h"
#include "tests/support/rectangle.h"

using namespace gramap;
using test::rectangle;
using test::saved;

namespace {

/// A hallway, stairs at its end, three rooms.
FittedFloor small_floor() {
  FloorGroundTruth floor;
  floor.name = "Testhaus, Ebene 1";
  floor.elevation_m = 3;
  floor.ceiling_height_m = 2.6;
  floor.inner_wall_m = 0.2;
  floor.outer_wall_m = 0.3;
  floor.outline = rectangle(0, 0, 12, 10.6);
  floor.hallways = {{"F1", "Flur", rectangle(0.3, 4.3, 8.3, 6.3)}};
  floor.fixed = {{"T", "Stairs", "Treppe", rectangle(8.5, 0.3, 11.7, 10.3)}};
  FloorTruth truth;
  truth.rooms = {{"101", "Office", "Büro", rectangle(0.3, 6.5, 4.2, 10.3), 3, 5.6},
                 {"102", "Office", "", rectangle(4.4, 6.5, 8.3, 10.3), 3, 5.5},
                 {"103", "Lab", "", rectangle(0.3, 0.3, 8.3, 4.1), 3, 5.6}};
  return floor_of_truth(floor, truth);
}

}  // namespace

TEST_CASE("a small floor builds, is proved gap-free and exports") {
  const FloorModel model = build_model(small_floor());
  const VerifyReport report = verify(model);
  INFO(to_text(report));
  CHECK(report.ok());
  CHECK(report.totals.area_exact);
  CHECK(report.totals.rooms == 3);
  CHECK(report.totals.hallways == 1);
  CHECK(report.totals.fixed == 1);
  CHECK(report.totals.rooms_m2 == doctest::Approx(3.9 * 3.8 * 2 + 8 * 3.8));
  CHECK(report.totals.rooms_m2 + report.totals.hallways_m2 + report.totals.fixed_m2 +
            report.totals.walls_m2 ==
        doctest::Approx(12 * 10.6));

  RunInfo run;
  run.version = "test";
  run.rule_file = "a.grammar";
  run.seed = 7;
  run.options = {{"scans", "scans"}};
  run.input_hashes = {{"floor.geojson", "0123456789abcdef"}};
  const std::string glb = to_glb(model, run);
  CHECK(glb == to_glb(build_model(small_floor()), run));  // the same bytes
  saved("small_floor.glb", glb);
  saved("small_floor.gltf", to_gltf({model}, run));
}

TEST_CASE("node names are plain, unique and speaking") {
  const FloorModel model = build_model(small_floor());
  std::set<std::string> names;
  for (const ModelRoom& room : model.rooms) CHECK(names.insert(room.node).second);
  for (const ModelWall& wall : model.walls) CHECK(names.insert(wall.node).second);
  for (const std::string& name : names)
    CHECK(name.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-") ==
          std::string::npos);
  CHECK(names.count("room_101"));
  CHECK(names.count("hallway_F1"));
  CHECK(names.count("wall_101_102"));
  CHECK(names.count("wall_F1_T"));
}

TEST_CASE("a floor without an outline gets one around its rooms") {
  FittedFloor fitted = small_floor();
  fitted.floor.outline.clear();
  const FloorModel model = build_model(fitted);
  const VerifyReport report = verify(model);
  CHECK(report.ok());
  REQUIRE(model.outline.size() == 1);
  CHECK(signed_area(model.outline[0]) == doctest::Approx(12 * 10.6));
}

TEST_CASE("a floor far from its origin keeps its precision") {
  FittedFloor fitted = small_floor();
  const auto move = [](Polygon& ring) {
    for (Vec2& p : ring) p += Vec2(690000, 5330000);
  };
  move(fitted.floor.outline);
  for (auto* rooms : {&fitted.rooms, &fitted.hallways, &fitted.fixed})
    for (FittedRoom& room : *rooms) move(room.outline);
  const FloorModel model = build_model(fitted);
  CHECK(verify(model).ok());
  saved("far_away.glb", to_glb(model, {}));
}

TEST_CASE("what cannot be built is refused with names and a place") {
  FittedFloor fitted = small_floor();
  const auto message = [&fitted] {
    try {
      build_model(fitted);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("built");
  };
  SUBCASE("overlap") {
    fitted.rooms[0].outline = rectangle(0.3, 6.5, 4.6, 10.3);
    CHECK(message().find("room '101' and room '102' overlap by 0.76 m² at (4.") == 0);
  }
  SUBCASE("beyond the outline") {
    fitted.hallways[0].outline = rectangle(-2, 4.3, 8.3, 6.3);
    CHECK(message().find("hallway 'F1' reaches 4 m² out of the floor's outline") == 0);
  }
  SUBCASE("touching the outline") {
    fitted.hallways[0].outline = rectangle(0, 4.3, 8.3, 6.3);
    CHECK(message().find("hallway 'F1' touches the floor's outline at (0.00, ") == 0);
  }
  SUBCASE("a courtyard elsewhere") {
    fitted.floor.courtyards = {rectangle(20, 20, 22, 22)};
    CHECK(message().find("the floor's outline and its courtyards cross one another at (2") == 0);
  }
  SUBCASE("one id twice") {
    fitted.rooms[1].id = "101";
    CHECK(message() == "two rooms have the id '101'");
  }
  SUBCASE("no area") {
    fitted.rooms[1].outline = {{4.4, 6.5}, {8.3, 6.5}, {8.3, 6.5}};
    CHECK(message() == "room '102' has no area");
  }
}
