// Hallways that grow into outlines of many shapes: what holds of the network, and of the floors that come of
// it.
#include "floor/grow_hallways.h"

#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>
#include <string>

#include "floor/complete_floor.h"
#include "floor/fit_floor.h"
#include "floor/spaces.h"
#include "floor/verify.h"
#include "geometry/error.h"
#include "geometry/file.h"
#include "geometry/polygon.h"
#include "grammar/language.h"

using namespace gramap;

namespace {

Polygon rectangle(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

struct Shape {
  const char* name;
  Polygon outline;
  std::vector<Polygon> courtyards;
};

/// Outlines whose arms are `b` broad.
std::vector<Shape> shapes(double b) {
  const double l = 3 * b;
  return {
      {"bar", rectangle(0, 0, l, b), {}},
      {"tower", rectangle(0, 0, b, l), {}},
      {"L", {{0, 0}, {l, 0}, {l, l}, {l - b, l}, {l - b, b}, {0, b}}, {}},
      {"U", {{0, 0}, {l, 0}, {l, 2 * b}, {l - b, 2 * b}, {l - b, b}, {b, b}, {b, 2 * b}, {0, 2 * b}}, {}},
      {"T", {{0, 0}, {l, 0}, {l, b}, {2 * b, b}, {2 * b, 2.5 * b}, {b, 2.5 * b}, {b, b}, {0, b}}, {}},
      {"block", rectangle(0, 0, l, 2.4 * b), {}},
      {"court", rectangle(0, 0, l, l), {rectangle(b, b, 2 * b, 2 * b)}},
      {"slanted", {{0, 0}, {l, 0}, {l - 0.3 * b, b}, {0.2 * b, 1.1 * b}}, {}},
      {"narrow", rectangle(0, 0, l, 0.65 * b), {}},
  };
}

Polygon turned(Polygon ring, double angle_rad) {
  for (Vec2& p : ring)
    p = Vec2(std::cos(angle_rad) * p.x() - std::sin(angle_rad) * p.y() + 100,
             std::sin(angle_rad) * p.x() + std::cos(angle_rad) * p.y() - 50);
  return ring;
}

FloorGroundTruth floor_of(const Shape& shape, double angle_rad) {
  FloorGroundTruth floor;
  floor.name = shape.name;
  floor.outline = turned(shape.outline, angle_rad);
  for (const Polygon& court : shape.courtyards) floor.courtyards.push_back(turned(court, angle_rad));
  return floor;
}

/// The shipped rule files that say how hallways grow.
std::vector<RuleSet> rules_with_hallways() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(GRAMAP_SOURCE_DIR "/rules"))
    if (entry.path().extension() == ".grammar") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<RuleSet> all;
  for (const auto& file : files)
    if (RuleSet rules = *check_rules(read_file(file), file.string()).rules; rules.hallways)
      all.push_back(std::move(rules));
  return all;
}

double breadth_for(const RuleSet& rules) {
  return 2 * (rules.hallways->depth_m + 0.4) + rules.hallways->width.mean_m + 2 * rules.outer_wall_m;
}

const char* const kPlain =
    "grammar t; room R { width 3 m +- 1 m; } start S; r: S -> R S;"
    "hallways { width 2 m; depth 4 m; axiom A; ";

HallwayGrammar hallways(const std::string& productions) {
  const CheckedRules checked = check_rules(kPlain + productions + " }", "t");
  REQUIRE(checked.rules.has_value());
  return *checked.rules->hallways;
}

Polygon grown_in(const Polygon& outline, const std::string& productions, std::uint64_t seed = 1) {
  FloorGroundTruth floor;
  floor.outline = outline;
  return grow_hallways(floor, hallways(productions), 0.2, 0.3, seed);
}

}  // namespace

TEST_CASE("a hallway runs in the middle of a bar, from wall to wall") {
  const Polygon ring = grown_in(rectangle(0, 0, 40, 14), "a: A -> straight 7 m A;");
  REQUIRE(ring.size() == 4);
  CHECK(signed_area(ring) == doctest::Approx(39.4 * 2));
  CHECK(centroid(ring).isApprox(Vec2(20, 7), 1e-9));
}

TEST_CASE("where rooms fit on one side only, the hallway runs along the other wall") {
  const Polygon ring = grown_in(rectangle(0, 0, 40, 8), "a: A -> straight ~;");
  CHECK(signed_area(ring) == doctest::Approx(39.4 * 2));
  CHECK(std::abs(std::abs(centroid(ring).y() - 4) - 2.7) < 1e-9);
}

TEST_CASE("a turn leads into the middle of the next wing and ends in the corner") {
  const Polygon outline{{0, 0}, {40, 0}, {40, 35}, {26, 35}, {26, 14}, {0, 14}};
  const std::string productions =
      "a: A -> straight 6 m A; l: A : length < 2 m and left > 9 m -> left { straight ~ };"
      "r: A : length < 2 m and right > 9 m -> right { straight ~ };";
  for (std::uint64_t seed = 1; seed < 8; ++seed) {
    const Polygon ring = grown_in(outline, productions, seed);
    REQUIRE(ring.size() == 6);
    // 0.3..34 along the bar and 8..34.7 up the wing, or the other way round, 2 m wide.
    CHECK(signed_area(ring) == doctest::Approx(2 * (34 - 0.3) + 2 * (34.7 - 8)));
  }
}

TEST_CASE("wings of a block keep two rows of rooms apart") {
  const std::string productions =
      "a: A : left > 8 m and right > 8 m -> straight 3 m left { straight ~ } right { straight ~ } A : 5;"
      "b: A -> straight 3 m A;";
  for (std::uint64_t seed = 1; seed < 6; ++seed) {
    FloorGroundTruth floor;
    floor.outline = rectangle(0, 0, 50, 32);
    floor.hallways.push_back({"h", "", grown_in(floor.outline, productions, seed)});
    CHECK(floor.hallways[0].outline.size() >= 20);
    derive_spaces(floor, 0.2, 0.3);
    int deep = 0;
    for (const Space& space : floor.spaces) {
      const Vec2 along = (space.end - space.start).normalized();
      for (const Vec2& p : space.outline) deep += Vec2(-along.y(), along.x()).dot(p - space.start) > 3.9;
    }
    CHECK(deep >= 2 * static_cast<int>(floor.spaces.size()) - 4);
    CHECK_NOTHROW(check_floor(floor, "f"));
  }
}

TEST_CASE("what has no place is refused with the reason") {
  CHECK_THROWS_AS(grown_in(rectangle(0, 0, 6, 6), "a: A -> straight ~;"), InputError);
  CHECK_THROWS_AS(grown_in(rectangle(0, 0, 40, 14), "a: A : length > 100 m -> straight ~;"), InputError);
  FloorGroundTruth nothing;
  nothing.outline = rectangle(0, 0, 40, 14);
  RuleSet rules = *check_rules("grammar t; room R { width 3 m; } start S; r: S -> R S;", "t").rules;
  CHECK_THROWS_AS(complete_floor(nothing, rules, 1), InputError);
}

TEST_CASE("stairs at the facade leave the hallway its way") {
  FloorGroundTruth floor;
  floor.outline = rectangle(0, 0, 40, 14);
  floor.fixed.push_back({"F", "Stairs", "", rectangle(12, 8.2, 15, 13.7)});
  floor.fixed.push_back({"G", "Lift", "", rectangle(20, 6, 22, 8)});
  const Polygon ring = grow_hallways(floor, hallways("a: A -> straight ~;"), 0.2, 0.3, 1);
  CHECK(signed_area(ring) == doctest::Approx(39.4 * 2));
  floor.hallways.push_back({"h", "", ring});
  CHECK_NOTHROW(check_floor(floor, "f"));
}

TEST_CASE("the same seed grows the same hallways; seeds differ") {
  const RuleSet rules = rules_with_hallways().front();
  const double b = breadth_for(rules);
  const FloorGroundTruth floor = floor_of({"block", rectangle(0, 0, 5 * b, 3 * b), {}}, 0);
  const auto grow = [&](std::uint64_t seed) {
    return grow_hallways(floor, *rules.hallways, rules.inner_wall_m, rules.outer_wall_m, seed);
  };
  CHECK(grow(1) == grow(1));
  int different = 0;
  for (std::uint64_t seed = 2; seed < 6; ++seed) different += grow(seed) != grow(1);
  CHECK(different == 4);
}

TEST_CASE("networks of every shipped rule file lie inside outlines of every shape") {
  const auto all = rules_with_hallways();
  REQUIRE(all.size() >= 2);
  for (const RuleSet& rules : all) {
    CAPTURE(rules.name);
    for (const Shape& shape : shapes(breadth_for(rules))) {
      CAPTURE(shape.name);
      for (std::uint64_t seed = 1; seed <= 12; ++seed) {
        CAPTURE(seed);
        FloorGroundTruth floor = floor_of(shape, 0.2 * static_cast<double>(seed));
        floor.hallways.push_back(
            {"h", "", grow_hallways(floor, *rules.hallways, rules.inner_wall_m, rules.outer_wall_m, seed)});
        CHECK(signed_area(floor.hallways[0].outline) > 0);
        CHECK_NOTHROW(check_floor(floor, "f"));  // simple, and inside the outline
        CHECK_NOTHROW(derive_spaces(floor, rules.inner_wall_m, rules.outer_wall_m));
        CHECK_NOTHROW(check_floor(floor, "f"));
      }
    }
  }
}

TEST_CASE("floors fitted on grown hallways pass the proof") {
  std::uint64_t seed = 0;
  for (const RuleSet& rules : rules_with_hallways()) {
    CAPTURE(rules.name);
    for (const Shape& shape : shapes(breadth_for(rules))) {
      CAPTURE(shape.name);
      FloorGroundTruth floor = floor_of(shape, 0.37 * static_cast<double>(++seed % 3));
      complete_floor(floor, rules, seed);
      std::vector<SetAsideInput> set_aside;
      const auto problems = space_problems(floor, rules, {}, {}, set_aside);
      const FittedFloor fitted = fit_floor(floor, rules, problems, {});
      const VerifyReport report = verify(build_model(fitted));
      INFO(to_text(report));
      CHECK(report.ok());
      CHECK(report.totals.area_exact);
      CHECK(report.totals.rooms >= 4);
    }
  }
}
