#include <doctest/doctest.h>

#include "floor/building.h"
#include "floor/ground_truth.h"
#include "geometry/error.h"
#include "geometry/polygon.h"
#include "tests/floor/temporary_file.h"

using namespace gramap;

namespace {

FloorGroundTruth sample_floor() {
  FloorGroundTruth floor;
  floor.name = "Ground \"floor\"";
  floor.elevation_m = -3;
  floor.inner_wall_m = 0.15;
  floor.origin = GeoOrigin{13.5, 51.25};
  floor.outline = {{0, 0}, {20, 0}, {20, 10}, {0, 10}};
  floor.hallways = {{"H", "Hall", {{0.3, 0.3}, {19.7, 0.3}, {19.7, 2}, {0.3, 2}}}};
  floor.fixed = {{"T", "Stairs", "", {{0.3, 2.2}, {3, 2.2}, {3, 9.7}, {0.3, 9.7}}}};
  floor.spaces = {{"S", "H", {{3.2, 2.2}, {19.7, 2.2}, {19.7, 9.7}, {3.2, 9.7}}, {3.2, 2.2}, {19.7, 2.2}}};
  floor.pins = {{"1", {5, 5}, 0.5}};
  return floor;
}

FloorTruth sample_truth() {
  FloorTruth truth;
  truth.rooms = {{"1", "Office", "A", {{3.2, 2.2}, {10, 2.2}, {10, 9.7}, {3.2, 9.7}}, -3, -0.3}};
  truth.openings = {{"door", "1", {5, 2.2}, {6, 2.2}, 1.0, 0, 2.1},
                    {"window", "1", {5, 9.7}, {4, 9.7}, 1, 0.9, 2.4}};
  truth.furniture = {{"1", "table", {{4, 4}, {5, 4}, {5, 5}, {4, 5}}, 0, 0.8}};
  return truth;
}

}  // namespace

TEST_CASE("what is written as GeoJSON is read back the same") {
  const test::TemporaryFolder folder;
  const std::string text = to_geojson(sample_floor(), sample_truth());
  const auto path = folder.write("both.geojson", text);
  const FloorGroundTruth floor = read_floor(path);
  const FloorTruth truth = read_truth(path);
  CHECK(floor.name == sample_floor().name);
  CHECK(floor.origin->latitude_deg == 51.25);
  CHECK(floor.spaces[0].end == Vec2(19.7, 2.2));
  CHECK(floor.remarks.empty());
  CHECK(truth.rooms[0].ceiling_m == -0.3);
  CHECK(truth.openings[1].b == Vec2(4, 9.7));
  CHECK(truth.openings[1].sill_m == 0.9);
  CHECK(truth.furniture[0].type == "table");
  CHECK(to_geojson(floor, truth) == text);
}

TEST_CASE("a WGS84 truth lies on its floor, though its own centre is another") {
  const auto file = [](const std::string& kind, const std::string& to) {
    return R"({"type":"FeatureCollection","features":[{"type":"Feature","properties":{"kind":")" + kind +
           R"(","id":"1"},"geometry":{"type":"Polygon","coordinates":[[[13.7220,51.0250],[)" + to +
           R"(,51.0250],[)" + to + R"(,51.0260],[13.7220,51.0250]]]}}]})";
  };
  const test::TemporaryFolder folder;
  folder.write("floor.geojson", file("hallway", "13.7230"));
  folder.write("truth.geojson", file("room", "13.7225"));
  const FloorGroundTruth floor = read_floor(folder.path());
  const FloorTruth truth = read_truth(folder.path());
  CHECK((floor.hallways[0].outline[0] - truth.rooms[0].outline[0]).norm() < 1e-9);
  const FloorTruth again = read_truth(folder.path() / "truth.geojson", floor.origin);
  CHECK((again.rooms[0].outline[1] - truth.rooms[0].outline[1]).norm() < 1e-9);
}

TEST_CASE("a door of a room that is not there, a ceiling below the floor, a room twice: refused") {
  const test::TemporaryFolder folder;
  FloorTruth truth = sample_truth();
  truth.openings[0].room = "2";
  CHECK_THROWS_WITH_AS(read_truth(folder.write("a.geojson", to_geojson({}, truth))),
                       doctest::Contains("feature 2 (door '2'): it names the room '2', which the file does"),
                       InputError);
  truth = sample_truth();
  truth.openings[0].width_m = -1;
  CHECK_THROWS_WITH_AS(read_truth(folder.write("w.geojson", to_geojson({}, truth))),
                       doctest::Contains("it has no width"), InputError);
  truth = sample_truth();
  truth.rooms[0].ceiling_m = -4;
  CHECK_THROWS_AS(read_truth(folder.write("b.geojson", to_geojson({}, truth))), InputError);
  truth = sample_truth();
  truth.rooms.push_back(truth.rooms[0]);
  CHECK_THROWS_AS(read_truth(folder.write("c.geojson", to_geojson({}, truth))), InputError);
  CHECK_THROWS_AS(read_truth(folder.path() / "d.geojson"), InputError);
}

TEST_CASE(
    "a building to simulate has no doors of no room or of no height: they would be left out in silence") {
  FloorTruth truth;
  TrueRoom room;
  room.id = "A";
  room.outline = {{0, 0}, {4, 0}, {4, 3}, {0, 3}};
  room.ceiling_m = 2.6;
  truth.rooms = {room};
  TrueOpening door;
  door.kind = "door";
  door.room = "A";
  door.a = {1, 0};
  door.b = {2, 0};
  door.head_m = 2.1;
  truth.openings = {door};
  CHECK(building_of(truth).rooms.at(0).openings.size() == 1);
  truth.openings[0].room = "";
  CHECK_THROWS_WITH_AS(building_of(truth), doctest::Contains("belongs to no room"), InputError);
  truth.openings[0] = door;
  truth.openings[0].head_m = 0;
  CHECK_THROWS_WITH_AS(building_of(truth), doctest::Contains("has no height"), InputError);
}
