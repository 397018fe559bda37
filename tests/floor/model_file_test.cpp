// Models with everything in them: written, read back, verified from the file, given back as GeoJSON.
#include <doctest/doctest.h>

#include <filesystem>
#include <string>

#include "floor/fitted_geojson.h"
#include "floor/floor_of_truth.h"
#include "floor/gltf.h"
#include "floor/read_model.h"
#include "floor/stack.h"
#include "floor/svg.h"
#include "floor/verify_file.h"
#include "geometry/error.h"
#include "geometry/file.h"
#include "tests/floor/saved_model.h"
#include "tests/support/rectangle.h"

using namespace gramap;
using test::rectangle;
using test::saved;

namespace {

FittedFloor furnished_floor() {
  FloorGroundTruth floor;
  floor.name = "A & B <1>";
  floor.ceiling_height_m = 2.6;
  floor.inner_wall_m = 0.2;
  floor.outer_wall_m = 0.3;
  floor.outline = rectangle(0, 0, 8.6, 10.6);
  floor.hallways = {{"F1", "Flur", rectangle(0.3, 4.3, 8.3, 6.3)}};
  floor.spaces = {{"north", "F1", rectangle(0.3, 6.5, 8.3, 10.3), {0.3, 6.5}, {8.3, 6.5}}};
  floor.pins = {{"101", {2, 8}, 0.4}};
  FloorTruth truth;
  truth.rooms = {{"101", "Office", "Büro <1>", rectangle(0.3, 6.5, 4.2, 10.3), 0, 2.6},
                 {"102", "Office", "", rectangle(4.4, 6.5, 8.3, 10.3), 0, 2.6},
                 {"103", "Lab", "", rectangle(0.3, 0.3, 8.3, 4.1), 0, 2.6}};
  truth.openings = {
      {"door", "101", {1, 6.5}, {2, 6.5}, 1, 0, 2.1},
      {"door", "F1", {2.02, 6.3}, {1.01, 6.3}, 1, 0, 2.1},  // the same one, seen from the hallway
      {"door", "103", {3, 4.1}, {4.6, 4.1}, 1.6, 0, 2.1},
      {"window", "101", {1, 10.3}, {2.5, 10.3}, 1.5, 0.9, 2.3},
      {"window", "101", {2.6, 10.3}, {4.19, 10.3}, 1.6, 0.9, 2.3},  // up to the wall's end
      {"window", "103", {0.3, 1}, {0.3, 2}, 1, 0, 2.59},            // to the floor and the ceiling
      {"window", "102", {4, 8}, {5, 8}, 1, 0.9, 2}};                // in no wall
  truth.furniture = {{"103", "table", rectangle(2, 1, 3.6, 1.8), 0, 0.74},
                     {"103", "chair", rectangle(2.5, 2, 3, 2.5), 0, 0.9},
                     {"103", "cupboard", rectangle(7.2, 3.2, 8.35, 4.15), 0, 2},  // measured into the walls
                     {"101", "other", rectangle(0.4, 9, 1, 9.5), 0.8, 1.3},
                     {"102", "bed", {{5, 7}, {6.9, 7.5}, {6.7, 8.4}, {4.8, 7.9}}, 0, 0.5}};
  return floor_of_truth(floor, truth);
}

bool has(const VerifyReport& report, const std::string& code) {
  for (const VerifyFault& fault : report.faults)
    if (fault.code == code) return true;
  return false;
}

}  // namespace

TEST_CASE("openings are cut, seen once, and kept within their walls; furniture stands within its room") {
  const FloorModel model = build_model(furnished_floor());
  const VerifyReport report = verify(model);
  INFO(to_text(report));
  CHECK(report.ok());
  CHECK(report.totals.doors == 2);
  CHECK(report.totals.windows == 3);
  CHECK(report.totals.furniture == 5);
  REQUIRE(model.set_aside.size() == 1);
  CHECK(model.set_aside[0].reason == "no wall of the room is there");
  REQUIRE(report.warnings.size() == 1);  // 102 has no door
  CHECK(report.warnings[0].message == "no door leads to room_102");
  double volume = 0;
  for (const ModelWall& wall : model.walls) volume += signed_volume(wall.solid);
  double solid = model.plan.walls_area_m2 * (model.height_m + model.finish_m);
  for (const ModelOpening& opening : model.openings)
    solid -= opening.width_m * opening.thickness_m * (opening.fitted.head_m - opening.fitted.sill_m);
  CHECK(volume == doctest::Approx(solid));
}

TEST_CASE("a model read back is the floor that was written, and its file passes the proof") {
  const FittedFloor written = furnished_floor();
  const ReadModel read = read_model(saved("furnished.glb", to_glb(build_model(written), {})));
  const VerifyReport report = verify_file(read);
  INFO(to_text(report));
  CHECK(report.ok());
  CHECK(report.totals.area_exact);
  CHECK(report.totals.doors == 2);
  REQUIRE(read.floor.rooms.size() == written.rooms.size());
  for (std::size_t i = 0; i < written.rooms.size(); ++i) {
    CHECK(read.floor.rooms[i].id == written.rooms[i].id);
    CHECK(read.floor.rooms[i].name == written.rooms[i].name);
    CHECK(read.floor.rooms[i].outline == written.rooms[i].outline);
    CHECK(read.floor.rooms[i].width_m == written.rooms[i].width_m);
    CHECK(read.floor.rooms[i].space == written.rooms[i].space);
  }
  CHECK(read.floor.floor.spaces.size() == 1);
  REQUIRE(read.floor.floor.pins.size() == 1);
  CHECK(read.floor.floor.pins[0].room == "101");
  CHECK(read.floor.floor.pins[0].at == Vec2(2, 8));
  CHECK(read.floor.floor.pins[0].sigma_m == 0.4);
  CHECK(read.floor.rooms[2].furniture.size() == 3);
  CHECK(verify(build_model(read.floor)).ok());
  const ReadModel text = read_model(saved("furnished.gltf", to_gltf({build_model(written)}, {})));
  CHECK(text.nodes.size() == read.nodes.size());
}

TEST_CASE("storeys become a building, with the slab between them as thick as their heights leave") {
  FittedFloor lower = furnished_floor(), upper = furnished_floor();
  upper.floor.elevation_m = 3;
  upper.floor.name = "upper";
  const auto storeys = build_storeys({upper, lower});
  REQUIRE(storeys.size() == 2);
  CHECK(storeys[1].slab_thickness_m == doctest::Approx(0.4));
  const ReadModel read = read_model(saved("building.glb", to_glb(storeys, {})));
  CHECK(verify_file(read).ok());
  REQUIRE(read.storeys.size() == 2);
  CHECK(read.storeys[1].floor.elevation_m == 3);
  upper.floor.elevation_m = 2;
  CHECK_THROWS_AS(build_storeys({lower, upper}), InputError);
}

TEST_CASE("coloured by confidence and with volumes, a model stays a model") {
  GltfOptions options;
  options.confidence_colours = options.room_volumes = true;
  const ReadModel read =
      read_model(saved("confidence.glb", to_glb(build_model(furnished_floor()), {}, options)));
  CHECK(verify_file(read).ok());
}

TEST_CASE("what is wrong with a model file is found") {
  ReadModel model = read_model(saved("furnished.glb", to_glb(build_model(furnished_floor()), {})));
  REQUIRE(verify_file(model).ok());
  const auto node = [&model](const std::string& name) -> ReadNode& {
    for (ReadNode& n : model.nodes)
      if (n.node == name) return n;
    FAIL("no node " << name);
    return model.nodes.front();
  };
  SUBCASE("a wall that is missing leaves a gap") {
    node("wall_101_102").mesh = {};
    CHECK(has(verify_file(model), "gap"));
  }
  SUBCASE("a room that was moved") {
    for (Vec3& p : node("room_101_floor").mesh.points) p.x() += 0.1;
    CHECK(has(verify_file(model), "gap"));
  }
  SUBCASE("a triangle that is missing") {
    node("wall_101_102").mesh.triangles.pop_back();
    CHECK(has(verify_file(model), "open"));
  }
  SUBCASE("a floor that is there twice") {
    std::vector<Triangle>& triangles = node("room_101_floor").mesh.triangles;
    triangles.insert(triangles.end(), triangles.begin(), triangles.end());
    CHECK(has(verify_file(model), "overlap"));
  }
  SUBCASE("a floor that faces down") {
    for (Triangle& t : node("room_101_floor").mesh.triangles) std::swap(t[0], t[1]);
    CHECK(has(verify_file(model), "orientation"));
  }
  SUBCASE("a name twice") {
    node("room_102").node = "room_101";
    CHECK(has(verify_file(model), "name"));
  }
}

TEST_CASE("files that are no models of gramap are refused") {
  const std::string glb = to_glb(build_model(furnished_floor()), {});
  for (const std::size_t length :
       {std::size_t{0}, std::size_t{3}, std::size_t{20}, glb.size() / 2, glb.size() - 4})
    CHECK_THROWS_AS(read_model(saved("broken.bin", glb.substr(0, length))), InputError);
  CHECK_THROWS_AS(read_model(saved("broken.bin", R"({"asset":{"version":"2.0"}})")), InputError);
  CHECK_THROWS_AS(
      read_model(saved("broken.bin", R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{}]})")),
      InputError);
}

TEST_CASE("the fitted floor's GeoJSON gives back the same floor") {
  const FittedFloor written = furnished_floor();
  const auto path = saved("furnished.geojson", to_geojson(written));
  const FloorGroundTruth floor = read_floor(path);
  const FittedFloor read = floor_of_truth(floor, read_truth(path, floor.origin));
  REQUIRE(read.rooms.size() == written.rooms.size());
  for (std::size_t i = 0; i < written.rooms.size(); ++i) {
    CHECK(read.rooms[i].id == written.rooms[i].id);
    CHECK(read.rooms[i].type == written.rooms[i].type);
    CHECK(read.rooms[i].outline == written.rooms[i].outline);
    CHECK(read.rooms[i].openings.size() == written.rooms[i].openings.size());
  }
  CHECK(read.hallways.size() == 1);
  CHECK(floor.outline == written.floor.outline);
}

TEST_CASE("courtyards survive the GeoJSON") {
  FittedFloor written = furnished_floor();
  written.floor.courtyards = {rectangle(6, 1, 7, 2)};
  const FloorGroundTruth floor = read_floor(saved("courtyard.geojson", to_geojson(written)));
  REQUIRE(floor.courtyards.size() == 1);
  CHECK(floor.courtyards[0].size() == 4);
}

TEST_CASE("the plan names every room and escapes what it says") {
  const std::string svg = to_svg(build_model(furnished_floor()));
  CHECK(svg.find("Büro &lt;1&gt;") != std::string::npos);
  CHECK(svg.find("A &amp; B &lt;1&gt;") != std::string::npos);
  CHECK(svg.find(">103<") != std::string::npos);
  CHECK(svg.find("3.90 m") != std::string::npos);
  CHECK(svg.find("class=\"swing\"") != std::string::npos);
  CHECK(svg.find("class=\"glass\"") != std::string::npos);
}
