#include "app/fit_inputs.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <map>

#include "app/progress.h"
#include "app/rules_file.h"
#include "floor/complete_floor.h"
#include "floor/drawn_rooms.h"
#include "floor/ground_truth.h"
#include "floor/scan_folder.h"
#include "floor/spaces.h"
#include "geometry/error.h"
#include "geometry/file.h"

namespace gramap {
namespace {

namespace fs = std::filesystem;

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

fs::path floor_file(const FitInputOptions& options) {
  return fs::is_directory(options.floor) ? fs::path(options.floor) / "floor.geojson"
                                         : fs::path(options.floor);
}

/// Given, or the folder beside the floor file when the floor is a folder.
fs::path scans_folder(const FitInputOptions& options) {
  fs::path beside = fs::path(options.floor) / "scans";
  if (!options.scans.empty() || !fs::is_directory(beside)) return options.scans;
  return beside;
}

/// Scans to perceive; otherwise only what an earlier run perceived.
bool holds_folders(const fs::path& folder) {
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
    if (entry->is_directory(error)) return true;
  return false;
}

}  // namespace

void declare_inputs(CLI::App& verb, FitInputOptions& options) {
  auto* floor = verb.add_option(
      "floor", options.floor,
      "Floor file (floor.geojson), or a floor folder that may also hold scans/; for fit also a "
      "folder of floor folders");
  verb.add_option("-r,--rules", options.rules, "Rule file")->required();
  auto* scans = verb.add_option(
      "-s,--scans", options.scans,
      "Folder with a folder of scans for each room, or the ROOM.json that `gramap perceive` made of "
      "it [FLOOR/scans when the floor is a folder]");
  auto* drawn_rooms =
      verb.add_flag("--drawn-rooms", options.drawn_rooms,
                    "Take the rooms that the floor file draws as if they had been scanned: a fitted floor's "
                    "GeoJSON (gramap export) "
                    "comes back as it was");
  auto* without =
      verb.add_option("--without", options.without, "Rooms whose scans to leave out, separated by commas")
          ->delimiter(',');
  const std::map<std::string, ScanFrame> frames{
      {"auto", ScanFrame::automatic}, {"building", ScanFrame::building}, {"room", ScanFrame::room}};
  auto* frame =
      verb.add_option("--frame", options.fit.placement.frame,
                      "Frame of the poses: building, room (of its own, placed by pins), or auto: room where "
                      "there is a pin")
          ->transform(CLI::CheckedTransformer(frames, CLI::ignore_case))
          ->default_str("auto");
  auto* pose_sigma =
      verb.add_option("--pose-sigma", options.fit.placement.pose_sigma_m,
                      "How far a room's poses may be off in the building's frame, metres (1 sigma)")
          ->capture_default_str()
          ->check(CLI::PositiveNumber);
  verb.add_option("--outlier-share", options.fit.space.outlier_share,
                  "Prior share of scanned rooms whose width is wrong")
      ->capture_default_str()
      ->check(CLI::Range(1e-9, 0.9));
  verb.add_option(
          "--likeness", options.fit.likeness,
          "How alike the rooms of a space are: standard deviation of their widths, as a share of them. "
          "Rooms are then expected to be as wide as those scanned in their space and, where the floor's "
          "scans show that, on their floor; 0: as the rules say "
          "[what the scans of the floor show]")
      ->check(CLI::Range(0.0, 1.0));
  verb.add_flag("--least-error", options.fit.space.least_error,
                "Instead of the most probable layout take the one whose room widths are expected to be least "
                "wrong: better where most rooms are not scanned and the rules leave much open");
  auto* rls =
      verb.add_option("--rls", options.rls, "Instead of a floor and scans: reference line segments (CSV)")
          ->excludes(floor);
  auto* rls_rules = verb.add_option("--rules-csv", options.rls_rules,
                                    "With --rls: the widths extracted along the segments (CSV)");
  rls->needs(rls_rules);
  rls_rules->needs(rls);
  verb.add_option("--rls-sigma", options.rls_options.width_sigma_m,
                  "With --rls: standard deviation of an extracted width, metres")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  auto* hallway_seed = verb.add_option("--hallway-seed", options.hallway_seed,
                                       "With a floor that gives neither hallways nor spaces: the same seed "
                                       "grows the same hallways from "
                                       "the rules")
                           ->capture_default_str();
  // What says how a floor and its scans are read means nothing to segments.
  for (CLI::Option* option : {scans, drawn_rooms, without, frame, pose_sigma, hallway_seed})
    rls->excludes(option);
  verb.add_flag("-q,--quiet", options.quiet, "No progress");
}

FitInputs read_inputs(const FitInputOptions& options) {
  if (options.floor.empty() && options.rls.empty())
    throw CLI::RequiredError("a floor (or --rls with --rules-csv)");
  FitInputs inputs;
  inputs.rules = read_rules(options.rules);
  if (!options.rls.empty()) {
    RlsFloor ring = rls_floor(options.rls, options.rls_rules, inputs.rules, options.rls_options);
    inputs.floor = std::move(ring.floor);
    inputs.problems = std::move(ring.problems);
    return inputs;
  }
  inputs.floor = read_floor(options.floor);
  check_floor(inputs.floor, options.floor);
  const RuleSet here = rules_on_floor(inputs.rules, inputs.floor);
  for (const std::string& sentence : complete_floor(inputs.floor, here, options.hallway_seed))
    if (!options.quiet) std::fprintf(stderr, "gramap: %s\n", sentence.c_str());
  const fs::path scans = scans_folder(options);
  if (!scans.empty()) {
    Progress progress(holds_folders(scans) ? "perceiving rooms" : "reading observations", options.quiet);
    PerceivedFolder perceived =
        perceive_folder(scans, options.without, options.perception,
                        [&](const std::string& room, std::size_t rooms) { progress.step(room, rooms); });
    if (perceived.rooms.empty() && !perceived.set_aside.empty()) {
      std::string all;
      for (const SetAsideInput& aside : perceived.set_aside) all += "\n  " + aside.what + ": " + aside.reason;
      throw InputError(
          {scans.string()}, "none of the scanned rooms can be used:" + all,
          "mend at least one room, or fit the floor file alone to derive the floor from its rules");
    }
    inputs.observations = std::move(perceived.rooms);
    inputs.set_aside = std::move(perceived.set_aside);
  }
  inputs.set_aside.insert(inputs.set_aside.begin(), inputs.floor.set_aside.begin(),
                          inputs.floor.set_aside.end());
  inputs.problems =
      space_problems(inputs.floor, inputs.rules, inputs.observations, options.fit, inputs.set_aside);
  if (options.drawn_rooms) {
    const FloorTruth drawn = read_truth(floor_file(options));
    if (drawn.rooms.empty())
      throw InputError({floor_file(options).string()},
                       "no rooms are drawn here, but --drawn-rooms asks for them",
                       "leave --drawn-rooms out, or give a floor file with features of kind 'room'");
    observe_drawn_rooms(inputs.floor, drawn, inputs.rules, inputs.problems);
  }
  return inputs;
}

int naming_floor(const FitInputOptions& options, const std::function<int()>& verb) {
  try {
    return verb();
  } catch (const InputError& error) {
    if (!error.place.file.empty()) throw;
    throw InputError({options.rls.empty() ? floor_file(options).string() : options.rls}, error.what(),
                     error.advice);
  }
}

std::vector<std::pair<std::string, std::string>> itemised(const FitInputOptions& options) {
  std::vector<std::pair<std::string, std::string>> items;
  items.emplace_back("outlier-share", number(options.fit.space.outlier_share));
  items.emplace_back("likeness", options.fit.likeness ? number(*options.fit.likeness) : "as the scans show");
  items.emplace_back("least-error", options.fit.space.least_error ? "true" : "false");
  if (!options.rls.empty()) {
    items.emplace_back("rls-sigma", number(options.rls_options.width_sigma_m));
    return items;
  }
  std::string without;
  for (const std::string& room : options.without) without += (without.empty() ? "" : ",") + room;
  if (!without.empty()) items.emplace_back("without", without);
  const char* frames[] = {"auto", "building", "room"};
  items.emplace_back("frame", frames[static_cast<int>(options.fit.placement.frame)]);
  items.emplace_back("pose-sigma", number(options.fit.placement.pose_sigma_m));
  items.emplace_back("drawn-rooms", options.drawn_rooms ? "true" : "false");
  items.emplace_back("hallway-seed", std::to_string(options.hallway_seed));
  return items;
}

std::vector<std::pair<std::string, std::string>> input_hashes(const FitInputOptions& options) {
  std::vector<fs::path> files{options.rules};
  if (options.rls.empty())
    files.push_back(floor_file(options));
  else
    files.insert(files.end(), {options.rls, options.rls_rules});
  std::vector<std::pair<std::string, std::string>> hashes;
  for (const fs::path& file : files) hashes.emplace_back(file.filename().string(), hash_hex(read_file(file)));
  return hashes;
}

}  // namespace gramap
