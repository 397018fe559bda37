// Several floors of one building: where they are, and whether they stand on one another.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "floor/ground_truth.h"

namespace gramap {

/// The floor folders in a building's folder (each with its floor.geojson), in the order of their names; empty
/// when `folder` is not a folder of floors.
std::vector<std::filesystem::path> floor_folders(const std::filesystem::path& folder);

/// Positions of the floors from the lowest to the highest. Throws InputError when two have the same
/// elevation.
std::vector<std::size_t> storey_order(const std::vector<FloorGroundTruth>& floors);

/// What does not stand on one another: a stair, lift or other fixed room that another floor has at the same
/// place with another extent (more than `tolerance_m`), or that one floor lacks although the floors below and
/// above have it. One sentence each.
std::vector<std::string> check_cores(const std::vector<FloorGroundTruth>& floors, double tolerance_m = 0.05);

}  // namespace gramap
