// Plans that others have drawn, read as floors with their truth: OpenStreetMap's simple indoor tagging (one
// GeoJSON file) and IMDF, the Indoor Mapping Data Format (a folder or zip archive of unit.geojson,
// level.geojson, opening.geojson). Both are WGS84 and know no spaces and mostly no walls: rooms that abut are
// drawn in by half a wall each, spaces are the rows of rooms along the hallways, stairs and lifts are fixed
// rooms.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "floor/geojson.h"
#include "floor/ground_truth.h"

namespace gramap {

struct IndoorFloor {
  FloorGroundTruth floor;
  FloorTruth truth;
};

struct IndoorOptions {
  double wall_m = 0.2;        ///< thickness given to inner walls that the plan draws as lines
  double door_width_m = 0.9;  ///< of doors that are points without a `width`
  double door_height_m = 2.1;
  double storey_height_m = 2.7;  ///< clear height, where nothing is said of it
};

/// True for a folder or zip archive with unit.geojson, and for a file whose features have `indoor` tags or an
/// IMDF feature_type and no kind of ours.
bool is_indoor_plan(const std::filesystem::path& path);

/// Every level of the plan as a floor, lowest first. A path that ends in "#LEVEL" means that level only.
/// Throws InputError, also when there is no hallway on a level.
std::vector<IndoorFloor> read_indoor(const std::filesystem::path& path, const IndoorOptions& options = {});

/// The one level of the plan that `path` means. Throws InputError when there are several.
IndoorFloor only_level(const std::filesystem::path& path, const IndoorOptions& options = {});

}  // namespace gramap
