#include "app/fit_building.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <vector>

#include "app/verbs.h"
#include "floor/gltf.h"
#include "floor/room_table.h"
#include "floor/stack.h"
#include "floor/storeys.h"
#include "floor/verify.h"
#include "geometry/error.h"
#include "geometry/file.h"
#include "geometry/say.h"
#include "version.h"

namespace gramap {
namespace {

namespace fs = std::filesystem;

/// One floor of the building: fitted, or why not.
struct BuildingFloor {
  std::string folder;  ///< its name
  FitInputOptions inputs;
  std::optional<FittedFloor> fitted;
  std::optional<InputError> fault;
};

/// What of the building's options goes to one floor: `--without FLOOR/ROOM` to the floor of that name.
FitInputOptions inputs_of(const FitInputOptions& building, const fs::path& floor) {
  FitInputOptions inputs = building;
  inputs.floor = floor.string();
  inputs.quiet = true;  // floors side by side would write over each other's progress
  inputs.without.clear();
  const std::string prefix = floor.filename().string() + "/";
  for (const std::string& room : building.without)
    if (room.starts_with(prefix)) inputs.without.push_back(room.substr(prefix.size()));
  return inputs;
}

void refuse_options_of_one_floor(const FitInputOptions& options, const std::vector<fs::path>& floors) {
  if (!options.scans.empty())
    throw InputError({options.scans},
                     "--scans names one floor's scans, and " + options.floor + " is a building",
                     "put each floor's scans into its own folder, FLOOR/scans");
  for (const std::string& room : options.without)
    if (std::none_of(floors.begin(), floors.end(), [&](const fs::path& floor) {
          return room.starts_with(floor.filename().string() + "/");
        }))
      throw InputError({options.floor}, "--without '" + room + "' names no room of a floor of the building",
                       "write FLOOR/ROOM, with the name of the floor's folder");
}

void fit_storeys(std::vector<BuildingFloor>& storeys) {
  tbb::parallel_for(std::size_t{0}, storeys.size(), [&](std::size_t i) {
    BuildingFloor& storey = storeys[i];
    try {
      const FitInputs inputs = read_inputs(storey.inputs);
      FittedFloor fitted =
          fit_floor(inputs.floor, inputs.rules, inputs.problems, inputs.observations, storey.inputs.fit);
      fitted.set_aside.insert(fitted.set_aside.begin(), inputs.set_aside.begin(), inputs.set_aside.end());
      storey.fitted = std::move(fitted);
    } catch (const InputError& error) {
      storey.fault = error;
    }
  });
}

/// Storeys that can stand on one another, from the lowest to the highest; the others get their fault.
std::vector<BuildingFloor*> stacked(std::vector<BuildingFloor>& storeys) {
  std::vector<BuildingFloor*> order;
  for (BuildingFloor& storey : storeys)
    if (storey.fitted) order.push_back(&storey);
  std::stable_sort(order.begin(), order.end(), [](const BuildingFloor* a, const BuildingFloor* b) {
    return a->fitted->floor.elevation_m < b->fitted->floor.elevation_m;
  });
  std::vector<BuildingFloor*> standing;
  for (BuildingFloor* storey : order) {
    if (!standing.empty()) {
      const FittedFloor& below = *standing.back()->fitted;
      const double top = below.floor.elevation_m + below.height_m;
      if (storey->fitted->floor.elevation_m < top + 2 * BuildOptions().finish_m) {
        char text[200];
        std::snprintf(
            text, sizeof text,
            "it is at an elevation of %.2f m and leaves no slab above %s, which reaches up to %.2f m",
            storey->fitted->floor.elevation_m, standing.back()->folder.c_str(), top);
        storey->fault = InputError({storey->inputs.floor}, text, "give the floor file its \"elevation\"");
        continue;
      }
    }
    standing.push_back(storey);
  }
  return standing;
}

RunInfo run_info(const BuildingFitOptions& options, const std::vector<BuildingFloor*>& standing) {
  RunInfo info;
  info.version = GRAMAP_VERSION;
  info.rule_file = fs::path(options.inputs.rules).filename().string();
  info.options = itemised(options.inputs);
  info.options.emplace_back("alternatives", std::to_string(options.inputs.fit.space.alternatives));
  for (const BuildingFloor* storey : standing) {
    for (const auto& [name, hash] : input_hashes(storey->inputs))
      if (name != info.rule_file)
        info.input_hashes.emplace_back(storey->folder + "/" + name, hash);
      else if (storey == standing.front())
        info.input_hashes.emplace_back(name, hash);
    for (const FittedSpace& space : storey->fitted->spaces) info.score += space.score;
  }
  return info;
}

}  // namespace

int fit_building(const BuildingFitOptions& options) {
  const std::vector<fs::path> folders = floor_folders(options.inputs.floor);
  refuse_options_of_one_floor(options.inputs, folders);
  std::vector<BuildingFloor> storeys;
  for (const fs::path& folder : folders)
    storeys.push_back(
        {folder.filename().string(), inputs_of(options.inputs, folder), std::nullopt, std::nullopt});
  fit_storeys(storeys);
  const std::vector<BuildingFloor*> standing = stacked(storeys);
  if (standing.empty()) throw *storeys.front().fault;

  std::vector<SetAsideInput> set_aside;
  for (const BuildingFloor& storey : storeys) {
    if (storey.fault)
      set_aside.push_back(
          {"floor " + storey.folder, to_string(storey.fault->place) + ": " + storey.fault->what()});
    else
      for (const SetAsideInput& aside : storey.fitted->set_aside)
        set_aside.push_back({storey.folder + "/" + aside.what, aside.reason});
  }
  if (options.strict && !set_aside.empty())
    throw InputError({options.inputs.floor}, set_aside.front().what + ": " + set_aside.front().reason,
                     "leave --strict away to go on without it");

  std::vector<FloorGroundTruth> floors;
  std::vector<FittedFloor> fitted;
  for (const BuildingFloor* storey : standing) {
    floors.push_back(storey->fitted->floor);
    fitted.push_back(*storey->fitted);
  }
  for (const SetAsideInput& aside : set_aside)  // the model says so, too
    if (aside.what.starts_with("floor ")) fitted.front().set_aside.push_back(aside);

  FILE* const out = options.output == "-" ? stderr : stdout;
  const std::vector<FloorModel> models = build_storeys(fitted);
  for (std::size_t i = 0; i < models.size(); ++i) {
    const VerifyReport report = verify(models[i]);
    std::fprintf(out, "floor %s\n", standing[i]->folder.c_str());
    std::fputs(room_table(*standing[i]->fitted).c_str(), out);
    std::fputs(to_text(report).c_str(), out);
    if (report.ok()) continue;
    std::fprintf(
        stderr,
        "gramap: the model of floor %s did not pass verification, so %s was not written; please report "
        "this with the inputs\n",
        standing[i]->folder.c_str(), options.output.c_str());
    return kDefect;
  }
  for (const std::string& remark : check_cores(floors)) std::fprintf(out, "note: %s\n", remark.c_str());
  const RunInfo info = run_info(options, standing);
  write_file(options.output,
             options.output.ends_with(".gltf") ? to_gltf(models, info) : to_glb(models, info));
  for (const SetAsideInput& aside : set_aside)
    std::fprintf(stderr, "gramap: warning: %s was set aside: %s\n", aside.what.c_str(), aside.reason.c_str());
  if (!options.inputs.quiet)
    std::fprintf(stderr, "gramap: wrote %s, %s\n", options.output.c_str(),
                 said_count(models.size(), "floor").c_str());
  return set_aside.empty() ? kDone : kSetAside;
}

}  // namespace gramap
