// Does following `gramap plan` need fewer scans? Starts with nothing scanned but the hallways (if any), scans
// room after room until every wall is known to the target, choosing the next one as the plan says, in order,
// or at random.
//
//   scan_order FLOOR_FOLDER RULES [SEEDS] [TARGET_CM]
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "floor/fit_floor.h"
#include "floor/scan_folder.h"
#include "floor/scan_plan.h"
#include "geometry/error.h"
#include "geometry/file.h"
#include "grammar/language.h"
#include "tests/support/bench_main.h"

using namespace gramap;

namespace {

/// The rooms of the floor, each as the evidence that its scan gives, by space.
using Evidence = std::vector<std::vector<RoomEvidence>>;

enum class Choice { plan, order, random };

/// How many scans it takes until all walls are within the target.
int scans_needed(const RuleSet& rules, const std::vector<SpaceProblem>& bare, const Evidence& evidence,
                 Choice choice, unsigned seed, const ScanPlanOptions& options) {
  std::mt19937 random(seed);
  std::vector<SpaceProblem> problems = bare;
  Evidence left = evidence;
  for (int scans = 0;; ++scans) {
    const ScanPlan plan = plan_scans(rules, problems, options);
    std::size_t remaining = 0;
    for (const auto& space : left) remaining += space.size();
    if (plan.done || remaining == 0) return scans;
    std::size_t space = 0, room = 0;
    if (choice == Choice::plan && !plan.rooms.empty()) {
      const ScanAdvice& advice = plan.rooms.front();
      for (std::size_t i = 0; i < problems.size(); ++i)
        if (problems[i].id == advice.space) space = i;
      // Whoever follows the advice opens the door there, and scans the room that is really behind it.
      const double middle = advice.start_m + advice.width_m / 2;
      double nearest = 1e9;
      for (std::size_t i = 0; i < left[space].size(); ++i) {
        const double distance = std::abs(*left[space][i].centre_m - middle);
        if (distance < nearest) nearest = distance, room = i;
      }
    }
    if (choice == Choice::random || left[space].empty()) {
      std::size_t pick = choice == Choice::random ? random() % remaining : 0;
      for (space = 0; pick >= left[space].size(); ++space) pick -= left[space].size();
      room = pick;
    } else if (choice == Choice::order) {
      for (space = 0; left[space].empty();) ++space;
      room = 0;
    }
    problems[space].rooms.push_back(left[space][room]);
    left[space].erase(left[space].begin() + static_cast<std::ptrdiff_t>(room));
  }
}

int run(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: scan_order FLOOR_FOLDER RULES [SEEDS] [TARGET_CM]\n");
    return 2;
  }
  const std::filesystem::path folder = argv[1];
  const int seeds = argc > 3 ? std::atoi(argv[3]) : 20;
  ScanPlanOptions options;
  if (argc > 4) options.target_sigma_m = std::atof(argv[4]) / 100;
  const CheckedRules checked = check_rules(read_file(argv[2]), argv[2]);
  if (!checked.rules) throw InputError({argv[2]}, "the rule file has errors", "see gramap check");
  const FloorGroundTruth floor = read_floor(folder);
  const RuleSet rules = rules_on_floor(*checked.rules, floor);
  std::vector<SetAsideInput> set_aside;
  const std::vector<SpaceProblem> full =
      space_problems(floor, *checked.rules, perceive_folder(folder / "scans").rooms, {}, set_aside);
  Evidence evidence;
  for (const SpaceProblem& problem : full) {
    evidence.push_back(problem.rooms);
    std::sort(evidence.back().begin(), evidence.back().end(),
              [](const RoomEvidence& a, const RoomEvidence& b) { return *a.centre_m < *b.centre_m; });
  }
  std::printf(
      "| scans until all walls are within %.0f cm (1 sigma) | by plan | in order | at random, %d seeds |\n| "
      "--- | --- | --- | --- |\n",
      100 * options.target_sigma_m, seeds);
  for (const bool hallways : {false, true}) {
    std::vector<SpaceProblem> bare = full;
    for (SpaceProblem& problem : bare) {
      problem.rooms.clear();
      if (!hallways) problem.doors.clear(), problem.doors_visible.clear();
    }
    double random = 0;
    for (int seed = 1; seed <= seeds; ++seed)
      random += scans_needed(rules, bare, evidence, Choice::random, static_cast<unsigned>(seed), options);
    std::printf("| %s | %d | %d | %.1f |\n", hallways ? "hallways scanned before" : "nothing scanned before",
                scans_needed(rules, bare, evidence, Choice::plan, 0, options),
                scans_needed(rules, bare, evidence, Choice::order, 0, options), random / seeds);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return test::bench_main("scan_order", [&] { return run(argc, argv); });
}
