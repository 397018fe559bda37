// Floors whose truth is known, as the verbs `learn` and `evaluate` take them.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "floor/ground_truth.h"

namespace gramap {

struct KnownFloors {
  std::vector<FloorGroundTruth> floors;
  std::vector<FloorTruth> truths;
  std::vector<std::set<std::string>> unseen;  ///< by floor: rooms of a model that the rules made up
};

/// Reads a model that gramap wrote (its storeys), a floor folder with its truth, a GeoJSON file that holds
/// both, or an indoor plan (every level is a floor). `wall_m` is the thickness of inner walls that a plan
/// draws as lines. Appends to `known`. Throws InputError.
void read_known_floors(const std::string& path, double wall_m, KnownFloors& known);

/// Says on standard error what the readers put right and left out of a floor; true when they left anything
/// out.
bool report_on_reading(const FloorGroundTruth& floor);
bool report_on_reading(const KnownFloors& known);

}  // namespace gramap
