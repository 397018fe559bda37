#include "perception/openings.h"

#include <doctest/doctest.h>

#include <cmath>

#include "perception/models.h"
#include "perception/occupancy.h"
#include "perception/perceive.h"
#include "perception/training.h"
#include "perception/truth_match.h"

using namespace gramap;

namespace {

/// An office of 5 × 4 × 2.7 m: a door to a hallway in the south, two windows half a metre apart in the north.
Building office() {
  BuildingRoom room{"office", {{0, 0}, {5, 0}, {5, 4}, {0, 4}}, 0, 2.7, {}, {}};
  BuildingRoom hallway{"hallway", {{-2, -2.2}, {7, -2.2}, {7, -0.2}, {-2, -0.2}}, 0, 2.7, {}, {}};
  room.openings.push_back({"door", {0.6, 0}, {1.6, 0}, 0, 2.1});
  hallway.openings.push_back({"door", {0.6, -0.2}, {1.6, -0.2}, 0, 2.1});
  room.openings.push_back({"window", {1.2, 4}, {2.3, 4}, 0.9, 2.3});
  room.openings.push_back({"window", {2.8, 4}, {3.9, 4}, 0.9, 2.3});
  room.furniture.push_back({"other", {{4.4, 1}, {4.99, 1}, {4.99, 2.2}, {4.4, 2.2}}, 0, 2.1, false});
  return {{room, hallway}};
}

std::vector<OpeningObservation> found_in(const TrainingRoom& known) {
  return find_openings(known.cloud, known.room, shipped_openings_forest());
}

void check_all_found(const TrainingRoom& known) {
  const auto found = found_in(known), truth = true_openings(known.truth, known.room);
  for (const char* kind : {"door", "window"}) {
    const Score score = score_openings(found, truth, kind);
    CHECK(score.right == score.truth);
    CHECK(score.found == score.truth);
  }
}

}  // namespace

TEST_CASE("rays walk the voxels between two points in order") {
  const std::vector<Eigen::Vector3f> points = {
      {1.05F, 0.05F, 0.05F}, {2.05F, 0.05F, 0.05F}, {1.05F, 1.05F, 0.05F}};
  const BitGrid grid = occupied_voxels(points, {0, 0, 0}, {3, 3, 1}, 0.1);
  std::vector<double> hits;
  walk_ray(grid, {0.05, 0.05, 0.05}, {1, 0, 0}, 10, [&](double at) {
    hits.push_back(at);
    return false;
  });
  REQUIRE(hits.size() == 2);
  CHECK(hits[0] == doctest::Approx(0.95));
  CHECK(hits[1] == doctest::Approx(1.95));
  int diagonal = 0;
  walk_ray(grid, {0.05, 0.05, 0.05}, Vec3(1, 1, 0).normalized(), 10, [&](double) { return ++diagonal > 0; });
  CHECK(diagonal == 1);
}

TEST_CASE("a door and two windows side by side are found where they are") {
  const auto known = known_rooms(office(), {}, 0);
  check_all_found(known[0]);
  check_all_found(known[1]);
  for (const OpeningObservation& opening : found_in(known[0]))
    for (const OpeningObservation& truth : true_openings(known[0].truth, known[0].room))
      if (overlap(opening, truth) >= 0.5) {
        CHECK(std::abs(opening.start_m - truth.start_m) < 0.06);
        CHECK(std::abs(opening.width_m - truth.width_m) < 0.1);
        CHECK(std::abs(opening.sill_m - truth.sill_m) < 0.1);
        CHECK(std::abs(opening.head_m - truth.head_m) < 0.1);
      }
}

TEST_CASE("window frames do not hide windows") {
  SimulateOptions options;
  options.window_frame_m = 0.06;
  check_all_found(known_rooms(office(), options, 0)[0]);
}

TEST_CASE("a leaf half open does not hide its door from the hallway") {
  SimulateOptions options;
  options.doors_ajar_share = 1;
  check_all_found(known_rooms(office(), options, 0)[1]);
}

TEST_CASE("a room without openings has none, cupboard or not") {
  Building closed = office();
  for (BuildingRoom& room : closed.rooms) room.openings.clear();
  for (const TrainingRoom& known : known_rooms(closed, {}, 0)) CHECK(found_in(known).empty());
}

TEST_CASE("with all doors closed, only windows are found") {
  SimulateOptions options;
  options.doors_closed_share = 1;
  const auto found = found_in(known_rooms(office(), options, 0)[0]);
  CHECK(found.size() == 2);
  for (const OpeningObservation& opening : found) CHECK(opening.kind == "window");
}

TEST_CASE("a bare room with its door closed is perceived as one: nothing found is a result") {
  Building bare = office();
  bare.rooms[0].furniture.clear();
  std::erase_if(bare.rooms[0].openings, [](const BuildingOpening& one) { return one.kind == "window"; });
  SimulateOptions options;
  options.doors_closed_share = 1;
  const RoomObservation seen = perceive(known_rooms(bare, options, 0)[0].cloud, "bare").observation;
  CHECK(seen.walls.size() == 4);
  CHECK(seen.openings.empty());
  CHECK(seen.furniture.empty());
}

TEST_CASE("an empty cloud or no walls give nothing") {
  TrainingRoom known = known_rooms(office(), {}, 0)[0];
  known.cloud.points_m.clear();
  known.cloud.parts.clear();
  CHECK(found_in(known).empty());
  known.room.walls.clear();
  CHECK(found_in(known).empty());
}
