// `gramap export`: models and known floors in, other formats out; several floors become a building.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/output_ending.h"
#include "app/verbs.h"
#include "floor/fitted_geojson.h"
#include "floor/floor_of_truth.h"
#include "floor/gltf.h"
#include "floor/read_model.h"
#include "floor/stack.h"
#include "floor/svg.h"
#include "floor/verify.h"
#include "geometry/error.h"
#include "geometry/file.h"
#include "version.h"

namespace gramap {
namespace {

struct Options {
  std::vector<std::string> inputs;
  std::vector<std::string> outputs;
  GltfOptions gltf;
  SvgOptions svg;
  bool quiet = false;
};

std::string extension(const std::string& path) {
  return std::filesystem::path(path).extension().string();
}

std::vector<FittedFloor> read_floors(const std::vector<std::string>& inputs, RunInfo& run) {
  std::vector<FittedFloor> floors;
  for (const std::string& input : inputs) {
    if (extension(input) == ".glb" || extension(input) == ".gltf") {
      for (FittedFloor& storey : read_model(input).storeys) floors.push_back(std::move(storey));
    } else {
      const FloorGroundTruth floor = read_floor(input);
      floors.push_back(floor_of_truth(floor, read_truth(input, floor.origin)));
    }
    if (std::filesystem::is_regular_file(input))
      run.input_hashes.emplace_back(std::filesystem::path(input).filename().string(),
                                    hash_hex(read_file(input)));
  }
  return floors;
}

/// The models; a fault that names no file is in the input, when there is only one.
std::vector<FloorModel> built(std::vector<FittedFloor> floors, const Options& options) {
  try {
    return build_storeys(std::move(floors));
  } catch (const InputError& error) {
    if (!error.place.file.empty() || options.inputs.size() != 1) throw;
    throw InputError({options.inputs.front()}, error.what(), error.advice);
  }
}

std::string written(const std::string& output, const std::vector<FloorModel>& storeys, const RunInfo& run,
                    const Options& options) {
  const std::string type = extension(output);
  if (type == ".glb") return to_glb(storeys, run, options.gltf);
  if (type == ".gltf") return to_gltf(storeys, run, options.gltf);
  if (type == ".svg") return to_svg(storeys.front(), options.svg);
  return to_geojson(storeys.front().fitted);
}

int run(const Options& options) {
  const auto start = std::chrono::steady_clock::now();
  RunInfo info;
  info.version = GRAMAP_VERSION;
  const std::vector<FloorModel> storeys = built(read_floors(options.inputs, info), options);
  for (const std::string& output : options.outputs)
    if (storeys.size() > 1 && (extension(output) == ".svg" || extension(output) == ".geojson"))
      throw InputError({output}, "a plan is of one floor, and there are " + std::to_string(storeys.size()),
                       "export each floor by itself, or the building as .glb");
  bool set_aside = false;
  for (const FloorModel& storey : storeys) {
    const VerifyReport report = verify(storey);
    if (!options.quiet || !report.ok()) std::fputs(to_text(report).c_str(), stderr);
    if (!report.ok()) {
      std::fputs(
          "gramap: the model did not pass verification, so nothing was written; please report this with the "
          "inputs\n",
          stderr);
      return kDefect;
    }
    for (const SetAsideInput& aside : storey.set_aside) {
      std::fprintf(stderr, "gramap: warning: %s was set aside: %s\n", aside.what.c_str(),
                   aside.reason.c_str());
      set_aside = true;
    }
  }
  for (const std::string& output : options.outputs) {
    const std::string bytes = written(output, storeys, info, options);
    write_file(output, bytes);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (!options.quiet)
      std::fprintf(stderr, "gramap: wrote %s, %.1f kB, %.2f s\n", output.c_str(),
                   static_cast<double>(bytes.size()) / 1000, seconds);
  }
  return set_aside ? kSetAside : kDone;
}

}  // namespace

Verb declare_export(CLI::App& gramap) {
  auto options = std::make_shared<Options>();
  CLI::App* verb = gramap.add_subcommand("export",
                                         "Write models, or floors whose rooms are known, as .glb, .gltf, "
                                         ".svg or .geojson; several floors become a building");
  verb->add_option("inputs", options->inputs,
                   "Models (.glb, .gltf), floor folders with truth.geojson, or .geojson files that hold "
                   "floor and rooms")
      ->required();
  verb->add_option("-o,--output", options->outputs,
                   "What to write, by its ending; may be given several times")
      ->required()
      ->check(ending_in({".glb", ".gltf", ".svg", ".geojson"}));
  verb->add_flag(
      "--confidence", options->gltf.confidence_colours,
      "Colour the rooms' floors by the standard deviation of their widths, green 1 cm to red 50 cm");
  verb->add_flag("--volumes", options->gltf.room_volumes, "Add a closed volume to every room");
  verb->add_option("--scale", options->svg.scale, "The plan's scale: 100 is 1:100")
      ->capture_default_str()
      ->check(CLI::Range(10, 5000));
  verb->add_flag("-q,--quiet", options->quiet, "Say nothing but faults");
  return [options] { return run(*options); };
}

}  // namespace gramap
