// Doors for rooms that none leads to.
#include "floor/connect_rooms.h"

#include <doctest/doctest.h>

#include "floor/model.h"
#include "floor/verify.h"
#include "geometry/polygon.h"
#include "tests/support/rectangle.h"

using namespace gramap;
using test::rectangle;

namespace {

FittedRoom room(const std::string& id, const Polygon& outline, double start_m, double width_m) {
  FittedRoom made;
  made.id = id;
  made.type = "Room";
  made.space = "s";
  made.origin = Origin::derived;
  made.outline = outline;
  made.start_m = start_m;
  made.width_m = width_m;
  made.height_m = 2.5;
  return made;
}

void add_door(FittedRoom& to, const Vec2& a, const Vec2& b) {
  to.openings.push_back({"door", Origin::derived, a, b, 0, 2.1, 1});
}

/// A hallway along y = 0 and, above it, what the test puts there.
FittedFloor beside_a_hallway(double length_m) {
  FittedFloor floor;
  floor.inner_wall_m = 0.2;
  floor.outer_wall_m = 0.3;
  floor.height_m = 2.5;
  floor.floor.outline = rectangle(-0.3, -2.5, length_m + 0.3, 7.3);
  FittedRoom hallway = room("hall", rectangle(0, -2.2, length_m, -0.2), 0, 0);
  hallway.space.clear();
  hallway.origin = Origin::given;
  floor.hallways.push_back(hallway);
  return floor;
}

int doors(const FittedRoom& of) {
  return static_cast<int>(of.openings.size());
}

/// The room of the floor on the other side of a door.
std::string behind(const FittedFloor& floor, const FittedOpening& door) {
  const Vec2 along = (door.b - door.a).normalized(),
             beyond = (door.a + door.b) / 2 + Vec2(along.y(), -along.x()) * 0.3;
  for (const auto* list : {&floor.hallways, &floor.rooms})
    for (const FittedRoom& place : *list)
      if (contains(place.outline, beyond)) return place.id;
  return "nowhere";
}

void check_model(const FittedFloor& floor) {
  const VerifyReport report = verify(build_model(floor));
  INFO(to_text(report));
  CHECK(report.ok());
  CHECK(report.warnings.empty());
}

}  // namespace

TEST_CASE("the rooms of a unit are entered from each other, not from the next unit or the hallway") {
  FittedFloor floor = beside_a_hallway(8);
  for (const double x : {0.0, 4.1}) {
    const std::string n = x == 0 ? "1" : "2";
    floor.rooms.push_back(room("bath" + n, rectangle(x, 0, x + 2, 2), x, 2));
    floor.rooms.push_back(room("vestibule" + n, rectangle(x + 2.2, 0, x + 3.9, 2), x + 2.2, 1.7));
    add_door(floor.rooms.back(), {x + 2.5, 0}, {x + 3.4, 0});
    floor.rooms.push_back(room("bed" + n, rectangle(x, 2.2, x + 3.9, 7), x, 3.9));
  }
  connect_rooms(floor);
  for (const FittedRoom& made : floor.rooms) {
    CAPTURE(made.id);
    REQUIRE(doors(made) == 1);
    const std::string n(1, made.id.back());
    CHECK(behind(floor, made.openings[0]) == (made.id[0] == 'v' ? "hall" : "vestibule" + n));
  }
  check_model(floor);
}

TEST_CASE("a room that only neighbours have doors to becomes a way to them") {
  FittedFloor floor = beside_a_hallway(8);
  // Two rooms in a row across the hallway's end; the second one's only door leads into the first.
  floor.hallways[0].outline = rectangle(2.2, -2.2, 8, -0.2);
  floor.rooms.push_back(room("end", rectangle(0, -2.2, 2, -0.2), 0, 2));
  floor.rooms.push_back(room("corner", rectangle(0, 0, 2, 7), 0, 2));
  add_door(floor.rooms.back(), {0.4, 0}, {1.4, 0});
  floor.rooms.push_back(room("next", rectangle(2.2, 0, 8, 7), 2.2, 5.8));
  connect_rooms(floor);
  CHECK(doors(floor.rooms[1]) == 1);
  REQUIRE(doors(floor.rooms[0]) == 1);
  CHECK(behind(floor, floor.rooms[0].openings[0]) == "hall");
  CHECK(behind(floor, floor.rooms[2].openings.at(0)) == "hall");
  check_model(floor);
}

TEST_CASE("a derived door before the end of a wall moves beside it, a seen one stays") {
  for (const Origin origin : {Origin::derived, Origin::observed}) {
    FittedFloor floor = beside_a_hallway(8);
    floor.hallways[0].outline = rectangle(2.2, -2.2, 8, -0.2);
    floor.rooms.push_back(room("end", rectangle(0, -2.2, 2, -0.2), 0, 2));
    floor.rooms.push_back(room("wide", rectangle(0, 0, 8, 7), 0, 8));
    add_door(floor.rooms.back(), {1.5, 0}, {2.5, 0});
    floor.rooms.back().openings[0].origin = origin;
    connect_rooms(floor);
    const FittedOpening& door = floor.rooms[1].openings.at(0);
    CHECK((door.b - door.a).norm() == doctest::Approx(1));
    CHECK(door.a.x() == doctest::Approx(origin == Origin::derived ? 2.25 : 1.5));
    if (origin == Origin::derived) check_model(floor);
  }
}

TEST_CASE("scanned rooms get no doors that nobody saw, and rooms that nothing touches stay closed") {
  FittedFloor floor = beside_a_hallway(8);
  floor.rooms.push_back(room("seen", rectangle(0, 0, 3, 7), 0, 3));
  floor.rooms.back().origin = Origin::observed;
  floor.rooms.push_back(room("island", rectangle(4.5, 1.5, 7, 6), 4.5, 2.5));
  connect_rooms(floor);
  CHECK(doors(floor.rooms[0]) == 0);
  CHECK(doors(floor.rooms[1]) == 0);
}
