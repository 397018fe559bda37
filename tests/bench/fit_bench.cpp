// How long the fit of 1,000 rooms takes: as 100 spaces of about ten rooms or as one long space, for several
// kinds of evidence. Prints a table; usage: bench_fit [rooms].
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

double seconds(const RuleSet& rules, const std::vector<SpaceProblem>& spaces, std::size_t& rooms) {
  std::vector<std::size_t> counts(spaces.size());
  const auto start = std::chrono::steady_clock::now();
  oneapi::tbb::parallel_for(std::size_t{0}, spaces.size(), [&](std::size_t i) {
    counts[i] = fit_space(rules, spaces[i]).best.rooms.size();
  });
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
  rooms = 0;
  for (const std::size_t count : counts) rooms += count;
  return spent.count();
}

}  // namespace

int main(int argc, char** argv) {
  const int rooms = argc > 1 ? std::atoi(argv[1]) : 1000;
  RuleSet rules = gramap::test::office_rules();
  for (RoomType& type : rules.rooms) type.door = DoorHabit{1.0, 2.1, {{1, {0.2, 0.05}, false}}};
  const Kind kinds[] = {{"all scanned", 1, false},
                        {"half scanned, doors seen", 0.5, true},
                        {"half scanned", 0.5, false},
                        {"doors seen only", 0, true},
                        {"nothing seen", 0, false}};
  std::printf("%-28s %8s %12s %12s %10s\n", "evidence", "rooms", "100 spaces", "one space", "fitted");
  for (const Kind& kind : kinds) {
    std::mt19937_64 random(1);
    std::vector<SpaceProblem> spaces;
    for (int i = 0; i < 100; ++i) spaces.push_back(make_space(rules, std::max(1, rooms / 100), kind, random));
    std::size_t fitted = 0;
    const double many = seconds(rules, spaces, fitted);
    std::size_t ignored = 0;
    const double one = seconds(rules, {make_space(rules, rooms, kind, random)}, ignored);
    std::printf("%-28s %8d %10.2f s %10.2f s %10zu\n", kind.name, rooms, many, one, fitted);
    std::fflush(stdout);
  }
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  std::printf("peak memory %.0f MB\n", static_cast<double>(usage.ru_maxrss) / 1024);
}
