// `gramap export`: a floor whose rooms are known, written as a model.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include "app/verbs.h"
#include "floor/floor_of_truth.h"
#include "floor/gltf.h"
#include "floor/model.h"
#include "floor/verify.h"
#include "geometry/error.h"
#include "geometry/file.h"
#include "version.h"

namespace gramap {
namespace {

struct Options {
  std::string input;
  std::string output;
};

int run(const Options& options) {
  const FloorGroundTruth floor = read_floor(options.input);
  const FloorModel model = build_model(floor_of_truth(floor, read_truth(options.input, floor.origin)));
  const VerifyReport report = verify(model);
  std::fputs(to_text(report).c_str(), stderr);
  if (!report.ok()) return kDefect;
  RunInfo run;
  run.version = GRAMAP_VERSION;
  write_file(options.output, to_glb(model, run));
  return kDone;
}

}  // namespace

Verb declare_export(CLI::App& gramap) {
  auto options = std::make_shared<Options>();
  CLI::App* verb = gramap.add_subcommand("export", "Write a floor whose rooms are known as a model");
  verb->add_option("floor", options->input, "A floor folder with truth.geojson, or one file that holds both")
      ->required();
  verb->add_option("-o,--output", options->output, "The model to write (.glb)")->required();
  return [options] { return run(*options); };
}

}  // namespace gramap
