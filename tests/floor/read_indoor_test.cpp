#include "floor/read_indoor.h"

#include <doctest/doctest.h>

#include <cmath>

#include "floor/spaces.h"
#include "geometry/error.h"
#include "geometry/polygon.h"
#include "tests/floor/drawn_plan.h"
#include "tests/floor/temporary_file.h"

using namespace gramap;

namespace {

const test::DrawnPlan kPlan;

std::string corner(double x, double y) {
  return kPlan.position(x, y);
}
std::string box(double x0, double y0, double x1, double y1) {
  return kPlan.box(x0, y0, x1, y1);
}
std::string point(double x, double y) {
  return kPlan.point(x, y);
}
std::string feature(const std::string& properties, const std::string& geometry) {
  return test::DrawnPlan::feature(properties, geometry);
}
std::string collection(const std::string& features) {
  return test::DrawnPlan::collection(features);
}

/// A hallway of 12 x 2 m with three rooms above it and one below, a staircase at its end.
std::string osm_plan(const std::string& level) {
  const std::string on = R"(,"level":")" + level + "\"";
  return feature(R"("indoor":"corridor","ref":"F")" + on, box(0, 0, 12, 2)) + "," +
         feature(R"("indoor":"room","ref":"1")" + on, box(0, 2, 3, 7)) + "," +
         feature(R"("indoor":"room","ref":"2")" + on, box(3, 2, 9, 7)) + "," +
         feature(R"("indoor":"room","ref":"3","amenity":"toilets")" + on, box(9, 2, 12, 7)) + "," +
         feature(R"("indoor":"room","ref":"4")" + on, box(0, -4, 12, 0)) + "," +
         feature(R"("indoor":"room","stairs":"yes","ref":"T")" + on, box(12, 0, 15, 2)) + "," +
         feature(R"("door":"hinged")" + on, point(4, 2)) + "," +
         feature(R"("door":"hinged","width":"1.2")" + on, point(6, 0));
}

}  // namespace

TEST_CASE(
    "widths of doors are read as OpenStreetMap writes lengths; other text is no reason to refuse a plan") {
  const test::TemporaryFolder folder;
  const std::vector<std::pair<std::string, double>> widths{
      {"1.1 m", 1.1}, {"110 cm", 1.1}, {"3 ft", 0.9144}, {R"(2'11\")", 0.889},
      {"0.8m", 0.8},  {"wide", 0.9},   {"", 0.9},        {"-1", 0.9}};
  for (const auto& [text, width_m] : widths) {
    CAPTURE(text);
    const auto path = folder.write(
        "plan.geojson",
        collection(osm_plan("1") + "," +
                   feature(R"("door":"yes","level":"1","width":")" + text + "\"", point(1.5, 2))));
    const std::vector<IndoorFloor> floors = read_indoor(path);
    REQUIRE(floors.size() == 1);
    REQUIRE(floors[0].truth.openings.size() == 3);
    CHECK(floors[0].truth.openings[2].width_m == doctest::Approx(width_m));
  }
}

TEST_CASE("an OpenStreetMap plan becomes a floor with spaces, walls and doors, turned as it is") {
  const test::TemporaryFolder folder;
  const auto path = folder.write("plan.geojson", collection(osm_plan("1")));
  REQUIRE(is_indoor_plan(path));
  const std::vector<IndoorFloor> floors = read_indoor(path);
  REQUIRE(floors.size() == 1);
  const auto& [floor, truth] = floors[0];
  CHECK(floor.inner_wall_m == doctest::Approx(0.2));
  CHECK(floor.fixed.size() == 1);
  REQUIRE(floor.spaces.size() == 2);
  // Half a wall is split off at either end.
  CHECK((floor.spaces[0].end - floor.spaces[0].start).norm() == doctest::Approx(11.8).epsilon(0.001));
  const Vec2 along = (floor.spaces[0].end - floor.spaces[0].start).normalized();
  CHECK(std::atan2(along.y(), along.x()) == doctest::Approx(0.3).epsilon(0.001));
  CHECK(signed_area(floor.spaces[0].outline) == doctest::Approx(11.8 * 4.8).epsilon(0.001));
  REQUIRE(truth.rooms.size() == 4);
  CHECK(signed_area(truth.rooms[0].outline) == doctest::Approx(2.8 * 4.8).epsilon(0.001));
  CHECK(truth.rooms[2].type == "WC");
  REQUIRE(truth.openings.size() == 2);
  CHECK(truth.openings[0].room == "2");
  CHECK(truth.openings[0].width_m == doctest::Approx(0.9));
  CHECK(truth.openings[1].room == "4");
  CHECK(truth.openings[1].width_m == doctest::Approx(1.2));
  CHECK(read_floor(path).spaces.size() == 2);
}

TEST_CASE(
    "rooms of unequal depth, drawn askew: a space goes as deep as each of its rooms, and no two overlap") {
  // A hallway of 12 x 2 m; above it a deep room, a shallow one and a deep one; behind the shallow one, at a
  // hallway that leads upward, another room, whose corner was drawn 10 cm into the shallow one's wall.
  const test::TemporaryFolder folder;
  const auto path = folder.write(
      "plan.geojson", collection(feature(R"("indoor":"corridor","ref":"F")", box(0, 0, 12, 2)) + "," +
                                 feature(R"("indoor":"corridor","ref":"G")", box(12, 0, 14, 12)) + "," +
                                 feature(R"("indoor":"room","ref":"1")", box(0, 2, 4, 8)) + "," +
                                 feature(R"("indoor":"room","ref":"2")", box(4, 2, 8, 4.1)) + "," +
                                 feature(R"("indoor":"room","ref":"3")", box(8, 2, 12, 4)) + "," +
                                 feature(R"("indoor":"room","ref":"4")", box(3.9, 4, 12, 8)) + "," +
                                 feature(R"("indoor":"room","ref":"5")", box(4, 8, 12, 12))));
  const FloorGroundTruth floor = read_floor(path);
  REQUIRE(floor.spaces.size() == 2);
  CHECK_NOTHROW(check_floor(floor, path.string()));
  const double wall = *floor.inner_wall_m;
  const Space& row = floor.spaces[0].hallway == "F" ? floor.spaces[0] : floor.spaces[1];
  CHECK(row.hallway == "F");
  CHECK(signed_area(row.outline) == doctest::Approx(4 * 6 + 8 * 2 - wall * (12 + 6)).epsilon(0.02));
  const Space& other = &row == &floor.spaces[0] ? floor.spaces[1] : floor.spaces[0];
  CHECK(signed_area(other.outline) == doctest::Approx(8 * 8 - wall * 16).epsilon(0.03));
}

TEST_CASE("a plan of several levels: each by itself, one by its name, all together refused") {
  const test::TemporaryFolder folder;
  const auto path = folder.write("plan.geojson", collection(osm_plan("1;2") + "," + osm_plan("0")));
  CHECK(read_indoor(path).size() == 3);
  CHECK(read_floor(path.string() + "#2").name.ends_with("level 2"));
  CHECK_THROWS_AS(read_floor(path), InputError);
  CHECK_THROWS_AS(read_floor(path.string() + "#7"), InputError);
}

TEST_CASE("an IMDF folder becomes the same floor") {
  const auto unit = [](const std::string& id, const std::string& category, const std::string& geometry) {
    return R"({"type":"Feature","id":")" + id +
           R"(","feature_type":"unit","properties":{"level_id":"L","category":")" + category +
           R"(","name":{"en":"Room"}},)" + geometry + "}";
  };
  const test::TemporaryFolder folder;
  folder.write("unit.geojson", collection(unit("a", "walkway", box(0, 0, 12, 2)) + "," +
                                          unit("b", "office", box(0, 2.3, 5.9, 7)) + "," +
                                          unit("c", "restroom.male", box(6.1, 2.3, 12, 7)) + "," +
                                          unit("d", "opentobelow", box(0, -5, 12, -0.3)) + "," +
                                          unit("e", "elevator", box(12.3, 0, 14, 2))));
  folder.write(
      "level.geojson",
      collection(
          R"({"type":"Feature","id":"L","feature_type":"level","properties":{"ordinal":2},"geometry":null})"));
  folder.write(
      "opening.geojson",
      collection(R"({"type":"Feature","id":"o","feature_type":"opening","properties":{"level_id":"L"},)"
                 R"("geometry":{"type":"LineString","coordinates":[)" +
                 corner(1, 2.15) + "," + corner(2, 2.15) + "]}}"));
  REQUIRE(is_indoor_plan(folder.path()));
  const IndoorFloor indoor = only_level(folder.path());
  CHECK(indoor.floor.name.ends_with("level 2"));
  CHECK(indoor.floor.inner_wall_m ==
        doctest::Approx(0.2));  // as drawn, not assumed: the rooms stay as they are
  CHECK(signed_area(indoor.truth.rooms[0].outline) == doctest::Approx(5.9 * 4.7).epsilon(0.001));
  REQUIRE(indoor.floor.spaces.size() == 1);
  CHECK(indoor.truth.rooms.size() == 2);
  CHECK(indoor.truth.rooms[0].type == "Office");
  CHECK(indoor.truth.rooms[1].type == "WC");
  CHECK(indoor.floor.fixed[0].type == "Lift");
  REQUIRE(indoor.truth.openings.size() == 1);
  CHECK(indoor.truth.openings[0].width_m == doctest::Approx(1).epsilon(0.001));
}

TEST_CASE("a plan without a hallway is refused") {
  const test::TemporaryFolder folder;
  const auto path = folder.write("plan.geojson", collection(feature(R"("indoor":"room")", box(0, 0, 3, 3))));
  CHECK_THROWS_AS(read_indoor(path), InputError);
}
