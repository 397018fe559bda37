// What a fit works on, for the verbs that fit: a floor with its scans, or reference line segments with their
// widths; and the rules.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "floor/fit_floor.h"
#include "floor/rls_floor.h"
#include "perception/perceive.h"

namespace CLI {
class App;
}

namespace gramap {

struct FitInputOptions {
  std::string floor, rules, scans, rls, rls_rules;
  std::vector<std::string> without;
  FloorFitOptions fit;
  PerceptionOptions perception;
  RlsOptions rls_options;
  std::uint64_t hallway_seed = 1;
  bool drawn_rooms = false;
  bool quiet = false;
};

/// Declares the options on a verb.
void declare_inputs(CLI::App& verb, FitInputOptions& options);

/// The inputs, read and perceived.
struct FitInputs {
  RuleSet rules;
  FloorGroundTruth floor;
  std::vector<RoomObservation> observations;  ///< none from reference line segments
  std::vector<SpaceProblem> problems;         ///< one a space
  std::vector<SetAsideInput> set_aside;
};

/// Throws InputError for what is at fault; single rooms that cannot be used are set aside.
FitInputs read_inputs(const FitInputOptions& options);

/// Runs a verb; a fault of the input that names no file gets the floor's.
int naming_floor(const FitInputOptions& options, const std::function<int()>& verb);

/// The options as given and the hashes of the input files, so that a model says how it was made.
std::vector<std::pair<std::string, std::string>> itemised(const FitInputOptions& options);
std::vector<std::pair<std::string, std::string>> input_hashes(const FitInputOptions& options);

}  // namespace gramap
