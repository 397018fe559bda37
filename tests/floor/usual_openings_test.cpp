#include "floor/usual_openings.h"

#include <doctest/doctest.h>

#include "floor/verify.h"

using namespace gramap;

namespace {

Polygon rectangle(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

FittedRoom derived_room(const std::string& id, double start_m, double width_m) {
  FittedRoom room;
  room.id = id;
  room.type = "Office";
  room.space = "north";
  room.start_m = start_m;
  room.width_m = width_m;
  room.depth_m = 3.8;
  room.outline = rectangle(0.3 + start_m, 6.5, 0.3 + start_m + width_m, 10.3);
  return room;
}

}  // namespace

TEST_CASE("rooms nobody has scanned get the door and the windows of their type") {
  RuleSet rules;
  RoomType office;
  office.name = "Office";
  office.door = DoorHabit{1.0, 2.1, {{0.3, {0.2, 0}, false}, {0.7, {0.3, 0}, true}}};
  office.windows = {{1.2, 1.4, 0.9, 1.5}};
  rules.rooms = {office};
  FittedFloor fitted;
  fitted.height_m = 2.7;
  fitted.floor.outline = rectangle(0, 4, 8.6, 10.6);
  fitted.floor.spaces = {{"north", "H", rectangle(0.3, 6.5, 8.3, 10.3), {0.3, 6.5}, {8.3, 6.5}}};
  fitted.hallways.emplace_back();
  fitted.hallways[0].id = "H";
  fitted.hallways[0].outline = rectangle(0.3, 4.3, 8.3, 6.3);
  fitted.rooms = {derived_room("1", 0, 3.9), derived_room("2", 4.1, 3.9)};
  fitted.rooms[1].openings = {{"door", Origin::observed, {5, 6.5}, {6, 6.5}, 0, 2, 1}};

  add_usual_openings(fitted, rules);
  REQUIRE(fitted.rooms[0].openings.size() == 3);  // a door, two windows
  CHECK(fitted.rooms[0].openings[0].a.x() == doctest::Approx(0.3 + 3.9 - 0.3 - 1.0));
  CHECK(fitted.rooms[0].openings[1].a.y() == doctest::Approx(10.3));
  CHECK(fitted.rooms[0].openings[1].head_m == doctest::Approx(2.3));
  CHECK(fitted.rooms[1].openings.size() == 3);  // what was seen stays, nothing is added to it

  const FloorModel model = build_model(fitted);
  const VerifyReport report = verify(model);
  CHECK(report.ok());
  CHECK(report.warnings.empty());
  CHECK(report.totals.doors == 2);
  CHECK(report.totals.windows == 4);

  // The same floor with rooms behind: windows would look into them.
  fitted.floor.outline = rectangle(0, 4, 8.6, 14);
  fitted.fixed.emplace_back();
  fitted.fixed[0].id = "F";
  fitted.fixed[0].outline = rectangle(0.3, 10.5, 8.3, 13.7);
  CHECK(verify(build_model(fitted)).totals.windows == 0);
}
