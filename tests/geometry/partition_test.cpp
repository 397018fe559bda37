#include "geometry/partition.h"

#include <doctest/doctest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

#include "geometry/polygon.h"
#include "tests/support/rectangle.h"

using namespace gramap;
using test::rectangle;

namespace {

/// The plan turned by an angle that no double can represent and shifted.
PlanInput turned(PlanInput input, double angle_rad, const Vec2& shift) {
  const auto turn = [&](Vec2& p) {
    p = Vec2(std::cos(angle_rad) * p.x() - std::sin(angle_rad) * p.y(),
             std::sin(angle_rad) * p.x() + std::cos(angle_rad) * p.y()) +
        shift;
  };
  for (Polygon& ring : input.outline)
    for (Vec2& p : ring) turn(p);
  for (Polygon& ring : input.rooms)
    for (Vec2& p : ring) turn(p);
  for (PlanOpening& opening : input.openings) turn(opening.a), turn(opening.b);
  return input;
}

int count(const Partition& plan, PlanCell::Kind kind) {
  return static_cast<int>(std::count_if(plan.walls.begin(), plan.walls.end(),
                                        [kind](const auto& wall) { return wall.kind == kind; }));
}

const Partition::Wall* wall_between(const Partition& plan, int a, int b) {
  for (const auto& wall : plan.walls)
    if (wall.kind == PlanCell::Kind::wall && wall.side_a == a && wall.side_b == b) return &wall;
  return nullptr;
}

/// A hallway with two rooms above (inner wall 0.2) and one below; outer walls 0.3.
PlanInput small_floor() {
  PlanInput input;
  input.outline = {rectangle(0, 0, 8.6, 10.6)};
  input.rooms = {rectangle(0.3, 4.3, 8.3, 6.3),   // hallway
                 rectangle(0.3, 6.5, 4.2, 10.3),  // two rooms above
                 rectangle(4.4, 6.5, 8.3, 10.3),  //
                 rectangle(0.3, 0.3, 8.3, 4.1)};  // one below
  return input;
}

}  // namespace

TEST_CASE("a small floor falls into rooms, single walls and junctions without remainder") {
  const Partition plan = partition(small_floor());
  CHECK(plan.faults.empty());
  CHECK(plan.exact);
  CHECK(areas_exact(plan));
  CHECK(plan.outline_area_m2 == doctest::Approx(8.6 * 10.6));
  CHECK(plan.rooms_area_m2 + plan.walls_area_m2 == doctest::Approx(plan.outline_area_m2).epsilon(1e-12));

  REQUIRE(wall_between(plan, 1, 2) != nullptr);
  CHECK(wall_between(plan, 1, 2)->thickness_m == doctest::Approx(0.2));
  CHECK(wall_between(plan, 1, 2)->length_m == doctest::Approx(3.8));
  REQUIRE(wall_between(plan, 0, 3) != nullptr);
  CHECK(wall_between(plan, 0, 3)->length_m == doctest::Approx(8.0));
  // Inner: hallway with each of three rooms, the partition. Outer: hallway 2, corner rooms 2 each, the room
  // below 3.
  CHECK(count(plan, PlanCell::Kind::wall) == 4 + 2 + 4 + 3);
  // Four corners, T's: partition at the hallway and at the façade, both hallway walls at both outer walls.
  CHECK(count(plan, PlanCell::Kind::junction) == 4 + 2 + 4);
  CHECK(count(plan, PlanCell::Kind::mass) == 0);
}

TEST_CASE("turned by any angle and shifted far away, the parts are the same") {
  const Partition straight = partition(small_floor());
  for (const double angle : {0.28, 1.0, 2.5}) {
    const Partition plan = partition(turned(small_floor(), angle, Vec2(812.3, -455.7)));
    CHECK(plan.faults.empty());
    CHECK(plan.exact);
    CHECK(areas_exact(plan));
    REQUIRE(plan.walls.size() == straight.walls.size());
    CHECK(plan.outline_area_m2 == doctest::Approx(straight.outline_area_m2));
    CHECK(wall_between(plan, 1, 2)->thickness_m == doctest::Approx(0.2));
  }
}

TEST_CASE("rooms in different rows give X and offset T junctions, walls of different thickness meet") {
  PlanInput input;
  input.outline = {rectangle(0, 0, 10, 10)};
  input.rooms = {rectangle(0.3, 0.3, 4.0, 4.8), rectangle(4.3, 0.3, 9.7, 4.8), rectangle(0.3, 5.0, 4.0, 9.7),
                 rectangle(4.1, 5.0, 9.7, 9.7)};
  const Partition plan = partition(input);
  CHECK(plan.faults.empty());
  CHECK(plan.exact);
  CHECK(areas_exact(plan));
  CHECK(wall_between(plan, 0, 1)->thickness_m == doctest::Approx(0.3));
  CHECK(wall_between(plan, 2, 3)->thickness_m == doctest::Approx(0.1));
  CHECK(wall_between(plan, 0, 2)->thickness_m == doctest::Approx(0.2));
  CHECK(wall_between(plan, 1, 3)->thickness_m == doctest::Approx(0.2));
}

TEST_CASE("oblique walls and a round bay") {
  PlanInput input;
  input.outline = {{{0, 0}, {12, 0}, {15, 6}, {0, 6}}};
  Polygon bay;
  for (int i = 0; i <= 12; ++i)
    bay.emplace_back(6.5 + 2 * std::sin(i * M_PI / 12), 3 - 2 * std::cos(i * M_PI / 12));
  bay.insert(bay.begin(), {0.3, 1});
  bay.push_back({0.3, 5});
  input.rooms = {bay, {{9, 0.3}, {11.8, 0.3}, {14.5, 5.7}, {9, 5.7}}};
  for (Polygon& ring : input.rooms) REQUIRE(signed_area(ring) > 0);
  const Partition plan = partition(input);
  CHECK(plan.faults.empty());
  CHECK(plan.exact);
  CHECK(areas_exact(plan));
}

TEST_CASE("a ring around a courtyard") {
  PlanInput input;
  input.outline = {rectangle(0, 0, 20, 20), {{5, 5}, {5, 15}, {15, 15}, {15, 5}}};
  input.rooms = {{{0.3, 0.3}, {19.7, 0.3}, {19.7, 4.7}, {0.3, 4.7}},
                 {{0.3, 4.9}, {4.7, 4.9}, {4.7, 19.7}, {0.3, 19.7}}};
  const Partition plan = partition(input);
  CHECK(plan.exact);
  CHECK(areas_exact(plan));
  CHECK(plan.outline_area_m2 == doctest::Approx(300));
  CHECK(count(plan, PlanCell::Kind::mass) >= 1);  // what nobody has said anything about
}

TEST_CASE("openings are cut square through the wall") {
  PlanInput input = small_floor();
  input.openings = {{1, {1.0, 6.5}, {2.0, 6.5}}, {1, {0.3, 8}, {0.3, 9}}, {3, {2, 4.1}, {3, 4.1}}};
  const Partition plan = partition(input);
  CHECK(plan.faults.empty());
  CHECK(areas_exact(plan));
  std::vector<double> areas(3, 0);
  for (const PlanCell& cell : plan.cells)
    if (cell.opening >= 0) areas[cell.opening] = cell.area_m2;
  CHECK(areas[0] == doctest::Approx(0.2));
  CHECK(areas[1] == doctest::Approx(0.3));
  CHECK(areas[2] == doctest::Approx(0.2));
  CHECK(plan.walls.size() == partition(small_floor()).walls.size());  // cut, but still single walls
}

TEST_CASE("contradictions are found with their place") {
  PlanInput input = small_floor();
  SUBCASE("rooms that overlap") {
    input.rooms[1][1].x() = input.rooms[1][2].x() = 5;
    const Partition plan = partition(input);
    REQUIRE_FALSE(plan.faults.empty());
    CHECK(plan.faults[0].kind == PlanFault::Kind::overlap);
    CHECK(plan.faults[0].a == 1);
    CHECK(plan.faults[0].b == 2);
    CHECK(plan.faults[0].area_m2 == doctest::Approx(0.6 * 3.8));
    CHECK_FALSE(plan.exact);
  }
  SUBCASE("a room beyond the outline") {
    input.rooms[3] = rectangle(0.3, -1, 8.3, 4.1);
    const Partition plan = partition(input);
    CHECK(std::any_of(plan.faults.begin(), plan.faults.end(), [](const PlanFault& f) {
      return f.kind == PlanFault::Kind::outside_outline && f.a == 3;
    }));
    CHECK_FALSE(plan.exact);
  }
  SUBCASE("a room that touches the outline") {
    input.rooms[3] = rectangle(0.3, 0, 8.3, 4.1);
    const Partition plan = partition(input);
    REQUIRE_FALSE(plan.faults.empty());
    CHECK(plan.faults[0].kind == PlanFault::Kind::zero_wall);
  }
}

TEST_CASE("rooms that nearly touch share their points") {
  PlanInput input;
  input.outline = {rectangle(0, 0, 10, 5)};
  input.rooms = {rectangle(0.3, 0.3, 5, 4.7), rectangle(5 + 3e-6, 0.3, 9.7, 3.7)};
  const Partition plan = partition(input);
  CHECK(plan.exact);
  CHECK(areas_exact(plan));
  CHECK(
      std::none_of(plan.cells.begin(), plan.cells.end(), [](const PlanCell& c) { return c.area_m2 < 1e-3; }));
}

TEST_CASE("rooms that overlap by less than plans are rounded by abut, at any angle") {
  for (const double angle : {0.0, 0.3, 1.1})
    for (const double lap : {2e-4, 9e-4, 2e-3}) {
      CAPTURE(angle);
      CAPTURE(lap);
      // Along a side, with a corner of one within a side of the other; and corner over corner.
      PlanInput input;
      input.outline = {rectangle(0, 0, 10, 8)};
      input.rooms = {rectangle(0.3, 0.3, 5, 4.7), rectangle(5 - lap, 0.3, 9.7, 3.7),
                     rectangle(5 - lap, 4.7 - lap, 9.7, 7.7)};
      const Eigen::Rotation2Dd turn(angle);
      for (std::vector<Polygon>* rings : {&input.outline, &input.rooms})
        for (Polygon& ring : *rings)
          for (Vec2& p : ring) p = turn * p;
      const Partition plan = partition(input);
      CHECK(plan.faults.empty() == (lap < 1e-3));
      CHECK(plan.exact == (lap < 1e-3));
      if (lap > 1e-3) continue;
      CHECK(areas_exact(plan));
      CHECK(plan.rooms_area_m2 ==
            doctest::Approx(4.7 * 4.4 + 4.7 * 3.4 + (4.7 + lap) * (3 + lap) - lap * lap).epsilon(1e-9));
      CHECK(std::none_of(plan.cells.begin(), plan.cells.end(),
                         [](const PlanCell& c) { return c.kind == PlanCell::Kind::room && c.area_m2 < 1; }));
    }
}

TEST_CASE("an outline around rooms") {
  const auto rings =
      outline_around({rectangle(0, 0, 4, 3), rectangle(4.1, 0, 8, 3), rectangle(20, 0, 24, 3)}, 0.3);
  REQUIRE(rings.size() == 2);
  double area = 0;
  for (const Polygon& ring : rings) area += signed_area(ring);
  CHECK(area == doctest::Approx(8.6 * 3.6 + 4.6 * 3.6));
  CHECK(rings[0].size() == 4);
}
