#include "floor/storeys.h"

#include <algorithm>
#include <cstdio>
#include <limits>
#include <numeric>

#include "geometry/error.h"
#include "geometry/polygon.h"

namespace gramap {
namespace {

/// How far the one outline's corners lie from the other's border at most, both ways.
double apart(const Polygon& a, const Polygon& b) {
  double most = 0;
  for (const Vec2& point : a) most = std::max(most, distance_to_border(b, point));
  for (const Vec2& point : b) most = std::max(most, distance_to_border(a, point));
  return most;
}

/// The fixed room of a floor that stands where `room` does, if any.
const FixedRoom* counterpart(const FloorGroundTruth& floor, const FixedRoom& room) {
  for (const FixedRoom& other : floor.fixed)
    if (contains(other.outline, centroid(room.outline)) || contains(room.outline, centroid(other.outline)))
      return &other;
  return nullptr;
}

}  // namespace

std::vector<std::filesystem::path> floor_folders(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> floors;
  std::error_code error;
  if (std::filesystem::exists(folder / "floor.geojson", error)) return floors;
  for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error))
    if (std::filesystem::exists(entry->path() / "floor.geojson", error)) floors.push_back(entry->path());
  std::sort(floors.begin(), floors.end());
  return floors;
}

std::vector<std::size_t> storey_order(const std::vector<FloorGroundTruth>& floors) {
  std::vector<std::size_t> order(floors.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return floors[a].elevation_m < floors[b].elevation_m; });
  for (std::size_t i = 0; i + 1 < order.size(); ++i) {
    const FloorGroundTruth &low = floors[order[i]], &high = floors[order[i + 1]];
    if (low.elevation_m < high.elevation_m) continue;
    char text[64];
    std::snprintf(text, sizeof text, "%g m", low.elevation_m);
    throw InputError(
        {high.name},
        "the floors \"" + low.name + "\" and \"" + high.name + "\" are both at an elevation of " + text,
        "give each floor file of the building its own \"elevation\"");
  }
  return order;
}

std::vector<std::string> check_cores(const std::vector<FloorGroundTruth>& floors, double tolerance_m) {
  const std::vector<std::size_t> order = storey_order(floors);
  std::vector<std::string> remarks;
  for (std::size_t i = 0; i + 1 < order.size(); ++i) {
    const FloorGroundTruth &low = floors[order[i]], &high = floors[order[i + 1]];
    for (const FixedRoom& room : low.fixed) {
      const FixedRoom* above = counterpart(high, room);
      if (above) {
        const double distance = apart(room.outline, above->outline);
        if (distance <= tolerance_m) continue;
        char text[32];
        std::snprintf(text, sizeof text, "%.2f m", distance);
        remarks.push_back("fixed room " + room.id + " of " + low.name + " and " + above->id + " of " +
                          high.name + " above it do not stand on one another: their outlines are up to " +
                          text + " apart");
        continue;
      }
      for (std::size_t j = i + 2; j < order.size(); ++j)
        if (counterpart(floors[order[j]], room)) {
          remarks.push_back("fixed room " + room.id + " of " + low.name + " goes on in " +
                            floors[order[j]].name + ", but " + high.name + " between them has none there");
          break;
        }
    }
  }
  return remarks;
}

}  // namespace gramap
