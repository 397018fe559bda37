// The fit's time and memory over the number of rooms, for several kinds of evidence: rooms in spaces of ten,
// as floors have them, and in one long space. usage: bench_fit [LONGEST [MOST [KIND]]]
//   LONGEST: rooms of the one long space; MOST: rooms of the largest floor; KIND: the number of a single kind
#include <oneapi/tbb/parallel_for.h>
#include <sys/resource.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

#include "grammar/space.h"
#include "tests/grammar/rule_maker.h"

using namespace gramap;

namespace {

struct Kind {
  const char* name;
  double scanned;  // share of rooms
  bool doors;
};

/// A space of `count` rooms drawn from the office types.
SpaceProblem make_space(const RuleSet& rules, int count, const Kind& kind, std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform(0, 1);
  std::normal_distribution<double> normal;
  SpaceProblem problem;
  problem.depth_m = 5;
  double at = 0;
  for (int i = 0; i < count; ++i) {
    const double u = uniform(random);
    const RoomType& type = rules.rooms[u < 0.6 ? 0 : u < 0.8 ? 1 : 2];
    const double width = type.width.components[0].normal.mean_m + 0.05 * normal(random);
    if (uniform(random) < kind.scanned) {
      RoomEvidence e;
      e.id = std::to_string(i);
      e.width_m = width + 0.01 * normal(random);
      e.width_sigma_m = 0.01;
      e.centre_m = at + 0.5 * width + 0.02 * normal(random);
      e.centre_sigma_m = 0.02;
      problem.rooms.push_back(e);
    }
    if (kind.doors) problem.doors.push_back({at + 0.2 + 0.5 + 0.05 * normal(random), 0.03, 1.0});
    at += width + rules.inner_wall_m;
  }
  problem.length_m = at - rules.inner_wall_m;
  if (kind.doors) problem.doors_visible = {{0, problem.length_m}};
  return problem;
}

struct Spent {
  double wall_s = 0;
  double cpu_s = 0;
  std::size_t rooms = 0;
};

double cpu_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

double peak_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

Spent fit_all(const RuleSet& rules, const std::vector<SpaceProblem>& spaces) {
  std::vector<std::size_t> counts(spaces.size());
  const auto start = std::chrono::steady_clock::now();
  const double cpu = cpu_seconds();
  oneapi::tbb::parallel_for(std::size_t{0}, spaces.size(), [&](std::size_t i) {
    counts[i] = fit_space(rules, spaces[i]).best.rooms.size();
  });
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
  Spent result{spent.count(), cpu_seconds() - cpu, 0};
  for (const std::size_t count : counts) result.rooms += count;
  return result;
}

/// Fits ever more rooms, `shape` a space; prints a line each, with the exponent of the time in the rooms.
void print_ladder(const RuleSet& rules, const Kind& kind, const char* shape, int most, int rooms_a_space) {
  Spent before;
  int rooms_before = 0;
  for (int rooms = std::max(10, most / 100); rooms <= most; rooms *= 10) {
    const int each = rooms_a_space > 0 ? rooms_a_space : rooms;
    std::mt19937_64 random(1);
    std::vector<SpaceProblem> spaces;
    for (int i = 0; i < rooms / each; ++i) spaces.push_back(make_space(rules, each, kind, random));
    const Spent spent = fit_all(rules, spaces);
    std::string exponent = "-";
    if (rooms_before > 0) {
      char text[16];
      std::snprintf(text, sizeof text, "%.2f",
                    std::log(spent.cpu_s / before.cpu_s) / std::log(1.0 * rooms / rooms_before));
      exponent = text;
    }
    std::printf("| %s | %s | %d | %zu | %.2f | %.2f | %.0f | %s |\n", kind.name, shape, rooms, spent.rooms,
                spent.wall_s, spent.cpu_s, peak_mb(), exponent.c_str());
    std::fflush(stdout);
    before = spent;
    rooms_before = rooms;
  }
}

}  // namespace

int main(int argc, char** argv) {
  const int longest = argc > 1 ? std::atoi(argv[1]) : 1000;
  const int most = argc > 2 ? std::atoi(argv[2]) : 10000;
  const int only = argc > 3 ? std::atoi(argv[3]) : -1;
  RuleSet rules = gramap::test::office_rules();
  for (RoomType& type : rules.rooms) type.door = DoorHabit{1.0, 2.1, {{1, {0.2, 0.05}, false}}};
  const Kind kinds[] = {{"all scanned", 1, false},
                        {"half scanned, doors seen", 0.5, true},
                        {"half scanned", 0.5, false},
                        {"doors seen only", 0, true},
                        {"nothing seen", 0, false}};
  std::printf("| evidence | shape | rooms | fitted | seconds | CPU seconds | peak MB | exponent |\n");
  std::printf("| --- | --- | --- | --- | --- | --- | --- | --- |\n");
  for (int i = 0; i < 5; ++i) {
    if (only >= 0 && i != only) continue;
    print_ladder(rules, kinds[i], "spaces of ten", most, 10);
    print_ladder(rules, kinds[i], "one space", longest, 0);
  }
}
