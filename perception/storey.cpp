#include "perception/storey.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "geometry/error.h"

namespace gramap {
namespace {

struct Level {
  double z_m, area_m2, band_m;
  std::size_t support;
};

}  // namespace

Storey find_storey(const std::vector<PlanePatch>& planes, const RegisteredCloud& cloud,
                   const std::string& room, const WallOptions& options) {
  Vec2 middle = Vec2::Zero();
  double lowest = 1e300, highest = -1e300;
  for (const RegisteredCloud::Part& part : cloud.parts) {
    middle += part.scanner_m.head<2>() / static_cast<double>(cloud.parts.size());
    lowest = std::min(lowest, part.scanner_m.z());
    highest = std::max(highest, part.scanner_m.z());
  }
  std::vector<Level> under, above;
  for (const PlanePatch& plane : planes) {
    if (1 - std::abs(plane.normal.z()) > options.vertical_epsilon * options.vertical_epsilon) continue;
    const double z = (plane.rho_m - plane.normal.head<2>().dot(middle)) / plane.normal.z();
    if (z < lowest - 0.1) under.push_back({z, plane.area_m2, plane.band_m, plane.support});
    if (z > highest + 0.1) above.push_back({z, plane.area_m2, plane.band_m, plane.support});
  }
  const auto fail = [&](const char* what, std::size_t candidates) {
    char text[200];
    std::snprintf(text, sizeof text, "no %s was found: of %zu planes, %zu lie level %s the scanners", what,
                  planes.size(), candidates, *what == 'f' ? "under" : "above");
    throw InputError({room}, text,
                     "scan the room's floor and ceiling too; if the scan's up is y, say --up y");
  };
  const auto outermost = [](const std::vector<Level>& levels, double sign) {
    const auto area = [](const Level& a, const Level& b) { return a.area_m2 < b.area_m2; };
    const double largest = std::max_element(levels.begin(), levels.end(), area)->area_m2;
    const Level* best = nullptr;
    for (const Level& level : levels)
      if (level.area_m2 >= 0.3 * largest && (!best || sign * level.z_m > sign * best->z_m)) best = &level;
    return *best;
  };
  if (under.empty()) fail("floor", under.size());
  if (above.empty()) fail("ceiling", above.size());
  const Level floor = outermost(under, -1), ceiling = outermost(above, 1);
  Storey storey;
  storey.floor_z_m = floor.z_m;
  storey.ceiling_z_m = ceiling.z_m;
  storey.floor_band_m = floor.band_m;
  storey.ceiling_band_m = ceiling.band_m;
  return storey;
}

}  // namespace gramap
