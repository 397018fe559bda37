#include "app/read_known_floors.h"

#include <filesystem>

#include "floor/read_indoor.h"
#include "geometry/error.h"

namespace gramap {

void read_known_floors(const std::string& path, double wall_m, KnownFloors& known) {
  if (is_indoor_plan(path)) {
    IndoorOptions options;
    options.wall_m = wall_m;
    for (IndoorFloor& level : read_indoor(path, options)) {
      known.floors.push_back(std::move(level.floor));
      known.truths.push_back(std::move(level.truth));
    }
    return;
  }
  known.floors.push_back(read_floor(path));
  known.truths.push_back(read_truth(path, known.floors.back().origin));
  if (known.floors.back().name.empty())
    known.floors.back().name = std::filesystem::path(path).lexically_normal().stem().string();
  if (known.truths.back().rooms.empty())
    throw InputError({path}, "the floor has no rooms to learn from",
                     "give a folder with truth.geojson, or a file with features of the kind 'room'");
}

}  // namespace gramap
