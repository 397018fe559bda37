#include "floor/stack.h"

#include <algorithm>
#include <cstdio>

#include "geometry/error.h"

namespace gramap {

std::vector<FloorModel> build_storeys(std::vector<FittedFloor> floors) {
  std::stable_sort(floors.begin(), floors.end(), [](const FittedFloor& a, const FittedFloor& b) {
    return a.floor.elevation_m < b.floor.elevation_m;
  });
  std::vector<FloorModel> storeys;
  for (const FittedFloor& floor : floors) {
    BuildOptions options;
    if (!storeys.empty()) {
      const FloorModel& below = storeys.back();
      options.slab_thickness_m = floor.floor.elevation_m - below.elevation_m - below.height_m;
      if (options.slab_thickness_m < 2 * BuildOptions().finish_m) {
        char text[240];
        std::snprintf(
            text, sizeof text,
            "storey '%s' at %.2f m leaves no slab above storey '%s', which reaches from %.2f m to %.2f m",
            floor.floor.name.c_str(), floor.floor.elevation_m, below.name.c_str(), below.elevation_m,
            below.elevation_m + below.height_m);
        throw InputError({}, text, "give each floor file its elevation, in metres");
      }
    }
    storeys.push_back(build_model(floor, options));
  }
  return storeys;
}

}  // namespace gramap
