// What must not change the layout: how the floor lies in the plan, the order of the observations, the units
// of the rule file. And what must be noticed: scans that are not what they seem.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "floor/fit_floor.h"
#include "floor/room_table.h"
#include "geometry/polygon.h"
#include "grammar/language.h"

using namespace gramap;

namespace {

constexpr double kWall_m = 0.2, kDepth_m = 4;
const std::vector<double> kWidths = {3.02, 4.97, 3.01, 2.98, 5.03, 3.0};
const std::vector<std::string> kNames = {"a", "b", "c", "d", "e", "f"};

RuleSet rules_in(const std::string& small, const std::string& large, const std::string& spread,
                 const std::string& wall) {
  const std::string text =
      "grammar g;\nwall inner " + wall + ", outer 0.30 m;\nheight 2.70 m;\nroom Small { width " + small +
      " +- " + spread + "; }\nroom Large { width " + large + " +- " + spread +
      "; }\nstart Row;\nsmall: Row -> Small Row : 60 %;\nlarge: Row -> Large Row : 40 %;\n" +
      "background 0.2 % width 1.00 m .. 9.00 m;\n";
  const CheckedRules checked = check_rules(text, "g");
  REQUIRE(checked.rules);
  return *checked.rules;
}
RuleSet rules_in_metres() {
  return rules_in("3.00 m", "5.00 m", "0.05 m", "0.20 m");
}

Polygon rectangle(double x0, double x1) {
  return {{x0, 0}, {x1, 0}, {x1, kDepth_m}, {x0, kDepth_m}};
}

struct Case {
  FloorGroundTruth floor;
  std::vector<RoomObservation> observations;
};

/// A row of rooms, all but the third and the last one scanned in the building's frame, 5 cm off.
Case row_of_rooms() {
  Case made;
  double start = 0;
  for (std::size_t i = 0; i < kWidths.size(); ++i) {
    RoomObservation seen;
    seen.room = kNames[i];
    seen.outline = rectangle(start + 0.05, start + kWidths[i] + 0.05);
    seen.axis = Vec2(1, 0);
    seen.width = {kWidths[i], 0.01};
    seen.depth = {kDepth_m, 0.01};
    if (i != 2 && i != 5) made.observations.push_back(seen);
    start += kWidths[i] + kWall_m;
  }
  const double length = start - kWall_m;
  made.floor.inner_wall_m = kWall_m;
  made.floor.spaces.push_back({"s", "h", rectangle(0, length), {0, 0}, {length, 0}});
  return made;
}

Case moved(Case made, const std::function<Vec2(const Vec2&)>& motion, bool mirrors) {
  const auto move_ring = [&](Polygon& ring) {
    for (Vec2& point : ring) point = motion(point);
    if (mirrors) std::reverse(ring.begin(), ring.end());
  };
  for (Space& space : made.floor.spaces) {
    move_ring(space.outline);
    space.start = motion(space.start), space.end = motion(space.end);
    if (mirrors) std::swap(space.start, space.end);  // the space stays on the line's left
  }
  for (RoomObservation& seen : made.observations) {
    move_ring(seen.outline);
    seen.axis = motion(seen.axis) - motion(Vec2::Zero());
  }
  return made;
}

FittedFloor fit(const Case& made, const RuleSet& rules = rules_in_metres()) {
  std::vector<SetAsideInput> set_aside;
  const auto problems = space_problems(made.floor, rules, made.observations, {}, set_aside);
  FittedFloor fitted = fit_floor(made.floor, rules, problems, made.observations);
  fitted.set_aside.insert(fitted.set_aside.end(), set_aside.begin(), set_aside.end());
  return fitted;
}

void check_same(const FittedFloor& fitted, bool reversed = false) {
  FittedFloor plain = fit(row_of_rooms());
  if (reversed) std::reverse(plain.rooms.begin(), plain.rooms.end());
  REQUIRE(fitted.rooms.size() == plain.rooms.size());
  for (std::size_t i = 0; i < plain.rooms.size(); ++i) {
    CHECK(fitted.rooms[i].type == plain.rooms[i].type);
    CHECK(fitted.rooms[i].scans == plain.rooms[i].scans);
    CHECK(std::abs(fitted.rooms[i].width_m - plain.rooms[i].width_m) < 1e-3);
  }
}

void check_true(const FittedFloor& fitted) {
  REQUIRE(fitted.rooms.size() == kWidths.size());
  for (std::size_t i = 0; i < kWidths.size(); ++i)
    CHECK(std::abs(fitted.rooms[i].width_m - kWidths[i]) < 0.06);
}

bool named(const FittedFloor& fitted, const std::string& part) {
  return room_table(fitted).find(part) != std::string::npos;
}

/// The row with every room scanned and at its place.
Case all_scanned() {
  Case made = row_of_rooms();
  made.observations.clear();
  double start = 0;
  for (std::size_t i = 0; i < kWidths.size(); ++i) {
    RoomObservation seen;
    seen.room = kNames[i];
    seen.outline = rectangle(start, start + kWidths[i]);
    seen.axis = Vec2(1, 0);
    seen.width = {kWidths[i], 0.01};
    seen.depth = {kDepth_m, 0.01};
    made.observations.push_back(seen);
    start += kWidths[i] + kWall_m;
  }
  return made;
}

}  // namespace

TEST_CASE("the plain row is right") {
  check_true(fit(row_of_rooms()));
}

TEST_CASE("a floor turned by any angle is the same floor") {
  for (const double angle : {0.1, 0.7, M_PI / 2, 2.2, 3.0, -1.3}) {
    const double c = std::cos(angle), s = std::sin(angle);
    check_same(fit(moved(
        row_of_rooms(), [&](const Vec2& p) { return Vec2(c * p.x() - s * p.y(), s * p.x() + c * p.y()); },
        false)));
  }
}

TEST_CASE("a floor shifted by 10 km is the same floor") {
  check_same(fit(moved(
      row_of_rooms(), [](const Vec2& p) { return Vec2(p + Vec2(10000, -10000)); }, false)));
}

TEST_CASE("a mirrored floor, its reference line reversed, is the same row from the other end") {
  check_same(fit(moved(
                 row_of_rooms(), [](const Vec2& p) { return Vec2(-p.x(), p.y()); }, true)),
             true);
  check_same(fit(moved(
                 row_of_rooms(), [](const Vec2& p) { return Vec2(p.x(), -p.y()); }, true)),
             true);
}

TEST_CASE("the order of the observations does not matter") {
  Case made = row_of_rooms();
  std::reverse(made.observations.begin(), made.observations.end());
  check_same(fit(made));
  std::swap(made.observations[0], made.observations[2]);
  check_same(fit(made));
}

TEST_CASE("rules in centimetres and millimetres mean the same as in metres") {
  check_same(fit(row_of_rooms(), rules_in("300 cm", "500 cm", "5 cm", "20 cm")));
  check_same(fit(row_of_rooms(), rules_in("3000 mm", "5000 mm", "50 mm", "200 mm")));
}

TEST_CASE("a cupboard front read as a wall leaves the floor right and is named") {
  Case made = all_scanned();
  RoomObservation& seen = made.observations[1];
  for (Vec2& point : seen.outline)
    if (point.x() > 6) point.x() -= 0.5;
  seen.width.value_m -= 0.5;
  const FittedFloor fitted = fit(made);
  check_true(fitted);
  CHECK_MESSAGE(named(fitted, "b: "), room_table(fitted));
}

TEST_CASE("two rooms read as one stay two, and the scan is named, whichever they are and however posed") {
  for (const std::size_t first : {0u, 2u, 3u})
    for (const double off : {-0.3, -0.1, 0.0, 0.2, 0.35}) {
      INFO("rooms ", kNames[first], " and ", kNames[first + 1], " as one, ", off, " m off");
      Case made = all_scanned();
      RoomObservation& seen = made.observations[first];
      seen.width.value_m += kWall_m + kWidths[first + 1];
      for (Vec2& point : seen.outline) point.x() += off;
      seen.outline[1].x() = seen.outline[2].x() = seen.outline[0].x() + seen.width.value_m;
      made.observations.erase(made.observations.begin() + static_cast<std::ptrdiff_t>(first) + 1);
      const FittedFloor fitted = fit(made);
      REQUIRE(fitted.rooms.size() == kWidths.size());
      // Of a small and a large room nothing says which comes first; what they take together is known.
      const auto off_m = [&](std::size_t room) { return fitted.rooms[room].width_m - kWidths[room]; };
      for (std::size_t i = 0; i < kWidths.size(); ++i)
        if (i != first && i != first + 1) CHECK(std::abs(off_m(i)) < 0.06);
      CHECK(std::abs(off_m(first) + off_m(first + 1)) < 0.06);
      CHECK_MESSAGE(named(fitted, "it is two: a wall was missed"), room_table(fitted));
    }
}

TEST_CASE("a scan filed under another room's name leaves the floor right and is named") {
  SUBCASE("a room's only scans are another room's") {
    Case made = all_scanned();
    made.observations[3].outline = made.observations[1].outline;
    made.observations[3].width = made.observations[1].width;
    const FittedFloor fitted = fit(made);
    check_true(fitted);
    CHECK_MESSAGE(named(fitted, "b and d are scans of one room"), room_table(fitted));
    CHECK(fitted.rooms[3].origin == Origin::derived);
  }
  SUBCASE("one of its scans is another room's") {
    Case made = all_scanned();
    made.observations.push_back(made.observations[1]);
    made.observations.back().room = "d";
    const FittedFloor fitted = fit(made);
    check_true(fitted);
    CHECK_MESSAGE(named(fitted, "are scans of one room"), room_table(fitted));
    CHECK_MESSAGE(named(fitted, "d: its scans are of two rooms"), room_table(fitted));
  }
}
