// Rooms outside of what the model knows: they come out as the nearest room of upright, straight walls under a
// level ceiling, and it is said.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "perception/perceive.h"
#include "tests/support/room_cloud.h"

using namespace gramap;

namespace {

const Polygon kBox = {{0, 0}, {5, 0}, {5, 4}, {0, 4}};
const Vec3 kScanner(2, 1.8, 1.4);

/// The room of a cloud, each point of which was moved.
template <class Move>
RoomObservation perceived(const test::RoomRecipe& recipe, Move move) {
  RoomScans scans = test::room_scan(recipe, Vec3::Zero());
  for (Point& p : scans.scans[0].points_m)
    p = move(p.cast<double>()).template cast<float>() - kScanner.cast<float>();
  scans.scans[0].room_from_scanner.translation() = kScanner;
  PerceptionOptions options;
  options.find_openings = options.find_furniture = false;
  return perceive_room(scans, options);
}

bool says(const RoomObservation& room, const std::string& words) {
  return std::any_of(room.remarks.begin(), room.remarks.end(),
                     [&](const std::string& remark) { return remark.find(words) != std::string::npos; });
}

}  // namespace

TEST_CASE("an ordinary room gets no remark about its shape") {
  CHECK(perceived({.ring = kBox, .points = 80000}, [](Vec3 p) { return p; }).remarks.empty());
}

TEST_CASE("a wall that leans stands where it is at mid-height, and that is said") {
  for (const double degrees : {-10.0, 10.0, 20.0}) {
    CAPTURE(degrees);
    const double slope = std::tan(degrees * std::numbers::pi / 180);
    const RoomObservation room = perceived({.ring = kBox, .points = 80000}, [&](Vec3 p) {
      p.x() += p.x() / 5 * slope * (p.z() - 1.35);
      return p;
    });
    CHECK(room.outline.size() == 4);
    CHECK(std::abs(room.width.value_m - 5) < 0.02);
    CHECK(std::abs(room.depth.value_m - 4) < 0.01);
    CHECK(says(room, "leans by "));
  }
}

TEST_CASE("a gable ceiling is level at its lowest place, and that is said") {
  const RoomObservation room = perceived({.ring = kBox, .points = 80000}, [](Vec3 p) {
    p.z() *= (2.4 + 0.5 * std::min(p.y(), 4 - p.y())) / 2.7;
    return p;
  });
  CHECK(room.outline.size() == 4);
  CHECK(std::abs(room.width.value_m - 5) < 0.01);
  CHECK(std::abs(room.depth.value_m - 4) < 0.01);
  CHECK(std::abs(room.height.value_m - 2.4) < 0.15);
  CHECK(room.height.sigma_m > 0.1);
  CHECK(says(room, "the ceiling slopes by 26."));
}

TEST_CASE("a round wall becomes straight ones, and that is said") {
  Polygon ring = {{0, 0}, {5, 0}, {5, 4}};
  for (int i = 1; i < 40; ++i) {  // half a circle of 2.5 m radius
    const double angle = std::numbers::pi * i / 40;
    ring.emplace_back(2.5 + 2.5 * std::cos(angle), 4 + 2.5 * std::sin(angle));
  }
  ring.emplace_back(0, 4);
  const RoomObservation room = perceived({.ring = ring, .points = 120000}, [](Vec3 p) { return p; });
  CHECK(signed_area(room.outline) == doctest::Approx(signed_area(ring)).epsilon(0.04));
  CHECK(says(room, "look like one round wall"));
}
