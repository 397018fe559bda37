// What all of perception takes, openings and furniture included, stage by stage: a furnished room, and a long
// hallway with doors on one side and windows on the other.
//
// usage: bench_perceive [POINTS [RUNS]]
// Times are processor seconds of all threads together, so that other work on the machine hardly counts: what
// one core would take. The least of RUNS runs is printed, and with it what was found.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <map>
#include <string>
#include <vector>

#include "perception/perceive.h"
#include "perception/random_building.h"
#include "perception/training.h"

using namespace gramap;

namespace {

constexpr double kWall_m = 0.2;

Polygon box(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

/// An office of 7 × 6 m with a door, three windows, tables, chairs and cupboards.
Building furnished_room() {
  BuildingRoom room{"office", box(0, 0, 7, 6), 0, 2.8, {}, {}};
  BuildingRoom hallway{"hallway", box(-3, -2.2, 10, -kWall_m), 0, 2.8, {}, {}};
  room.openings.push_back({"door", {0.6, 0}, {1.6, 0}, 0, 2.1});
  hallway.openings.push_back({"door", {0.6, -kWall_m}, {1.6, -kWall_m}, 0, 2.1});
  for (const double x : {0.8, 2.9, 5.0}) room.openings.push_back({"window", {x, 6}, {x + 1.3, 6}, 0.9, 2.4});
  Random random(7);
  furnish(room, 0.9, random);
  return {{room, hallway}};
}

/// Fifteen rooms on one side, fifteen windows on the other.
Building long_hallway() {
  constexpr int kRooms = 15;
  constexpr double kPitch_m = 2.8;
  BuildingRoom hallway{"hallway", box(0, 0, kRooms * kPitch_m, 2.4), 0, 2.8, {}, {}};
  std::vector<BuildingRoom> rooms;
  for (int i = 0; i < kRooms; ++i) {
    const double x = i * kPitch_m;
    hallway.openings.push_back({"door", {x + 0.8, 0}, {x + 1.8, 0}, 0, 2.1});
    hallway.openings.push_back({"window", {x + 0.7, 2.4}, {x + 2.0, 2.4}, 0.9, 2.4});
    BuildingRoom room{
        "room" + std::to_string(i), box(x, -4.2, x + kPitch_m - 0.15, -kWall_m), 0, 2.8, {}, {}};
    room.openings.push_back({"door", {x + 0.8, -kWall_m}, {x + 1.8, -kWall_m}, 0, 2.1});
    rooms.push_back(room);
  }
  rooms.insert(rooms.begin(), hallway);
  return {rooms};
}

void measure(const char* what, const Building& building, int points, int runs) {
  SimulateOptions options;
  options.points_per_room = points;
  const std::vector<SimulatedRoom> simulated = simulate_rooms(building, {0}, options);
  const RegisteredCloud cloud = registered(simulated[0]);
  double least = 1e9;
  std::vector<std::pair<std::string, double>> least_stages;
  RoomObservation seen;
  for (int run = 0; run < runs; ++run) {
    RegisteredCloud copy = cloud;
    std::vector<std::pair<std::string, double>> stages;
    std::clock_t from = std::clock();
    const std::clock_t start = from;
    PerceptionOptions perception;
    perception.on_stage = [&](const std::string& stage, double) {
      const std::clock_t now = std::clock();
      stages.emplace_back(stage, static_cast<double>(now - from) / CLOCKS_PER_SEC);
      from = now;
    };
    seen = perceive(std::move(copy), building.rooms[0].id, perception).observation;
    const double all = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    if (all < least) least = all, least_stages = stages;
  }
  std::printf("%s, %zu points: %.3f s\n", what, cloud.points_m.size(), least);
  for (const auto& [stage, seconds] : least_stages) std::printf("  %-12s %.3f s\n", stage.c_str(), seconds);
  std::printf("  found %zu of %zu doors and windows, %zu pieces of furniture of %td\n", seen.openings.size(),
              building.rooms[0].openings.size(), seen.furniture.size(),
              std::count_if(building.rooms[0].furniture.begin(), building.rooms[0].furniture.end(),
                            [](const BuildingFurniture& piece) { return piece.counts(); }));
}

}  // namespace

int main(int argc, char** argv) {
  const int points = argc > 1 ? std::atoi(argv[1]) : 1000000, runs = argc > 2 ? std::atoi(argv[2]) : 5;
  measure("furnished room", furnished_room(), points, runs);
  measure("hallway, 15 doors, 15 windows", long_hallway(), points, runs);
}
