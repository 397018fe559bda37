#include "perception/simulate.h"

#include <doctest/doctest.h>

#include <cmath>

#include "perception/scan.h"

using namespace gramap;

namespace {

/// A room of 4 × 3 × 2.5 m with a door of 1 m to the north into a second room, a window to the south, a
/// table.
Building two_rooms() {
  BuildingRoom south{"south", {{0, 0}, {4, 0}, {4, 3}, {0, 3}}, 0, 2.5, {}, {}};
  BuildingRoom north{"north", {{0, 3.2}, {4, 3.2}, {4, 6}, {0, 6}}, 0, 2.5, {}, {}};
  south.openings.push_back({"door", {1, 3}, {2, 3}, 0, 2.1});
  north.openings.push_back({"door", {1, 3.2}, {2, 3.2}, 0, 2.1});
  south.openings.push_back({"window", {1, 0}, {2.2, 0}, 0.9, 2.2});
  south.furniture.push_back({"table", {{3, 1}, {3.9, 1}, {3.9, 2.5}, {3, 2.5}}, 0, 0.75});
  return {{south, north}};
}

SimulateOptions exact() {
  SimulateOptions options;
  options.noise_m = options.noise_growth_per_m = options.stray_share = 0;
  options.registration_sd_m = options.registration_sd_deg = 0;
  options.drift_sd_m = options.drift_sd_deg = 0;
  options.points_per_room = 20000;
  return options;
}

template <typename Predicate>
int count(const SimulatedRoom& room, Predicate predicate) {
  int n = 0;
  for (const SimulatedScan& scan : room.scans)
    for (const Vec3& p : scan.points) n += predicate(Vec3(scan.frame_from_scanner * p));
  return n;
}

}  // namespace

TEST_CASE("without errors every point lies on a surface, and openings let the rays out") {
  const SimulatedRoom room = simulate_rooms(two_rooms(), {0}, exact())[0];
  const int all = count(room, [](const Vec3&) { return true; });
  CHECK(all >= 20000);
  CHECK(all < 20000 + 12);
  CHECK(count(room, [](const Vec3& p) { return std::abs(p.z()) < 1e-9; }) > 1000);
  CHECK(count(room, [](const Vec3& p) { return std::abs(p.z() - 0.75) < 1e-9; }) > 200);
  CHECK(count(room, [](const Vec3& p) { return std::abs(p.y() - 3) < 1e-9 && p.x() > 2.01; }) > 500);
  // Nothing on the pane or the open leaf; something of the room behind; nothing outside of the building.
  CHECK(count(room, [](const Vec3& p) {
          return std::abs(p.y() - 3) < 1e-9 && p.x() > 1.01 && p.x() < 1.99 && p.z() > 0.01 && p.z() < 2.09;
        }) == 0);
  CHECK(count(room, [](const Vec3& p) { return p.y() > 3.3; }) > 50);
  CHECK(count(room, [](const Vec3& p) { return p.y() < -0.3001; }) == 0);
  CHECK(count(room, [](const Vec3& p) { return p.y() < -0.01; }) > 50);  // the reveal of the window
}

TEST_CASE("closed doors close, from both sides") {
  SimulateOptions options = exact();
  options.doors_closed_share = 1;
  const auto rooms = simulate_rooms(two_rooms(), {0, 1}, options);
  CHECK(count(rooms[0], [](const Vec3& p) { return p.y() > 3.1; }) == 0);
  CHECK(count(rooms[1], [](const Vec3& p) { return p.y() < 3.04; }) == 0);
}

TEST_CASE("noise, stray points and drift are as large as asked for") {
  SimulateOptions options = exact();
  options.noise_m = 0.01;
  const SimulatedRoom noisy = simulate_rooms(two_rooms(), {1}, options)[0];
  double squares = 0;
  int n = 0;
  for (const SimulatedScan& scan : noisy.scans)
    for (const Vec3& local : scan.points) {
      const Vec3 p = scan.frame_from_scanner * local;
      if (p.z() > 0.1) continue;  // floor points: their error along the ray, tilted by the ray's elevation
      const double slope = local.normalized().z();
      squares += p.z() * p.z() / (slope * slope), ++n;
    }
  CHECK(std::sqrt(squares / n) == doctest::Approx(0.01).epsilon(0.3));

  options = exact();
  options.drift_sd_m = 0.5;
  const SimulatedRoom drifted = simulate_rooms(two_rooms(), {1}, options)[0];
  CHECK(count(drifted, [](const Vec3& p) { return std::abs(p.z()) < 1e-9; }) > 1000);  // rigid: still level
  CHECK(count(drifted, [](const Vec3& p) { return std::abs(p.y() - 6) < 1e-9; }) == 0);
}

TEST_CASE("a room's scans are the same bytes again, alone or with others") {
  SimulateOptions options;
  options.points_per_room = 2000;
  options.doors_ajar_share = 1;
  const auto both = simulate_rooms(two_rooms(), {0, 1}, options);
  const auto one = simulate_rooms(two_rooms(), {1}, options);
  REQUIRE(one[0].scans.size() == both[1].scans.size());
  for (std::size_t i = 0; i < one[0].scans.size(); ++i) {
    CHECK(xyz_text(one[0].scans[i].points, 3) == xyz_text(both[1].scans[i].points, 3));
    CHECK(pose_to_text(one[0].scans[i].frame_from_scanner) ==
          pose_to_text(both[1].scans[i].frame_from_scanner));
  }
  options.seed = 2;
  CHECK(xyz_text(simulate_rooms(two_rooms(), {1}, options)[0].scans[0].points, 3) !=
        xyz_text(one[0].scans[0].points, 3));
}
