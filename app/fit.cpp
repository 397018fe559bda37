#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/fit_building.h"
#include "app/fit_inputs.h"
#include "app/output_ending.h"
#include "app/verbs.h"
#include "floor/gltf.h"
#include "floor/model.h"
#include "floor/room_table.h"
#include "floor/storeys.h"
#include "floor/verify.h"
#include "geometry/error.h"
#include "geometry/file.h"
#include "version.h"

namespace gramap {
namespace {

struct Options {
  FitInputOptions inputs;
  std::string output;
  bool strict = false;
};

RunInfo run_info(const Options& options, const FittedFloor& fitted) {
  RunInfo info;
  info.version = GRAMAP_VERSION;
  info.rule_file = std::filesystem::path(options.inputs.rules).filename().string();
  info.options = itemised(options.inputs);
  info.options.emplace_back("alternatives", std::to_string(options.inputs.fit.space.alternatives));
  info.input_hashes = input_hashes(options.inputs);
  for (const FittedSpace& space : fitted.spaces) info.score += space.score;
  return info;
}

int run(const Options& options) {
  if (!options.inputs.floor.empty() && !floor_folders(options.inputs.floor).empty())
    return fit_building({options.inputs, options.output, options.strict});
  const FitInputs inputs = read_inputs(options.inputs);
  FittedFloor fitted =
      fit_floor(inputs.floor, inputs.rules, inputs.problems, inputs.observations, options.inputs.fit);
  fitted.set_aside.insert(fitted.set_aside.begin(), inputs.set_aside.begin(), inputs.set_aside.end());
  FloorModel model = build_model(fitted);
  std::vector<SetAsideInput>& set_aside = model.fitted.set_aside;
  set_aside.insert(set_aside.end(), model.set_aside.begin(), model.set_aside.end());
  if (options.strict && !set_aside.empty())
    throw InputError({options.inputs.floor}, set_aside.front().what + ": " + set_aside.front().reason,
                     "leave --strict away to go on without it");
  const VerifyReport report = verify(model);
  FILE* const out = options.output == "-" ? stderr : stdout;
  std::fputs(room_table(model.fitted).c_str(), out);
  std::fputs(to_text(report).c_str(), out);
  if (!report.ok()) {
    std::fprintf(stderr,
                 "gramap: the model did not pass verification, so %s was not written; please report this "
                 "with the inputs\n",
                 options.output.c_str());
    return kDefect;
  }
  if (fitted.likeness > 0 && !options.inputs.fit.likeness && !options.inputs.quiet)
    std::fprintf(
        stderr,
        "gramap: the scans show that the rooms of a space are as wide as one another, to %.0f %%, more "
        "so than the rules say: others are expected to be, too (--likeness 0: as the rules say)\n",
        100 * fitted.likeness);
  const RunInfo info = run_info(options, fitted);
  write_file(options.output,
             options.output.ends_with(".gltf") ? to_gltf({model}, info) : to_glb(model, info));
  for (const SetAsideInput& aside : set_aside)
    std::fprintf(stderr, "gramap: warning: %s was set aside: %s\n", aside.what.c_str(), aside.reason.c_str());
  if (!options.inputs.quiet) std::fprintf(stderr, "gramap: wrote %s\n", options.output.c_str());
  return set_aside.empty() ? kDone : kSetAside;
}

}  // namespace

Verb declare_fit(CLI::App& gramap) {
  auto options = std::make_shared<Options>();
  options->inputs.fit.space.alternatives = 2;  // so that `explain` can name a runner-up
  CLI::App* verb = gramap.add_subcommand(
      "fit",
      "Fit a floor: scans, rules and a floor file in, a complete glTF floor out; a folder of floor folders "
      "becomes one building");
  declare_inputs(*verb, options->inputs);
  verb->add_option("-o,--output", options->output,
                   "The model to write (.glb or .gltf); - for standard output, as .glb")
      ->required()
      ->check(ending_in({".glb", ".gltf", ""}));
  verb->add_option("--alternatives", options->inputs.fit.space.alternatives,
                   "How many next best layouts of each space to keep in the model")
      ->capture_default_str()
      ->check(CLI::NonNegativeNumber);
  verb->add_flag("--strict", options->strict, "Refuse to write anything when some input has to be set aside");
  return [options] { return naming_floor(options->inputs, [&options] { return run(*options); }); };
}

}  // namespace gramap
