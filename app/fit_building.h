// `gramap fit` on a folder of floor folders: every floor by itself, then one building.
#pragma once

#include <string>

#include "app/fit_inputs.h"

namespace gramap {

struct BuildingFitOptions {
  FitInputOptions inputs;  ///< `floor` is the folder of the floor folders
  std::string output;
  bool strict = false;  ///< refuse to write anything when some input has to be set aside
};

/// Fits the floors in parallel, checks that their stairs and lifts stand on one another, and writes one
/// model. A floor that is at fault, or that does not fit on the one below, is set aside with its reason.
/// Returns what `main` returns. Throws InputError when no floor can be used.
int fit_building(const BuildingFitOptions& options);

}  // namespace gramap
