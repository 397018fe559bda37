// Does following `gramap plan` need fewer scans? Starts with nothing scanned but the hallways (if any), scans
// a first room drawn by the seed and then room after room until every wall is known to the target, choosing
// the next one as the plan says, in order, or at random. Prints the three averages; progress on stderr.
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

/// What is scanned, and what is known by it.
class Walk {
 public:
  Walk(const RuleSet& rules, const std::vector<SpaceProblem>& bare, const Evidence& evidence, Choice choice,
       const ScanPlanOptions& options)
      : rules_(rules), problems_(bare), left_(evidence), choice_(choice), options_(options) {
    plans_.resize(problems_.size());
    for (std::size_t i = 0; i < problems_.size(); ++i) update(i);
  }

  /// How many scans it takes until all walls are within the target; the first room is drawn at random.
  int scans_needed(unsigned seed) {
    std::mt19937 random(seed);
    for (int scans = 0;; ++scans) {
      const ScanPlan plan = joined(plans_, options_);
      std::size_t remaining = 0;
      for (const auto& space : left_) remaining += space.size();
      if (plan.done || remaining == 0) return scans;
      if (scans == 0 || choice_ == Choice::random)
        scan_number(random() % remaining);
      else if (choice_ == Choice::order || !follow(plan))
        scan_number(0);
    }
  }

 private:
  void update(std::size_t space) {
    if (choice_ == Choice::plan)
      plans_[space] = plan_space(rules_, problems_[space], options_);
    else
      plans_[space].now = certainty(rules_, problems_[space], options_);
  }

  void scan(std::size_t space, std::size_t room) {
    problems_[space].rooms.push_back(left_[space][room]);
    left_[space].erase(left_[space].begin() + static_cast<std::ptrdiff_t>(room));
    update(space);
  }

  void scan_number(std::size_t number) {
    std::size_t space = 0;
    for (; number >= left_[space].size(); ++space) number -= left_[space].size();
    scan(space, number);
  }

  /// Whoever follows the advice opens the door there, and scans the room that is really behind it.
  bool follow(const ScanPlan& plan) {
    for (const ScanAdvice& advice : plan.rooms) {
      for (std::size_t space = 0; space < problems_.size(); ++space) {
        if (problems_[space].id != advice.space || left_[space].empty()) continue;
        const double middle = advice.start_m + advice.width_m / 2;
        const auto distance = [&](const RoomEvidence& room) { return std::abs(*room.centre_m - middle); };
        const auto nearest = std::min_element(
            left_[space].begin(), left_[space].end(),
            [&](const RoomEvidence& a, const RoomEvidence& b) { return distance(a) < distance(b); });
        scan(space, static_cast<std::size_t>(nearest - left_[space].begin()));
        return true;
      }
    }
    return false;
  }

  const RuleSet& rules_;
  std::vector<SpaceProblem> problems_;
  Evidence left_;
  Choice choice_;
  ScanPlanOptions options_;
  std::vector<ScanPlan> plans_;
};

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
      "| scans until all walls are within %.0f cm (1 sigma), average of %d first rooms | by plan | in order "
      "| "
      "at random |\n| --- | --- | --- | --- |\n",
      100 * options.target_sigma_m, seeds);
  for (const bool hallways : {false, true}) {
    std::vector<SpaceProblem> bare = full;
    for (SpaceProblem& problem : bare) {
      problem.rooms.clear();
      if (!hallways) problem.doors.clear(), problem.doors_visible.clear();
    }
    double scans[3] = {};
    for (int seed = 1; seed <= seeds; ++seed) {
      for (const Choice choice : {Choice::plan, Choice::order, Choice::random}) {
        const int needed =
            Walk(rules, bare, evidence, choice, options).scans_needed(static_cast<unsigned>(seed));
        scans[static_cast<int>(choice)] += needed;
        std::fprintf(stderr, "%d ", needed);
      }
      std::fprintf(stderr, "(seed %d of %d)\n", seed, seeds);
    }
    std::printf("| %s | %.1f | %.1f | %.1f |\n",
                hallways ? "hallways scanned before" : "nothing scanned before", scans[0] / seeds,
                scans[1] / seeds, scans[2] / seeds);
    std::fflush(stdout);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return test::bench_main("scan_order", [&] { return run(argc, argv); });
}
