// Indoor plans with the faults that plans have: what can be read is read, the rest is set aside by its name
// and with the reason; only a plan without a floor is refused.
#include <doctest/doctest.h>

#include <algorithm>

#include "floor/cut_holes.h"
#include "floor/known_rows.h"
#include "floor/read_indoor.h"
#include "floor/ring_check.h"
#include "geometry/error.h"
#include "geometry/polygon.h"
#include "tests/floor/drawn_plan.h"
#include "tests/floor/temporary_file.h"

using namespace gramap;
using test::DrawnPlan;

namespace {

const DrawnPlan kPlan;

std::string osm(const std::string& tags, const std::string& geometry) {
  return DrawnPlan::feature(tags, geometry);
}
std::string room(const std::string& id, const std::string& geometry, const std::string& more = "") {
  return osm(R"("indoor":"room","level":"0","ref":")" + id + "\"" + more, geometry);
}
std::string door(double x, double y, const std::string& more = "") {
  return osm(R"("door":"yes","level":"0")" + more, kPlan.point(x, y));
}

/// A hallway of 12 x 2 m, three rooms above it, a door to each: seven features.
std::string osm_base(const DrawnPlan& plan = kPlan) {
  return osm(R"("indoor":"corridor","level":"0","ref":"F")", plan.box(0, 0, 12, 2)) + "," +
         room("1", plan.box(0, 2, 4, 7)) + "," + room("2", plan.box(4, 2, 8, 7)) + "," +
         room("3", plan.box(8, 2, 12, 7)) + "," + osm(R"("door":"yes","level":"0")", plan.point(1, 2)) + "," +
         osm(R"("door":"yes","level":"0")", plan.point(5, 2)) + "," +
         osm(R"("door":"yes","level":"0")", plan.point(9, 2));
}

IndoorFloor read_osm_floor(const std::string& features) {
  const test::TemporaryFolder folder;
  return only_level(folder.write("plan.geojson", DrawnPlan::collection(features)));
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}
bool remarked(const FloorGroundTruth& floor, const std::string& part) {
  return std::any_of(floor.remarks.begin(), floor.remarks.end(),
                     [&](const std::string& remark) { return has(remark, part); });
}

struct Odd {
  std::string feature;
  std::string what, reason;  ///< parts of what is said of it
};

void check_set_aside(const FloorGroundTruth& floor, const Odd& odd) {
  REQUIRE(floor.set_aside.size() == 1);
  INFO(floor.set_aside[0].what, ": ", floor.set_aside[0].reason);
  CHECK(has(floor.set_aside[0].what, odd.what));
  CHECK(has(floor.set_aside[0].reason, odd.reason));
}

std::string message_of(const std::filesystem::path& path) {
  try {
    read_indoor(path);
  } catch (const InputError& error) {
    return error.place.file + " | " + error.what() + " | " + error.advice;
  }
  return "";
}

/// An IMDF archive in a folder: the walkway, three offices above it, an opening to each.
struct Archive {
  test::TemporaryFolder folder;
  std::string units =
      unit("F", "walkway", kPlan.box(0, 0, 12, 2)) + "," + unit("a", "office", kPlan.box(0, 2, 4, 7)) + "," +
      unit("b", "office", kPlan.box(4, 2, 8, 7)) + "," + unit("c", "office", kPlan.box(8, 2, 12, 7));
  std::string levels = level("L", R"("ordinal":0)");
  std::string openings =
      opening("o", kPlan.line({{1, 2}, {2, 2}})) + "," + opening("p", kPlan.line({{5, 2}, {6, 2}}));

  static std::string feature(const std::string& id, const std::string& type, const std::string& properties,
                             const std::string& geometry) {
    return R"({"type":"Feature","id":")" + id + R"(","feature_type":")" + type + R"(","properties":{)" +
           properties + "}," + geometry + "}";
  }
  static std::string unit(const std::string& id, const std::string& category, const std::string& geometry,
                          const std::string& level = "L") {
    return feature(
        id, "unit",
        (category.empty() ? "" : R"("category":")" + category + "\",") + R"("level_id":")" + level + "\"",
        geometry);
  }
  static std::string level(const std::string& id, const std::string& properties) {
    return feature(id, "level", properties, R"("geometry":null)");
  }
  static std::string opening(const std::string& id, const std::string& geometry,
                             const std::string& level = "L") {
    return feature(id, "opening", R"("category":"pedestrian","level_id":")" + level + "\"", geometry);
  }
  void write() const {
    folder.write("manifest.json", R"({"version":"1.0.0"})");
    folder.write("venue.geojson", DrawnPlan::collection(feature("v", "venue", "", R"("geometry":null)")));
    folder.write("unit.geojson", DrawnPlan::collection(units));
    folder.write("level.geojson", DrawnPlan::collection(levels));
    folder.write("opening.geojson", DrawnPlan::collection(openings));
  }
  IndoorFloor read() const {
    write();
    return only_level(folder.path());
  }
};

}  // namespace

TEST_CASE("OpenStreetMap: a feature that cannot be used is set aside, and the floor is as without it") {
  const std::string at = "plan.geojson feature 8";
  const std::vector<Odd> cases{
      {room("X", R"("geometry":null)"), at + " ('X')", "it has no geometry"},
      {R"({"type":"Feature","properties":{"indoor":"room","level":"0","ref":"X"}})", at + " ('X')",
       "it has no geometry"},
      {room("X", kPlan.point(2, 10)), at + " ('X')", "it is a Point and no area"},
      {room("X", kPlan.line({{0, 8}, {4, 8}, {4, 9}})), at, "a line that does not end where it begins"},
      {room("X",
            DrawnPlan::geometry("Polygon", "[" + kPlan.positions({{0, 8}, {4, 12}, {4, 8}, {0, 12}}) + "]")),
       at, "its polygon crosses or touches itself"},
      {room("X", DrawnPlan::geometry("Polygon", "[" + kPlan.positions({{0, 8}, {4, 8}, {2, 8}}) + "]")), at,
       "its polygon encloses no area"},
      {room("X", DrawnPlan::geometry("Polygon", "[" + kPlan.positions({{0, 8}, {0, 8}}) + "]")), at,
       "its polygon encloses no area"},
      {room("X", R"("geometry":{"type":"Polygon","coordinates":[[]]})"), at, "its polygon encloses no area"},
      {room("X", R"("geometry":{"type":"MultiPolygon","coordinates":[]})"), at, "its geometry is empty"},
      {room("X", R"("geometry":{"type":"Polygon","coordinates":[[["a",1],[2,3]]]})"), at,
       "a position is not a pair of numbers"},
      {room("X", R"("geometry":{"type":"Circle","coordinates":[13.7,51]})"), at,
       "its geometry type 'Circle' is unknown"},
      {room("X", R"("geometry":{"type":"GeometryCollection","geometries":[]})"), at,
       "it is a GeometryCollection and no area"},
      {room("X", R"("geometry":{"type":"Polygon","coordinates":[[[0,0],[0.0001,0],[0,0.0001],[0,0]]]})"), at,
       "it lies far away from the rest of the plan"},
      {room("X", R"("geometry":{"type":"Polygon","coordinates":[[[7,900],[8,900],[8,901],[7,900]]]})"), at,
       "it lies far away from the rest of the plan"},
      {room("X", kPlan.box(0, 2, 4, 7)), at + " ('X')", "it has the outline of plan.geojson feature 2 ('1')"},
      {osm(R"("indoor":"room","level":"3-1")", kPlan.box(0, 8, 4, 9)), at,
       "its level '3-1' is neither a level nor a range of levels"},
      {osm(R"("indoor":"room","level":"0","repeat_on":"0-900")", kPlan.box(0, 8, 4, 9)), at,
       "its repeat_on '0-900' is neither"},
      {door(6, 20), at, "the door lies on no wall of a room, hallway or stairs"},
      {door(5.05, 2), at, "it is a door at the place of plan.geojson feature 6"},
      {osm(R"("door":"yes","level":"0")", kPlan.box(0, 8, 4, 9)), at, "a door is a point or a line"},
      {osm(R"("door":"yes","level":"0")", R"("geometry":null)"), at, "a door is a point or a line"},
  };
  for (const Odd& odd : cases) {
    CAPTURE(odd.feature);
    const IndoorFloor indoor = read_osm_floor(osm_base() + "," + odd.feature);
    check_set_aside(indoor.floor, odd);
    CHECK(indoor.truth.rooms.size() == 3);
    CHECK(indoor.truth.openings.size() == 3);
    CHECK(indoor.floor.spaces.size() == 1);
  }
}

TEST_CASE("OpenStreetMap: a bad room among its neighbours leaves two rows; the reasons are gathered") {
  std::string features = osm_base();
  const std::string good = kPlan.box(4, 2, 8, 7);
  features.replace(features.find(good), good.size(), R"("geometry":null)");
  for (int i = 0; i < 8; ++i) features += "," + room("no" + std::to_string(i), R"("geometry":null)");
  const IndoorFloor indoor = read_osm_floor(features);
  CHECK(indoor.truth.rooms.size() == 2);
  CHECK(indoor.floor.spaces.size() == 2);
  CHECK(indoor.truth.openings.size() == 2);  // the third is a door of the hallway alone
  check_set_aside(indoor.floor, {"", "feature 12 ('no4') and 3 more", "it has no geometry"});
}

TEST_CASE("OpenStreetMap: unusual drawings that mean something are read as it") {
  SUBCASE("a closed way, drawn clockwise, as a converter without areas writes it") {
    const IndoorFloor indoor = read_osm_floor(
        osm_base() + "," + room("4", kPlan.line({{0, 0}, {0, -4}, {12, -4}, {12, 0}, {0, 0}})));
    CHECK(indoor.floor.set_aside.empty());
    REQUIRE(indoor.truth.rooms.size() == 4);
    CHECK(signed_area(indoor.truth.rooms[3].outline) == doctest::Approx(11.8 * 3.8).epsilon(0.001));
  }
  SUBCASE("a MultiPolygon: each part is a room; two rooms of one number") {
    const IndoorFloor indoor =
        read_osm_floor(osm_base() + "," +
                       room("1", DrawnPlan::geometry("MultiPolygon", "[[" + kPlan.ring(0, -4, 6, 0) + "],[" +
                                                                         kPlan.ring(6, -4, 12, 0) + "]]")));
    CHECK(indoor.floor.set_aside.empty());
    REQUIRE(indoor.truth.rooms.size() == 5);
    CHECK(indoor.truth.rooms[3].id == "1_2");
    CHECK(indoor.truth.rooms[4].id == "1_3");
    CHECK(remarked(indoor.floor, "feature 8 ('1'): each of its 2 parts is an area of its own"));
    CHECK(remarked(indoor.floor, "another unit has the same id: plan.geojson feature 8 ('1') is now '1_2'"));
  }
  SUBCASE("a room around a column") {
    const IndoorFloor indoor =
        read_osm_floor(osm_base() + "," +
                       room("4", DrawnPlan::geometry("Polygon", "[" + kPlan.ring(0, -4, 12, 0) + "," +
                                                                    kPlan.ring(3, -3, 3.5, -2.5) + "]")));
    CHECK(indoor.floor.set_aside.empty());
    CHECK(indoor.truth.rooms.size() == 4);
    CHECK(remarked(indoor.floor, "feature 8 ('4'): its hole is filled"));
  }
  SUBCASE(
      "properties that are null, or in an object of their own; features of other kinds; no level at all") {
    std::string features = osm_base();
    for (std::size_t at; (at = features.find(R"("level":"0",)")) != std::string::npos;)
      features.erase(at, std::string(R"("level":"0",)").size());
    const IndoorFloor indoor = read_osm_floor(
        R"({"type":"Feature","properties":null,)" + kPlan.point(3, 3) + "},null,7," +
        osm(R"("indoor":"wall")", kPlan.line({{0, 0}, {1, 0}})) + "," +
        osm(R"("tags":{"indoor":"room","ref":"4"})", kPlan.box(0, -4, 12, 0)) + "," + features);
    CHECK(indoor.floor.set_aside.empty());
    CHECK(indoor.floor.name == "plan level 0");
    REQUIRE(indoor.truth.rooms.size() == 4);
    CHECK(indoor.truth.rooms[0].id == "4");
    CHECK(remarked(indoor.floor, "not needed: indoor=wall 1, without indoor tag 3"));
  }
  SUBCASE("a width that is no length, and a room along no hallway") {
    const IndoorFloor indoor = read_osm_floor(osm_base() + "," + door(10.5, 2, R"(,"width":"wide")") + "," +
                                              room("far", kPlan.box(0, 20, 4, 24)));
    CHECK(indoor.floor.set_aside.empty());
    CHECK(indoor.truth.openings.size() == 4);
    CHECK(remarked(indoor.floor, "as wide as doors without a width: plan.geojson feature 8"));
    CHECK(remarked(indoor.floor, "1 room lies along no hallway: far"));
  }
}

TEST_CASE("OpenStreetMap: levels as people list them, and features that are on none of several") {
  const test::TemporaryFolder folder;
  std::string features = osm_base();
  for (std::size_t at; (at = features.find(R"("level":"0")")) != std::string::npos;)
    features.replace(at, 11, R"("level":"-2--1; 1","repeat_on":"3")");
  const auto path = folder.write(
      "plan.geojson", DrawnPlan::collection(features + "," + osm(R"("door":"yes")", kPlan.point(3, 2))));
  const std::vector<IndoorFloor> floors = read_indoor(path);
  REQUIRE(floors.size() == 4);
  CHECK(floors[0].floor.name == "plan level -2");
  CHECK(floors[3].floor.name == "plan level 3");
  check_set_aside(floors[0].floor,
                  {"", "plan.geojson feature 8", "it has no level, and the plan has several"});
  CHECK(floors[1].floor.set_aside.empty());
  CHECK(has(message_of(path.string() + "#7"), "the plan has no level '7' | its levels: -1, -2, 1, 3"));
}

TEST_CASE("a hallway around a core is cut at the core, whose rooms then lie along it") {
  const IndoorFloor indoor =
      read_osm_floor(osm(R"("indoor":"corridor","level":"0","ref":"F")",
                         DrawnPlan::geometry("Polygon", "[" + kPlan.ring(0, 0, 20, 14) + "," +
                                                            kPlan.ring(2, 2, 18, 12) + "]")) +
                     "," + room("1", kPlan.box(2, 2, 10, 7)) + "," + room("2", kPlan.box(10, 2, 18, 7)) +
                     "," + room("3", kPlan.box(2, 7, 18, 12)) + "," + room("4", kPlan.box(0, 14, 20, 18)));
  CHECK(indoor.floor.set_aside.empty());
  CHECK(remarked(indoor.floor, "plan.geojson feature 1 ('F'): cut at its hole into 2 pieces"));
  CHECK(indoor.floor.hallways.size() == 2);
  REQUIRE(indoor.floor.spaces.size() == 3);
  std::size_t rooms = 0;
  for (const KnownRow& row : known_rows(indoor.floor, indoor.truth, *indoor.floor.inner_wall_m))
    rooms += row.rooms.size();
  CHECK(rooms == 4);
}

TEST_CASE("areas with any holes are cut into simple pieces that add up to them") {
  const auto box = [](double x0, double y0, double x1, double y1) {
    return Polygon{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
  };
  const auto turned = [](Polygon ring, double angle) {
    for (Vec2& p : ring)
      p = Vec2(std::cos(angle) * p.x() - std::sin(angle) * p.y(),
               std::sin(angle) * p.x() + std::cos(angle) * p.y());
    return ring;
  };
  // One hole; two in a line; a grid of four; one beside an L; a hole with a reflex corner.
  const std::vector<std::vector<Polygon>> cases{
      {box(0, 0, 20, 10), box(2, 2, 18, 8)},
      {box(0, 0, 20, 10), box(2, 2, 8, 8), box(10, 2, 18, 8)},
      {box(0, 0, 20, 10), box(2, 2, 8, 4), box(10, 2, 18, 4), box(2, 6, 8, 8), box(10, 6, 18, 8)},
      {{{0, 0}, {20, 0}, {20, 4}, {6, 4}, {6, 20}, {0, 20}}, box(2, 6, 4, 18)},
      {box(0, 0, 20, 20), {{4, 4}, {16, 4}, {16, 8}, {8, 8}, {8, 16}, {4, 16}}},
  };
  for (const std::vector<Polygon>& rings : cases) {
    for (const double angle : {0.0, 0.3, 2.0}) {
      CAPTURE(rings.size());
      CAPTURE(angle);
      std::vector<Polygon> holes;
      double area = signed_area(rings[0]);
      for (std::size_t i = 1; i < rings.size(); ++i) {
        holes.push_back(turned(rings[i], angle));
        area -= signed_area(rings[i]);
      }
      double sum = 0;
      for (const Polygon& piece : cut_at_holes(turned(rings[0], angle), holes)) {
        CHECK(area_fault(piece).value_or("") == "");
        for (const Polygon& hole : holes)  // its first three corners are those of a triangle in it
          CHECK_FALSE(contains(piece, (hole[0] + hole[1] + hole[2]) / 3));
        sum += signed_area(piece);
      }
      CHECK(sum == doctest::Approx(area));
    }
  }
}

TEST_CASE("a building across the 180th meridian is the same as elsewhere; one at a pole is refused") {
  const IndoorFloor usual = read_osm_floor(osm_base(DrawnPlan{{13.7, -16.5}}));
  // The meridian goes through the second room.
  DrawnPlan across{{179.99995, -16.5}};
  const IndoorFloor there = read_osm_floor(osm_base(across));
  CHECK(std::abs(there.floor.origin->longitude_deg) > 179.9);
  CHECK(std::abs(there.floor.origin->longitude_deg) <= 180);
  REQUIRE(there.truth.rooms.size() == 3);
  for (std::size_t i = 0; i < 3; ++i)
    CHECK(signed_area(there.truth.rooms[i].outline) ==
          doctest::Approx(signed_area(usual.truth.rooms[i].outline)).epsilon(1e-4));
  CHECK(there.truth.openings.size() == 3);
  CHECK(there.floor.spaces.size() == 1);

  const test::TemporaryFolder folder;
  const auto pole = folder.write("plan.geojson", DrawnPlan::collection(osm_base(DrawnPlan{{13.7, 89.99}})));
  CHECK(has(message_of(pole), "within a degree of a pole"));
}

TEST_CASE("plans without a floor are refused with what they lack") {
  const test::TemporaryFolder folder;
  const auto refused = [&](const std::string& features) {
    return message_of(folder.write("plan.geojson", DrawnPlan::collection(features)));
  };
  CHECK(has(refused(room("1", kPlan.box(0, 0, 3, 3))),
            "level 0 has no hallway to find spaces along; hallways "
            "are areas tagged indoor=corridor"));
  CHECK(has(refused(osm(R"("indoor":"corridor")", kPlan.box(0, 0, 3, 3))), "level 0 has no room"));
  CHECK(
      has(refused(osm(R"("indoor":"wall")", kPlan.line({{0, 0}, {1, 1}}))), "no area is tagged indoor=room"));
  CHECK(has(refused(osm(R"("indoor":"corridor")", R"("geometry":null)")),
            "set aside: plan.geojson feature 1: it has no geometry"));
  // Metres without a word, thousands of them: no single feature is at fault.
  CHECK(has(refused(osm(R"("indoor":"corridor")",
                        R"("geometry":{"type":"Polygon","coordinates":[[[0,0],[40,0],[40,3],[0,0]]]})")),
            "these do not look like longitude and latitude"));
  CHECK_FALSE(is_indoor_plan(folder.write("empty.geojson", DrawnPlan::collection(""))));
}

TEST_CASE("IMDF: a feature that cannot be used is set aside, and the floor is as without it") {
  const std::vector<Odd> units{
      {Archive::unit("x", "office", R"("geometry":null)"), "unit.geojson feature 5 ('x')",
       "it has no geometry"},
      {Archive::unit("x", "office", kPlan.box(0, 8, 4, 9), "M"), "feature 5 ('x')",
       "its level_id 'M' names no level"},
      {Archive::unit("x", "office", kPlan.line({{0, 8}, {4, 8}})), "feature 5 ('x')",
       "a line that does not end where it begins"},
      {Archive::unit("a", "office", kPlan.box(0, 2, 4, 7)), "feature 5 ('a')",
       "it has the outline of unit.geojson feature 2 ('a')"},
  };
  for (const Odd& odd : units) {
    CAPTURE(odd.feature);
    Archive archive;
    archive.units += "," + odd.feature;
    const IndoorFloor indoor = archive.read();
    check_set_aside(indoor.floor, odd);
    CHECK(indoor.truth.rooms.size() == 3);
    CHECK(indoor.truth.openings.size() == 2);
  }
  const std::vector<Odd> openings{
      {Archive::opening("x", R"("geometry":null)"), "opening.geojson feature 3 ('x')",
       "an opening is a line, and it is without geometry"},
      {Archive::opening("x", kPlan.point(9, 2)), "feature 3 ('x')",
       "an opening is a line, and it is a Point"},
      {Archive::opening("x", kPlan.line({{9, 2}, {9, 2}})), "feature 3 ('x')", "its line has no length"},
      {Archive::opening("x", kPlan.line({{9, 20}, {10, 20}})), "feature 3 ('x')", "the door lies on no wall"},
      {Archive::opening("x", kPlan.line({{9, 2}, {10, 2}}), "M"), "feature 3 ('x')",
       "its level_id 'M' names no level"},
  };
  for (const Odd& odd : openings) {
    CAPTURE(odd.feature);
    Archive archive;
    archive.openings += "," + odd.feature;
    const IndoorFloor indoor = archive.read();
    check_set_aside(indoor.floor, odd);
    CHECK(indoor.truth.rooms.size() == 3);
    CHECK(indoor.truth.openings.size() == 2);
  }
  const std::vector<Odd> levels{
      {Archive::feature("", "level", R"("ordinal":1)", R"("geometry":null)"), "level.geojson feature 2",
       "the level has no id"},
      {Archive::level("L", R"("ordinal":1)"), "level.geojson feature 2 ('L')", "another level has its id"},
  };
  for (const Odd& odd : levels) {
    CAPTURE(odd.feature);
    Archive archive;
    archive.levels += "," + odd.feature;
    check_set_aside(archive.read().floor, odd);
  }
}

TEST_CASE("IMDF: categories, levels and files that are missing or mixed up") {
  Archive archive;
  SUBCASE("no category, one that IMDF does not know, things that are no rooms") {
    archive.units += "," + Archive::unit("d", "", kPlan.box(0, -4, 4, 0)) + "," +
                     Archive::unit("e", "3d printing", kPlan.box(4, -4, 8, 0)) + "," +
                     Archive::unit("f", "column", kPlan.box(1, 1, 1.5, 1.5));
    const IndoorFloor indoor = archive.read();
    CHECK(indoor.floor.set_aside.empty());
    REQUIRE(indoor.truth.rooms.size() == 5);
    CHECK(indoor.truth.rooms[3].type.empty());
    CHECK(
        remarked(indoor.floor, "without a category, read as rooms of no type: unit.geojson feature 5 ('d')"));
    CHECK(remarked(indoor.floor, "read as types of rooms: '3d printing' 1"));
    CHECK(remarked(indoor.floor, "units that are no rooms and not needed: column 1"));
  }
  SUBCASE("a level without a number: its units are read") {
    archive.levels = Archive::level("L", R"("ordinal":"ground","short_name":{"en":"G"})");
    const IndoorFloor indoor = archive.read();
    CHECK(indoor.floor.name.ends_with("level ground"));
    CHECK(remarked(indoor.floor, "level.geojson feature 1 ('L') has no number as its ordinal"));
    CHECK(read_indoor(archive.folder.path().string() + "#G").size() == 1);
  }
  SUBCASE("two buildings of a venue, levels of one ordinal: named by their ids; a unit on neither") {
    archive.levels += "," + Archive::level("M", R"("ordinal":0)");
    archive.units += "," + Archive::unit("G", "walkway", kPlan.box(30, 0, 42, 2), "M") + "," +
                     Archive::unit("k", "office", kPlan.box(30, 2, 34, 7), "M") + "," +
                     Archive::feature("x", "unit", R"("category":"office")", kPlan.box(0, 8, 4, 9));
    archive.write();
    const std::vector<IndoorFloor> floors = read_indoor(archive.folder.path());
    REQUIRE(floors.size() == 2);
    CHECK(floors[1].floor.name.ends_with("level M"));
    CHECK(floors[1].truth.rooms.size() == 1);
    check_set_aside(floors[0].floor,
                    {"", "feature 7 ('x')", "it has no level_id, and there are several levels"});
    CHECK(only_level(archive.folder.path().string() + "#M").truth.rooms.size() == 1);
  }
  SUBCASE("a level without hallways costs the others nothing") {
    archive.levels += "," + Archive::level("M", R"("ordinal":1)");
    archive.units += "," + Archive::unit("k", "office", kPlan.box(0, 2, 4, 7), "M");
    check_set_aside(archive.read().floor, {"", "level 1", "it has no hallway to find spaces along"});
    CHECK(has(message_of(archive.folder.path().string() + "#1"),
              "hallways are units of the category 'walkway'"));
  }
  SUBCASE("no levels at all") {
    archive.write();
    std::filesystem::remove(archive.folder.path() / "level.geojson");
    const IndoorFloor indoor = only_level(archive.folder.path());
    CHECK(indoor.floor.name.ends_with("level L"));
    CHECK(indoor.truth.openings.size() == 2);
    CHECK(remarked(indoor.floor, "the archive gives no levels"));
  }
  SUBCASE("openings and levels among the units, as one file or in the units' file") {
    archive.units += "," + archive.openings + "," + archive.levels;
    const auto one = archive.folder.write("venue.json", DrawnPlan::collection(archive.units));
    REQUIRE(is_indoor_plan(one));
    CHECK(only_level(one).truth.openings.size() == 2);
    archive.openings = archive.levels = "";
    const IndoorFloor indoor = archive.read();
    CHECK(indoor.truth.openings.size() == 2);
    CHECK(remarked(indoor.floor,
                   "also holds other types, which are read as what they are: level 1, opening 2"));
  }
  SUBCASE("the units' file means its archive") {
    archive.write();
    CHECK(only_level(archive.folder.path() / "unit.geojson").truth.openings.size() == 2);
  }
  SUBCASE("no units, no readable levels: refused, by name") {
    archive.units = "";
    archive.write();
    CHECK(has(message_of(archive.folder.path()), "there is no unit in it"));
    archive.folder.write("level.geojson", "{");
    CHECK(has(message_of(archive.folder.path()), "level.geojson | the JSON ends too early"));
    std::filesystem::remove(archive.folder.path() / "unit.geojson");
    REQUIRE(is_indoor_plan(archive.folder.path()));
    CHECK(has(message_of(archive.folder.path()), "the IMDF archive has no unit.geojson"));
  }
}
