// The fit of whole floors, from what was observed of their rooms to every room in its place: time and memory
// over the number of rooms, and whether one thread and two give the same. Every hallway has ten rooms on
// either side, a share of them scanned; hallways are scanned, too, and show the doors.
//
//   bench_floor_fit [MOST [SCANNED_SHARE]]     (10,000 rooms, 0.5)
#include <oneapi/tbb/global_control.h>
#include <sys/resource.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

#include "floor/fit_floor.h"
#include "grammar/language.h"

using namespace gramap;

namespace {

constexpr double kWall_m = 0.2, kDepth_m = 5, kHallway_m = 2, kDoor_m = 1;

constexpr const char* kRules = R"(grammar office;
wall inner 0.20 m, outer 0.30 m;
height 2.70 m;
room Cell   { width 2.80 m +- 0.05 m; door 1.00 x 2.10 m at 0.20 m +- 5 cm; }
room Double { width 5.80 m +- 0.05 m; door 1.00 x 2.10 m at 0.20 m +- 5 cm; }
room WC     { width 1.80 m +- 0.05 m; door 1.00 x 2.10 m at 0.20 m +- 5 cm; }
start Space;
background 1 % width 1.00 m .. 12.00 m;
cells: Space -> repeat 1..4 { Cell } Space : 50 %;
pair:  Space -> Double Space : 30 %;
wet:   Space -> WC Space : 20 %;
)";

Polygon rectangle(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

struct Floor {
  FloorGroundTruth given;
  std::vector<RoomObservation> observations;
};

RoomObservation observed(const std::string& name, const Polygon& outline) {
  RoomObservation seen;
  seen.room = name;
  seen.outline = outline;
  for (std::size_t i = 0; i < outline.size(); ++i)
    seen.walls.push_back({outline[i], outline[(i + 1) % outline.size()], 0.005, 1, 0.005, 1000});
  seen.height = {2.7, 0.01};
  seen.width = {outline[1].x() - outline[0].x(), 0.01};
  seen.depth = {outline[2].y() - outline[1].y(), 0.01};
  return seen;
}

/// Rooms on both sides of hallways that lie above one another.
Floor make_floor(int rooms, double scanned_share) {
  std::mt19937_64 random(1);
  const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  const auto normal = [&] {  // Box and Muller
    return std::sqrt(-2 * std::log(1 - uniform())) * std::cos(2 * M_PI * uniform());
  };
  Floor floor;
  floor.given.inner_wall_m = kWall_m;
  floor.given.ceiling_height_m = 2.7;
  const double pitch = 2 * kDepth_m + kHallway_m + 3 * kWall_m;
  for (int made = 0, row = 0; made < rooms; ++row) {
    const double low = row * pitch + kDepth_m + kWall_m, high = low + kHallway_m;
    const std::string hallway = "h" + std::to_string(row);
    double longest = 0;
    std::vector<OpeningObservation> doors;
    std::vector<std::pair<bool, double>> places;
    for (const bool above : {false, true}) {
      double x = 0;
      const double y0 = above ? high + kWall_m : low - kWall_m - kDepth_m;
      for (int i = 0; i < 10; ++i, ++made) {
        const double u = uniform();
        const double width = (u < 0.6 ? 2.8 : u < 0.8 ? 5.8 : 1.8) + 0.03 * normal();
        if (uniform() < scanned_share) {
          const double off = 0.1 * normal();
          floor.observations.push_back(
              observed("r" + std::to_string(made), rectangle(x + off, y0, x + width + off, y0 + kDepth_m)));
        }
        // From the line's start: the lines of the two sides run against each other.
        places.emplace_back(above, x + (above ? 0.2 : width - 0.2 - kDoor_m) + 0.02 * normal());
        x += width + kWall_m;
      }
      const double length = x - kWall_m;
      longest = std::max(longest, length);
      Space space{hallway + (above ? "n" : "s"), hallway, rectangle(0, y0, length, y0 + kDepth_m), {}, {}};
      space.start = above ? Vec2(0, y0) : Vec2(length, y0 + kDepth_m);
      space.end = above ? Vec2(length, y0) : Vec2(0, y0 + kDepth_m);
      floor.given.spaces.push_back(space);
    }
    const Polygon outline = rectangle(0, low, longest, high);
    floor.given.hallways.push_back({hallway, hallway, outline});
    RoomObservation seen = observed(hallway, outline);
    for (const auto& [above, start] : places) {
      const double from =
          above ? longest - start - kDoor_m : start;  // along the wall, the hallway on its left
      seen.openings.push_back({"door", above ? 2 : 0, from, kDoor_m, 0, 2.1, 1});
    }
    floor.observations.push_back(seen);
  }
  return floor;
}

/// Everything that the fit says, as text.
std::string said(const FittedFloor& fitted) {
  std::string text;
  for (const FittedRoom& room : fitted.rooms) {
    char line[256];
    std::snprintf(line, sizeof line, "%s %s %a %a %a %a %a %zu\n", room.id.c_str(), room.type.c_str(),
                  room.start_m, room.width_m, room.width_sigma_m, room.start_sigma_m, room.type_probability,
                  room.openings.size());
    text += line;
  }
  return text;
}

rusage used() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage;
}

double cpu_seconds() {
  const rusage usage = used();
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

struct Run {
  std::string text;
  double wall_s = 0, cpu_s = 0;
};

Run run(const Floor& floor, const RuleSet& rules, int threads) {
  const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism,
                                          static_cast<std::size_t>(threads));
  const double cpu = cpu_seconds();
  const auto start = std::chrono::steady_clock::now();
  std::vector<SetAsideInput> set_aside;
  const auto problems = space_problems(floor.given, rules, floor.observations, {}, set_aside);
  const FittedFloor fitted = fit_floor(floor.given, rules, problems, floor.observations);
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
  return {said(fitted), spent.count(), cpu_seconds() - cpu};
}

}  // namespace

int main(int argc, char** argv) {
  const int most = argc > 1 ? std::atoi(argv[1]) : 10000;
  const double share = argc > 2 ? std::atof(argv[2]) : 0.5;
  const CheckedRules checked = check_rules(kRules, "bench");
  if (!checked.rules) {
    std::fprintf(stderr, "bench_floor_fit: its rules have errors\n");
    return 1;
  }
  std::printf(
      "| rooms | seconds, 2 threads | CPU seconds | seconds, 1 thread | exponent | peak MB | the same |\n"
      "| --- | --- | --- | --- | --- | --- | --- |\n");
  double before = 0;
  bool all_same = true;
  for (int rooms = 100; rooms <= most; rooms *= 10) {
    const Floor floor = make_floor(rooms, share);
    const Run two = run(floor, *checked.rules, 2), one = run(floor, *checked.rules, 1);
    const bool same = one.text == two.text;
    all_same = all_same && same;
    std::printf("| %d | %.2f | %.2f | %.2f | ", rooms, two.wall_s, two.cpu_s, one.wall_s);
    if (before > 0)
      std::printf("%.2f", std::log10(one.cpu_s / before));
    else
      std::printf("-");
    std::printf(" | %.0f | %s |\n", static_cast<double>(used().ru_maxrss) / 1024, same ? "yes" : "NO");
    std::fflush(stdout);
    before = one.cpu_s;
  }
  return all_same ? 0 : 1;
}
