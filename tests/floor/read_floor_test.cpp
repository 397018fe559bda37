#include <doctest/doctest.h>

#include <cmath>

#include "floor/ground_truth.h"
#include "floor/reference_line.h"
#include "floor/ring_check.h"
#include "geometry/error.h"
#include "geometry/polygon.h"
#include "tests/floor/temporary_file.h"

using namespace gramap;

namespace {

std::string feature(const std::string& properties, const std::string& type, const std::string& coordinates) {
  return R"({"type":"Feature","properties":{)" + properties + R"(},"geometry":{"type":")" + type +
         R"(","coordinates":)" + coordinates + "}}";
}

std::string collection(const std::string& features,
                       const std::string& members = R"("coordinate_units":"m",)") {
  return R"({"type":"FeatureCollection",)" + members + "\"features\":[\n" + features + "\n]}";
}

const std::string kHallway =
    feature(R"("kind":"hallway","id":"H")", "Polygon", "[[[0,0],[20,0],[20,2],[0,2],[0,0]]]");
const std::string kSpace = feature(R"("kind":"space","id":"S","hallway":"H")", "Polygon",
                                   "[[[0,2.2],[20,2.2],[20,6],[0,6],[0,2.2]]]");
const std::string kLine =
    feature(R"("kind":"reference_line","space":"S")", "LineString", "[[0,2.2],[20,2.2]]");

FloorGroundTruth read_text(const std::string& text) {
  const test::TemporaryFolder folder;
  return read_floor(folder.write("floor.geojson", text));
}

}  // namespace

TEST_CASE("a floor file is read: rings turned, closing points dropped, numbers as ids") {
  const FloorGroundTruth floor = read_text(
      collection(feature(R"("kind":"hallway","id":"H")", "Polygon", "[[[0,0],[0,2],[20,2],[20,0],[0,0]]]") +
                     "," + kSpace + "," + kLine + "," +
                     feature(R"("kind":"fixed","id":12,"type":"Stairs")", "MultiPolygon",
                             "[[[[30,0],[32,0],[32,2],[30,2],[30,0]]]]") +
                     "," + feature(R"("kind":"scan","room":"7","sigma":"0.6")", "Point", "[3,4,0]") + "," +
                     feature(R"("kind":"room","id":"7")", "Polygon", "[[[0,0],[1,0],[0,1],[0,0]]]"),
                 R"("coordinate_units":"m","name":"N","elevation":3,"walls":{"inner":0.2,"outer":0.3},)"));
  CHECK(floor.name == "N");
  CHECK(floor.elevation_m == 3);
  CHECK(floor.inner_wall_m == 0.2);
  CHECK(floor.outer_wall_m == 0.3);
  CHECK_FALSE(floor.ceiling_height_m.has_value());
  REQUIRE(floor.spaces.size() == 1);
  CHECK(signed_area(floor.hallways[0].outline) == doctest::Approx(40));
  CHECK(floor.spaces[0].outline.size() == 4);
  CHECK(signed_area(floor.spaces[0].outline) == doctest::Approx(76));
  CHECK(floor.spaces[0].start == Vec2(0, 2.2));
  REQUIRE(floor.fixed.size() == 1);
  CHECK(floor.fixed[0].id == "12");
  REQUIRE(floor.pins.size() == 1);
  CHECK(floor.pins[0].sigma_m == 0.6);
  CHECK(floor.remarks == std::vector<std::string>{"areas drawn clockwise, which were turned round: 1"});
}

TEST_CASE("a reference line with the space on its right is turned round, and that is said") {
  const FloorGroundTruth floor = read_text(collection(
      kHallway + "," + kSpace + "," +
      feature(R"("kind":"reference_line","space":"S")", "LineString", "[[20,2.2],[10,2.2],[0,2.2]]")));
  CHECK(floor.spaces[0].start == Vec2(0, 2.2));
  CHECK(floor.spaces[0].end == Vec2(20, 2.2));
  REQUIRE(floor.remarks.size() == 1);
  CHECK(floor.remarks[0].find("turned round") != std::string::npos);
}

TEST_CASE(
    "a space without reference line gets its edge beside the hallway, without hallway the nearest one") {
  const std::string lost =
      feature(R"("kind":"space","id":"S")", "Polygon", "[[[0,2.2],[0,6],[20,6],[20,2.2],[10,2.2],[0,2.2]]]");
  const FloorGroundTruth floor = read_text(collection(kHallway + "," + lost));
  CHECK(floor.spaces[0].hallway == "H");
  CHECK((floor.spaces[0].start - Vec2(0, 2.2)).norm() < 1e-9);
  CHECK((floor.spaces[0].end - Vec2(20, 2.2)).norm() < 1e-9);
}

TEST_CASE("a WGS84 floor is projected about its centre with the ellipsoid's radii") {
  // One thousandth of a degree at 51° north on WGS84: 111.25 m north, 70.19 m east.
  const FloorGroundTruth floor = read_text(
      collection(feature(R"("kind":"outline")", "Polygon",
                         "[[[13.7220,51.0250],[13.7230,51.0250],[13.7230,51.0260],[13.7220,51.0260],"
                         "[13.7220,51.0250]]]"),
                 ""));
  REQUIRE(floor.origin.has_value());
  CHECK(floor.origin->longitude_deg == doctest::Approx(13.7225));
  const Vec2 size = floor.outline[2] - floor.outline[0];
  CHECK(size.x() == doctest::Approx(70.15).epsilon(0.001));
  CHECK(size.y() == doctest::Approx(111.26).epsilon(0.001));
  CHECK(centroid(floor.outline).norm() < 1e-6);
  const Vec2 back = wgs84_from_plan(*floor.origin, floor.outline[0]);
  CHECK((back - Vec2(13.7220, 51.0250)).norm() < 1e-12);
}

TEST_CASE("faults of floor files are refused, each with its place and what was expected") {
  struct Case {
    std::string text, expected;
  };
  const std::string square = "[[[0,0],[4,0],[4,4],[0,4],[0,0]]]";
  const std::vector<Case> cases = {
      {"", "too early"},
      {"{\n  \"type\": FeatureCollection}", "not valid JSON"},
      {"[]", "not a GeoJSON FeatureCollection"},
      {R"({"type":"FeatureCollection","features":{}})", "not a GeoJSON FeatureCollection"},
      {collection("{}"), "no feature of it has a 'kind', an 'indoor' tag or a 'feature_type'"},
      {collection("7"), "feature 1: it is not an object"},
      {collection(feature(R"("kind":"halway","id":"H")", "Polygon", square)), "kind 'halway' is unknown"},
      {collection(feature(R"("kind":"hallway")", "Polygon", square)), "has no 'id'"},
      {collection(feature(R"("kind":"hallway","id":"H")", "Point", "[0,0]")), "needs a Polygon, not a Point"},
      {collection(feature(R"("kind":"hallway","id":"H")", "Polygon", "[[[0,0],[4,null],[4,4],[0,0]]]")),
       "a position is not a pair of numbers"},
      {collection(feature(R"("kind":"hallway","id":"H")", "Polygon", "[[[0,0],[4,0],[8,0],[0,0]]]")),
       "encloses no area"},
      {collection(feature(R"("kind":"hallway","id":"H")", "Polygon", "[[[0,0],[4,4],[4,0],[0,5],[0,0]]]")),
       "crosses or touches itself"},
      {collection(feature(R"("kind":"hallway","id":"H")", "Polygon",
                          "[[[0,0],[9,0],[9,9],[0,9],[0,0]],[[2,2],[3,2],[3,3],[2,2]]]")),
       "has a hole"},
      {collection(feature(R"("kind":"hallway","id":"H")", "MultiPolygon", "[" + square + "," + square + "]")),
       "has 2 parts"},
      {collection(feature(R"("kind":"hallway","id":"H")", "Blob", square)),
       "geometry type 'Blob' is unknown"},
      {collection(kHallway + "," + kHallway), "feature 2 (hallway 'H'): the id 'H' is used twice"},
      {collection(kHallway + "," + feature(R"("kind":"space","id":"S","hallway":"X")", "Polygon", square)),
       "names the hallway 'X'"},
      {collection(kSpace), "names the hallway 'H'"},
      {collection(kHallway + "," + kLine), "names the space 'S'"},
      {collection(kHallway + "," + kSpace + "," + kLine + "," + kLine), "second reference line"},
      {collection(kHallway + "," + kSpace + "," +
                  feature(R"("kind":"reference_line","space":"S")", "LineString", "[[0,3],[20,3]]")),
       "does not run along the border"},
      {collection(
           kHallway + "," +
           feature(R"("kind":"space","id":"S","hallway":"H")", "Polygon", "[[[0,9],[4,9],[4,12],[0,9]]]")),
       "no edge of it runs beside its hallway"},
      {collection(feature(R"("kind":"scan","room":"7","sigma":0)", "Point", "[3,4]")),
       "'sigma' is not positive"},
      {collection(feature(R"("kind":"scan","room":"7","sigma":"wide")", "Point", "[3,4]")),
       "'sigma' is not a number"},
      {collection(feature(R"("kind":"hallway","id":"H")", "Polygon",
                          "[[[13.7220,51.0250],[13.7230,51.0250],[13.7230,51.0260],[13.7220,51.0250]]]")),
       "look like degrees"},
      {collection(kHallway, R"("coordinate_units":"mm",)"), "coordinate_units 'mm' are not known"},
      {collection(kHallway, ""), "do not look like longitude and latitude"},
      {collection(kHallway, R"("coordinate_units":"m","walls":{"inner":-1},)"),
       "'walls.inner' must be more than 0"},
  };
  for (const Case& item : cases) {
    CAPTURE(item.text);
    try {
      read_text(item.text);
      FAIL("was not refused");
    } catch (const InputError& error) {
      CAPTURE(error.what());
      CHECK(std::string(error.what()).find(item.expected) != std::string::npos);
      CHECK(error.place.file.ends_with("floor.geojson"));
      CHECK_FALSE(error.advice.empty());
    }
  }
}

TEST_CASE("invalid JSON is reported with line and column") {
  try {
    read_text("{\n  \"type\": Feature}");
    FAIL("was not refused");
  } catch (const InputError& error) {
    CHECK(error.place.line == 2);
    CHECK(error.place.column == 11);
  }
}

TEST_CASE("a folder without floor.geojson is refused") {
  const test::TemporaryFolder folder;
  CHECK_THROWS_AS(read_floor(folder.path()), InputError);
}

TEST_CASE("a ring that touches itself or runs back is no simple polygon, whatever its orientation") {
  const Polygon good = {{0, 0}, {4, 0}, {4, 4}, {2, 2}, {0, 4}};
  CHECK_FALSE(ring_fault(good).has_value());
  CHECK_FALSE(ring_fault(Polygon(good.rbegin(), good.rend())).has_value());
  CHECK(ring_fault({{0, 0}, {4, 0}, {4, 4}, {2, 0}, {0, 4}}).has_value());          // touches an edge
  CHECK(ring_fault({{0, 0}, {4, 0}, {4, 4}, {4, 6}, {4, 4}, {0, 4}}).has_value());  // a spike
  CHECK(ring_fault({{0, 0}, {2, 2}, {4, 0}, {4, 4}, {2, 2}, {0, 4}}).has_value());  // a shared corner
  CHECK(without_repeats({{0, 0}, {0, 0}, {1, 0}, {1, 1}, {0, 0}}).size() == 3);
}
