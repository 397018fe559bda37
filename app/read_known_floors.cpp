#include "app/read_known_floors.h"

#include <cstdio>
#include <filesystem>

#include "floor/fitted_geojson.h"
#include "floor/read_indoor.h"
#include "floor/read_model.h"
#include "geometry/error.h"

namespace gramap {

namespace {

bool is_model(const std::filesystem::path& path) {
  return path.extension() == ".glb" || path.extension() == ".gltf";
}

/// The storeys of a fitted model: only what was seen teaches, for the derived rooms came from rules.
void add_model(const std::filesystem::path& path, KnownFloors& known) {
  for (const FittedFloor& storey : read_model(path).storeys) {
    FloorGroundTruth floor = storey.floor;
    if (floor.name.empty()) floor.name = path.stem().string();
    if (storey.inner_wall_m > 0) floor.inner_wall_m = storey.inner_wall_m;
    if (storey.outer_wall_m > 0) floor.outer_wall_m = storey.outer_wall_m;
    known.floors.push_back(std::move(floor));
    known.truths.push_back(truth_of(storey));
    std::set<std::string>& unseen = known.unseen.emplace_back();
    for (const FittedRoom& room : storey.rooms)
      if (room.origin == Origin::derived) unseen.insert(room.id);
  }
}

}  // namespace

void read_known_floors(const std::string& path, double wall_m, KnownFloors& known) {
  if (is_model(path)) return add_model(path, known);
  if (is_indoor_plan(path)) {
    IndoorOptions options;
    options.wall_m = wall_m;
    for (IndoorFloor& level : read_indoor(path, options)) {
      known.floors.push_back(std::move(level.floor));
      known.truths.push_back(std::move(level.truth));
      known.unseen.emplace_back();
    }
    return;
  }
  known.floors.push_back(read_floor(path));
  known.truths.push_back(read_truth(path, known.floors.back().origin));
  known.unseen.emplace_back();
  if (known.floors.back().name.empty())
    known.floors.back().name = std::filesystem::path(path).lexically_normal().stem().string();
  if (known.truths.back().rooms.empty())
    throw InputError({path}, "the floor has no rooms to learn from",
                     "give a folder with truth.geojson, or a file with features of the kind 'room'");
}

bool report_on_reading(const FloorGroundTruth& floor) {
  const char* const name = floor.name.c_str();
  for (const std::string& remark : floor.remarks)
    std::fprintf(stderr, "gramap: note: %s: %s\n", name, remark.c_str());
  for (const SetAsideInput& aside : floor.set_aside)
    std::fprintf(stderr, "gramap: warning: %s: %s was set aside: %s\n", name, aside.what.c_str(),
                 aside.reason.c_str());
  return !floor.set_aside.empty();
}

bool report_on_reading(const KnownFloors& known) {
  bool set_aside = false;
  for (const FloorGroundTruth& floor : known.floors) set_aside = report_on_reading(floor) || set_aside;
  return set_aside;
}

}  // namespace gramap
