// Every figure of an evaluation against the one computed on paper; the computation is in judged_by_hand.h.
#include <doctest/doctest.h>

#include <cmath>

#include "floor/evaluate.h"
#include "tests/floor/judged_by_hand.h"

using namespace gramap;

namespace {

void check_detection(const DetectionScore& score, const char* kind, int matched, int truth, int model) {
  CAPTURE(kind);
  CHECK(score.kind == kind);
  CHECK(score.matched == matched);
  CHECK(score.truth == truth);
  CHECK(score.model == model);
}

}  // namespace

TEST_CASE("an evaluation says what one computes on paper") {
  const auto [floor, truth, fitted] = test::judged_by_hand();
  const Evaluation evaluation = evaluate(fitted, truth, floor);

  REQUIRE(evaluation.walls.size() == 2);
  CHECK(evaluation.walls[0].completeness == doctest::Approx(1896.0 / 3100));
  CHECK(evaluation.walls[0].correctness == doctest::Approx(1896.0 / 3200));
  CHECK(evaluation.walls[1].completeness == doctest::Approx(2400.0 / 3100));
  CHECK(evaluation.walls[1].correctness == doctest::Approx(2400.0 / 3200));
  CHECK(evaluation.wall_median_m == doctest::Approx(0.01));
  CHECK(evaluation.observed_walls[0].completeness == 1);
  CHECK(evaluation.observed_walls[0].correctness == 1);

  REQUIRE(evaluation.rooms.size() == 5);
  const double iou[] = {14.97 / 15.23, 14.7704 / 15.4296, 14.5708 / 15.0292};
  const double error_m[] = {0.04, 0.04, -0.08};
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(evaluation.rooms[i].iou == doctest::Approx(iou[i]));
    CHECK(evaluation.rooms[i].error_m() == doctest::Approx(error_m[i]));
  }
  CHECK(evaluation.rooms[3].id == "d");
  CHECK(evaluation.rooms[3].true_id.empty());
  CHECK(evaluation.rooms[4].true_id == "E");
  CHECK(evaluation.rooms[4].id.empty());

  CHECK(evaluation.extracted.count == 1);
  CHECK(evaluation.extracted.mean_abs_m == doctest::Approx(0.05));
  CHECK(evaluation.observed.count == 1);
  CHECK(evaluation.observed.mean_abs_m == doctest::Approx(0.04));
  CHECK(evaluation.derived.count == 2);
  CHECK(evaluation.derived.mean_abs_m == doctest::Approx(0.06));
  CHECK(evaluation.derived.median_abs_m == doctest::Approx(0.06));
  CHECK(evaluation.derived.rms_m == doctest::Approx(std::sqrt(0.004)));
  CHECK(evaluation.derived.worst_m == doctest::Approx(0.08));
  CHECK(evaluation.derived.within_2cm == 0);
  CHECK(evaluation.derived.within_10cm == doctest::Approx(1));

  CHECK(evaluation.within_1_sigma == doctest::Approx(1.0 / 3));
  CHECK(evaluation.within_2_sigma == doctest::Approx(2.0 / 3));
  CHECK(evaluation.within_3_sigma == doctest::Approx(1));
  const int count[] = {0, 1, 2, 1}, right[] = {0, 1, 0, 1};
  const double mean[] = {0, 0.6, 0.875, 0.97};
  REQUIRE(evaluation.reliability.size() == 4);
  for (std::size_t i = 0; i < 4; ++i) {
    CHECK(evaluation.reliability[i].count == count[i]);
    CHECK(evaluation.reliability[i].right == right[i]);
    CHECK(evaluation.reliability[i].mean_probability == doctest::Approx(mean[i]));
  }

  check_detection(evaluation.openings[0], "door", 2, 4, 3);
  check_detection(evaluation.openings[1], "window", 1, 1, 2);
  check_detection(evaluation.observed_openings[0], "door", 1, 1, 1);
  check_detection(evaluation.observed_openings[1], "window", 1, 1, 2);
  CHECK(evaluation.openings[0].recall() == doctest::Approx(0.5));
  CHECK(evaluation.openings[0].precision() == doctest::Approx(2.0 / 3));
  REQUIRE(evaluation.furniture.size() == 4);
  check_detection(evaluation.furniture[0], "chair", 0, 1, 0);
  check_detection(evaluation.furniture[1], "cupboard", 0, 0, 1);
  check_detection(evaluation.furniture[2], "table", 1, 1, 1);
  check_detection(evaluation.furniture[3], "all", 2, 2, 2);
  CHECK(evaluation.furniture_class_right == doctest::Approx(0.5));

  REQUIRE(evaluation.spaces.size() == 2);  // the space, and none, for what lies in no space
  CHECK(evaluation.spaces[0].id == "S");
  CHECK(evaluation.spaces[0].rooms == 4);
  CHECK(evaluation.spaces[0].true_rooms == 3);
  CHECK_FALSE(evaluation.spaces[0].in_order);
}
