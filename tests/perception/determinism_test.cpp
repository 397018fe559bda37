// Same scans, same seed: the same bytes, with one thread or two, twice in a row.
#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include "perception/perceive.h"
#include "perception/random_building.h"

using namespace gramap;

namespace {

RoomScans scans_of(const SimulatedRoom& room) {
  RoomScans scans;
  scans.room = "room";
  for (const SimulatedScan& from : room.scans) {
    Scan scan;
    scan.room_from_scanner = from.frame_from_scanner;
    for (const Vec3& p : from.points) scan.points_m.push_back(p.cast<float>());
    scans.scans.push_back(std::move(scan));
  }
  return scans;
}

}  // namespace

TEST_CASE("perception says the same with one thread and with two") {
  const Building building = random_building(4, 2);
  SimulateOptions sensor;
  sensor.points_per_room = 90000;  // over one chunk of the pass over all points
  const SimulatedRoom simulated = simulate_rooms(building, {1}, sensor)[0];
  const auto perceived = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return to_json(perceive_room(scans_of(simulated)));
  };
  const std::string one = perceived(1);
  CHECK(one == perceived(2));
  CHECK(one == perceived(1));
  CHECK(one.size() > 500);
}
