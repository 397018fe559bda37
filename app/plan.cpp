#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>

#include "app/fit_inputs.h"
#include "app/verbs.h"
#include "floor/fit_floor.h"
#include "floor/scan_plan.h"

namespace gramap {
namespace {

struct Options {
  FitInputOptions inputs;
  ScanPlanOptions plan;
  double target_cm = 5;
  int rooms = 5;
};

int run(Options options) {
  const FitInputs inputs = read_inputs(options.inputs);
  options.plan.target_sigma_m = options.target_cm / 100;
  const RuleSet rules = rules_on_floor(inputs.rules, inputs.floor);
  options.plan.fit = space_options(rules, inputs.problems, options.inputs.fit);
  const ScanPlan plan = plan_scans(rules, inputs.problems, options.plan);
  std::printf("uncertainty %.2f, least certain wall ± %.1f cm\n", plan.now.uncertainty,
              100 * plan.now.worst_sigma_m);
  if (plan.done) {
    std::printf("done: all walls are within %.1f cm (1 sigma); no scan is needed\n", options.target_cm);
    return kDone;
  }
  std::printf("scan next, the most telling room first:\n");
  const std::size_t count = std::min(plan.rooms.size(), static_cast<std::size_t>(options.rooms));
  for (std::size_t i = 0; i < count; ++i) {
    const ScanAdvice& advice = plan.rooms[i];
    std::printf(
        "%2zu. space %s, room %d: %s, %.2f m to %.2f m along its reference line, walls ± %.1f cm, expected "
        "gain %.2f\n",
        i + 1, advice.space.c_str(), advice.room + 1, advice.type.c_str(), advice.start_m,
        advice.start_m + advice.width_m, 100 * advice.wall_sigma_m, advice.gain);
  }
  return inputs.set_aside.empty() ? kDone : kSetAside;
}

}  // namespace

Verb declare_plan(CLI::App& gramap) {
  auto options = std::make_shared<Options>();
  CLI::App* verb =
      gramap.add_subcommand("plan", "Say where to scan next: the rooms whose scan would tell most");
  declare_inputs(*verb, options->inputs);
  verb->add_option("--target", options->target_cm,
                   "Done when every wall is known this well, centimetres (1 sigma)")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  verb->add_option("-n,--rooms", options->rooms, "How many rooms to name")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  return [options] { return naming_floor(options->inputs, [&options] { return run(*options); }); };
}

}  // namespace gramap
