// Whether the deviations that perception states are true: rooms of known size, simulated with one scan and
// with many, and how often the truth lies within two of the stated deviations.
//
// usage: bench_calibration [ROOMS_PER_KIND [KIND]]
// A box with an open door, a window and furniture, in a frame of its own. z is the error over its stated
// deviation: its root mean square should be 1, and 95 % of the extents should lie within 2.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "geometry/error.h"
#include "perception/perceive.h"
#include "perception/random_building.h"
#include "perception/training.h"

using namespace gramap;

namespace {

struct Kind {
  const char* name;
  double least_width_m, most_width_m, least_depth_m, most_depth_m;
  int positions;               ///< 0: as a person would take them
  double noise, registration;  ///< times the usual
  double furnished = 0.5;      ///< at most
};

constexpr Kind kKinds[] = {
    {"small room, 1 scan", 2.5, 4, 2.5, 4, 1, 1, 1},
    {"small room, 2 scans", 2.5, 4, 2.5, 4, 2, 1, 1},
    {"small room, 4 scans", 2.5, 4, 2.5, 4, 4, 1, 1},
    {"small room, 12 scans", 2.5, 4, 2.5, 4, 12, 1, 1},
    {"room, 2 scans", 4, 7, 4, 5, 2, 1, 1},
    {"room, 5 scans", 4, 7, 4, 5, 5, 1, 1},
    {"room, scans as usual", 4, 7, 4, 5, 0, 1, 1},
    {"room, noise x2", 4, 7, 4, 5, 0, 2, 1},
    {"room, no slips", 4, 7, 4, 5, 0, 1, 0},
    {"room, slips x3", 4, 7, 4, 5, 0, 1, 3},
    {"large room", 7, 10, 4, 6, 0, 1, 1},
    {"large room, noise x2", 7, 10, 4, 6, 0, 2, 1},
    {"hallway", 10, 20, 1.6, 2.4, 0, 1, 1, 0.1},
};

Polygon box(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

struct Tally {
  std::vector<double> errors_m, sigmas_m, z;
  void add(const Measured& measured, double truth_m) {
    errors_m.push_back(measured.value_m - truth_m);
    sigmas_m.push_back(measured.sigma_m);
    z.push_back(errors_m.back() / measured.sigma_m);
  }
  void add(const Tally& other) {
    errors_m.insert(errors_m.end(), other.errors_m.begin(), other.errors_m.end());
    sigmas_m.insert(sigmas_m.end(), other.sigmas_m.begin(), other.sigmas_m.end());
    z.insert(z.end(), other.z.begin(), other.z.end());
  }
};

double rms(const std::vector<double>& list) {
  double sum = 0;
  for (const double value : list) sum += value * value;
  return std::sqrt(sum / static_cast<double>(std::max<std::size_t>(1, list.size())));
}

void print_row(const char* name, const Tally& plan, const Tally& height) {
  const auto inside = [](const Tally& tally) {
    return 100.0 *
           static_cast<double>(
               std::count_if(tally.z.begin(), tally.z.end(), [](double z) { return std::abs(z) <= 2; })) /
           static_cast<double>(std::max<std::size_t>(1, tally.z.size()));
  };
  double worst = 0, sum = 0;
  for (const double z : plan.z) worst = std::max(worst, std::abs(z));
  for (const double error : plan.errors_m) sum += error;
  std::printf("| %-22s | %4zu | %5.1f | %5.1f | %5.1f | %5.2f | %5.1f | %5.1f | %5.1f | %5.1f | %5.1f |\n",
              name, plan.z.size(), 1e3 * sum / static_cast<double>(std::max<std::size_t>(1, plan.z.size())),
              1e3 * rms(plan.errors_m), 1e3 * rms(plan.sigmas_m), rms(plan.z), worst, inside(plan),
              1e3 * rms(height.errors_m), 1e3 * rms(height.sigmas_m), inside(height));
  std::fflush(stdout);
}

void run(const Kind& kind, int number, Tally& plan, Tally& height) {
  Random random(seed_for(static_cast<std::uint64_t>(number), kind.name));
  const double w = random.uniform(kind.least_width_m, kind.most_width_m),
               d = random.uniform(kind.least_depth_m, kind.most_depth_m), h = random.uniform(2.4, 3.2);
  BuildingRoom room{"room", box(0, 0, w, d), 0, h, {}, {}};
  BuildingRoom hallway{"hallway", box(-3, -2.2, w + 3, -0.2), 0, h, {}, {}};
  const double door = random.uniform(0.2, w - 1.2);
  room.openings.push_back({"door", {door, 0}, {door + 0.9, 0}, 0, 2.05});
  hallway.openings.push_back({"door", {door, -0.2}, {door + 0.9, -0.2}, 0, 2.05});
  room.openings.push_back({"window", {0.3 * w, d}, {0.7 * w, d}, 0.9, 2.2});
  furnish(room, kind.furnished * random.uniform(), random);
  SimulateOptions sensor;
  sensor.seed = random.next();
  sensor.positions = kind.positions;
  sensor.noise_m *= kind.noise;
  sensor.noise_growth_per_m *= kind.noise;
  sensor.registration_sd_m *= kind.registration;
  sensor.registration_sd_deg *= kind.registration;
  sensor.room_frame = true;
  PerceptionOptions options;
  options.find_openings = options.find_furniture = false;
  try {
    const RoomObservation seen =
        perceive(registered(simulate_rooms({{room, hallway}}, {0}, sensor)[0]), "room", options).observation;
    Measured width = seen.width, depth = seen.depth;
    if (std::abs(width.value_m - d) + std::abs(depth.value_m - w) <
        std::abs(width.value_m - w) + std::abs(depth.value_m - d))
      std::swap(width, depth);
    // A wall that is another one than the true one is no matter of deviations.
    if (std::abs(width.value_m - w) > 0.15 || std::abs(depth.value_m - d) > 0.15) return;
    plan.add(width, w);
    plan.add(depth, d);
    height.add(seen.height, h);
  } catch (const InputError&) {  // a room that is refused states nothing
  }
}

}  // namespace

int main(int argc, char** argv) {
  const int count = argc > 1 ? std::atoi(argv[1]) : 30;
  const std::string only = argc > 2 ? argv[2] : "";
  std::printf(
      "| rooms | extents | mean error mm | rms mm | stated mm | z | largest z | within 2 %% | height: error "
      "mm | stated mm | within 2 %% |\n"
      "| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n");
  Tally all_plan, all_height;
  for (const Kind& kind : kKinds) {
    if (!only.empty() && only != kind.name) continue;
    Tally plan, height;
    for (int number = 1; number <= count; ++number) run(kind, number, plan, height);
    print_row(kind.name, plan, height);
    all_plan.add(plan);
    all_height.add(height);
  }
  print_row("all", all_plan, all_height);
}
