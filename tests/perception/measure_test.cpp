// Measures and their stated deviations.
#include <doctest/doctest.h>

#include <cmath>

#include "perception/adjust.h"
#include "perception/perceive.h"
#include "perception/random.h"
#include "perception/training.h"

using namespace gramap;

namespace {

/// Two walls that face each other 4 m apart, floor and ceiling, seen by many scans without noise worth the
/// name; each scan sees each plane off by `systematic_m` as a whole.
struct FacingPlanes {
  std::vector<AdjustedPlane> planes;
  std::vector<PlanePoint> points;
  std::vector<Vec3> scanners;

  FacingPlanes(int scans, double systematic_m, std::uint64_t seed) {
    Random random(seed);
    const Vec3 normals[] = {Vec3::UnitZ(), Vec3::UnitZ(), Vec3::UnitX(), Vec3::UnitX(), Vec3::UnitY()};
    const Vec3 middles[] = {{2, 2, 0}, {2, 2, 3}, {0, 2, 1.5}, {4, 2, 1.5}, {2, 0, 1.5}};
    for (int k = 0; k < 5; ++k) {
      AdjustedPlane plane;
      plane.normal = normals[k];
      plane.middle = middles[k];
      plane.u = k < 2 ? Vec3::UnitX() : k < 4 ? Vec3::UnitY() : Vec3::UnitX();
      plane.v = k < 2 ? Vec3::UnitY() : Vec3::UnitZ();
      planes.push_back(plane);
    }
    for (int s = 0; s < scans; ++s) {
      scanners.emplace_back(random.uniform(1, 3), random.uniform(1, 3), 1.4);
      for (std::uint32_t k = 0; k < planes.size(); ++k) {
        const double off = systematic_m * random.normal();
        for (int i = 0; i < 200; ++i)
          points.push_back({planes[k].middle + random.uniform(-1, 1) * planes[k].u +
                                random.uniform(-1, 1) * planes[k].v +
                                (off + 0.002 * random.normal()) * planes[k].normal,
                            0.002, static_cast<std::uint32_t>(s), k});
      }
    }
  }
};

}  // namespace

TEST_CASE("how far views of a plane are off as a whole is learned from how they differ") {
  for (const double truth_m : {0.0, 0.003, 0.01}) {
    CAPTURE(truth_m);
    double estimate = 0, stated = 0, off = 0;
    constexpr int kRooms = 20;
    for (int seed = 1; seed <= kRooms; ++seed) {
      FacingPlanes room(12, truth_m, static_cast<std::uint64_t>(seed));
      AdjustOptions options;
      Adjustment adjusted;
      const std::vector<AdjustedPlane> start = room.planes;
      for (int round = 0; round < 4; ++round) {
        room.planes = start;
        adjusted = adjust(room.planes, room.points, room.scanners, options);
        options.start_shift_m = adjusted.shift_sigma_m;
        options.start_turn_rad = adjusted.turn_sigma_rad;
        options.start_systematic_m = adjusted.systematic_m;
      }
      estimate += adjusted.systematic_m / kRooms;
      const Eigen::MatrixXd& c = adjusted.covariance;
      stated += (c(2, 2) + c(3, 3) - 2 * c(2, 3)) / kRooms;
      off += std::pow(room.planes[3].middle.x() - room.planes[2].middle.x() - 4, 2) / kRooms;
    }
    CHECK(estimate < truth_m * 1.4 + 0.0005);
    CHECK(estimate > truth_m * 0.7);
    // The stated variance of the walls' distance is that of what comes out (χ² of 20: within a factor of 2).
    if (truth_m > 0) CHECK(off < 2 * stated);
    if (truth_m > 0) CHECK(off > 0.5 * stated);
  }
}

TEST_CASE("noise does not make rooms smaller") {
  // Points measured short have less noise at their range and stay within the walls' limits more often.
  BuildingRoom room{"room", {{0, 0}, {6, 0}, {6, 4.5}, {0, 4.5}}, 0, 2.8, {}, {}};
  double width = 0, depth = 0, height = 0;
  constexpr int kScans = 6;
  for (std::uint64_t seed = 1; seed <= kScans; ++seed) {
    SimulateOptions sensor;
    sensor.seed = seed;
    sensor.noise_m *= 2;
    sensor.noise_growth_per_m *= 2;
    sensor.drift_sd_m = sensor.drift_sd_deg = 0;
    PerceptionOptions options;
    options.find_openings = options.find_furniture = false;
    const RoomObservation seen =
        perceive(registered(simulate_rooms({{room}}, {0}, sensor)[0]), "room", options).observation;
    width += (seen.width.value_m - 6) / kScans;
    depth += (seen.depth.value_m - 4.5) / kScans;
    height += (seen.height.value_m - 2.8) / kScans;
  }
  CHECK(std::abs(width) < 0.0015);
  CHECK(std::abs(depth) < 0.001);
  CHECK(std::abs(height) < 0.0007);
}
