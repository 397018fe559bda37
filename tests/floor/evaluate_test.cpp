#include "floor/evaluate.h"

#include <doctest/doctest.h>

#include "floor/cross.h"
#include "floor/known_rows.h"
#include "geometry/error.h"

using namespace gramap;

namespace {

Polygon box(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

/// Three rooms of 3 m beside a hallway, walls of 0.2 m.
FloorGroundTruth floor_file() {
  FloorGroundTruth floor;
  floor.hallways = {{"H", "", box(0, -2, 9.4, -0.2)}};
  floor.spaces = {{"S", "H", box(0, 0, 9.4, 5), {0, 0}, {9.4, 0}}};
  return floor;
}
FloorTruth true_rooms() {
  FloorTruth truth;
  for (int i = 0; i < 3; ++i) {
    const double x = 3.2 * i;
    truth.rooms.push_back({std::to_string(i + 1), "Office", "", box(x, 0, x + 3, 5), 0, 2.7});
    truth.openings.push_back({"door", std::to_string(i + 1), {x + 1, 0}, {x + 2, 0}, 1, 0, 2.1});
    truth.furniture.push_back({std::to_string(i + 1), "table", box(x + 1, 3, x + 2, 4), 0, 0.8});
  }
  truth.rooms.push_back({"H", "Hallway", "", box(0, -2, 9.4, -0.2), 0, 2.7});
  return truth;
}
FittedFloor perfect() {
  FittedFloor fitted;
  fitted.floor = floor_file();
  for (const TrueRoom& real : true_rooms().rooms) {
    if (real.id == "H") continue;
    FittedRoom room;
    room.id = "room" + real.id;
    room.type = real.type;
    room.origin = Origin::observed;
    room.outline = real.outline;
    room.space = "S";
    room.width_m = 3;
    room.width_sigma_m = 0.01;
    room.extracted_width_m = 3.01;
    for (const TrueOpening& opening : true_rooms().openings)
      if (opening.room == real.id)
        room.openings.push_back({"door", Origin::observed, opening.a, opening.b, 0, 2.1, 1});
    for (const TrueFurniture& piece : true_rooms().furniture)
      if (piece.room == real.id)
        room.furniture.push_back({piece.type, Origin::observed, piece.outline, 0, 0.8, 1});
    fitted.rooms.push_back(room);
  }
  return fitted;
}

}  // namespace

TEST_CASE("a perfect model has no error, and what its scans said is told apart") {
  const Evaluation evaluation = evaluate(perfect(), true_rooms(), floor_file());
  REQUIRE(evaluation.rooms.size() == 3);
  CHECK(evaluation.observed.count == 3);
  CHECK(evaluation.observed.worst_m == doctest::Approx(0));
  CHECK(evaluation.extracted.mean_abs_m == doctest::Approx(0.01));
  CHECK(evaluation.walls[0].completeness == 1);
  CHECK(evaluation.walls[0].correctness == 1);
  CHECK(evaluation.spaces[0].in_order);
  CHECK(evaluation.within_2_sigma == 1);
  CHECK(evaluation.openings[0].matched == 3);
  CHECK(evaluation.furniture.back().matched == 3);
  CHECK(to_json(evaluation).find("\"in_order\": true") != std::string::npos);
  CHECK(to_html(evaluation, "a <b>").find("a &lt;b&gt;") != std::string::npos);
}

TEST_CASE("each fault of a model shows in its own figure") {
  SUBCASE("two rooms taken for one") {
    FittedFloor fitted = perfect();
    fitted.rooms.erase(fitted.rooms.begin());
    fitted.rooms[0].outline = box(0, 0, 6.2, 5);
    fitted.rooms[0].width_m = 6.2;
    const Evaluation evaluation = evaluate(fitted, true_rooms(), floor_file());
    CHECK(evaluation.rooms.size() == 3);
    CHECK(evaluation.rooms.back().id.empty());
    CHECK(evaluation.rooms.back().space == "S");
    CHECK_FALSE(evaluation.spaces[0].in_order);
    CHECK(evaluation.observed.worst_m == doctest::Approx(3.2));
    CHECK(evaluation.walls[0].completeness < 1);
    CHECK(evaluation.walls[0].correctness == doctest::Approx(1).epsilon(0.02));
    CHECK(evaluation.within_3_sigma == doctest::Approx(0.5));
  }
  SUBCASE("a wall 7 cm off: outside of 5 cm, inside of 10 cm") {
    FittedFloor fitted = perfect();
    fitted.rooms[0].outline = box(0, 0, 3.07, 5);
    fitted.rooms[0].width_m = 3.07;
    const Evaluation evaluation = evaluate(fitted, true_rooms(), floor_file());
    CHECK(evaluation.walls[0].completeness < 0.95);
    CHECK(evaluation.walls[1].completeness == 1);
    CHECK(evaluation.rooms[0].error_m() == doctest::Approx(0.07));
  }
  SUBCASE("a door in the wrong place, a window that is not there, a table called a chair") {
    FittedFloor fitted = perfect();
    fitted.rooms[0].openings[0].a.x() += 0.6;
    fitted.rooms[0].openings[0].b.x() += 0.6;
    fitted.rooms[1].openings.push_back({"window", Origin::observed, {4, 5}, {5, 5}, 0.9, 2.1, 1});
    fitted.rooms[2].furniture[0].type = "chair";
    const Evaluation evaluation = evaluate(fitted, true_rooms(), floor_file());
    CHECK(evaluation.observed_openings[0].recall() == doctest::Approx(2.0 / 3));
    CHECK(evaluation.observed_openings[1].precision() == 0);
    CHECK(evaluation.furniture_class_right == doctest::Approx(2.0 / 3));
    CHECK(evaluation.furniture.back().recall() == 1);
  }
  SUBCASE("a room that does not exist") {
    FittedFloor fitted = perfect();
    FittedRoom room = fitted.rooms[2];
    room.id = "ghost";
    room.outline = box(20, 0, 23, 5);
    fitted.rooms.push_back(room);
    const Evaluation evaluation = evaluate(fitted, true_rooms());
    CHECK(evaluation.rooms[3].true_id.empty());
    CHECK(evaluation.walls[0].correctness == doctest::Approx(0.75));
    CHECK(evaluation.openings[0].recall() == 1);
  }
}

TEST_CASE("rows to learn from fill their space exactly, with doors along the line") {
  const std::vector<KnownRow> rows = known_rows(floor_file(), true_rooms(), 0.2);
  REQUIRE(rows.size() == 1);
  CHECK(rows[0].whole);
  REQUIRE(rows[0].rooms.size() == 3);
  double sum = -0.2;
  for (const KnownRoom& room : rows[0].rooms) {
    sum += room.width_m + 0.2;
    REQUIRE(room.doors.size() == 1);
    CHECK(room.doors[0].start_m == doctest::Approx(1));
  }
  CHECK(sum == doctest::Approx(rows[0].length_m));
  FloorGroundTruth bare = floor_file();
  bare.spaces.clear();
  CHECK(known_rows(bare, true_rooms(), 0.2).size() == 1);
}

TEST_CASE("a hole in the truth parts a row") {
  FloorTruth truth = true_rooms();
  truth.rooms.erase(truth.rooms.begin() + 1);
  truth.openings.clear();
  truth.furniture.clear();
  const std::vector<KnownRow> rows = known_rows(floor_file(), truth, 0.2);
  REQUIRE(rows.size() == 2);
  CHECK_FALSE(rows[0].whole);
}

TEST_CASE("of a fitted floor only what was seen teaches") {
  const LearnData all = learn_data({floor_file()}, {true_rooms()});
  REQUIRE(all.rows.size() == 1);
  const std::string middle = all.rows[0].rooms[1].id, last = all.rows[0].rooms[2].id;
  const double wall_m = all.inner_wall_m;
  CHECK(learn_data({floor_file()}, {true_rooms()}, {{"elsewhere"}}).rows[0].whole);
  const LearnData parted = learn_data({floor_file()}, {true_rooms()}, {{middle}});
  REQUIRE(parted.rows.size() == 2);
  CHECK_FALSE(parted.rows[0].whole);
  CHECK(parted.rows[1].rooms[0].id == last);
  CHECK(parted.rows[1].length_m == doctest::Approx(all.rows[0].rooms[2].width_m));
  const LearnData cut = learn_data({floor_file()}, {true_rooms()}, {{last}});
  REQUIRE(cut.rows.size() == 1);
  CHECK_FALSE(cut.rows[0].whole);
  CHECK(cut.rows[0].length_m ==
        doctest::Approx(all.rows[0].rooms[0].width_m + wall_m + all.rows[0].rooms[1].width_m));
}

TEST_CASE("leaving one floor out needs two") {
  const LearnData data = learn_data({floor_file()}, {true_rooms()});
  CHECK_THROWS_AS(cross_validate(data, {}, [](const LearnedRules&) { return RuleSet(); }, {}), InputError);
}
