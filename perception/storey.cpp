#include "perception/storey.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <utility>

#include "geometry/error.h"
#include "geometry/say.h"

namespace gramap {
namespace {

struct Level {
  double z_m, area_m2, band_m;
  std::size_t support;
};

/// Lowest and highest place of a patch.
std::pair<double, double> heights(const PlanePatch& plane) {
  double low = 1e300, high = -1e300;
  for (int row = 0; row < plane.rows; ++row)
    for (int column = 0; column < plane.columns; ++column) {
      if (!plane.occupied[static_cast<std::size_t>(row) * static_cast<std::size_t>(plane.columns) +
                          static_cast<std::size_t>(column)])
        continue;
      const double z = (plane.corner + plane.cell_m * ((column + 0.5) * plane.u + (row + 0.5) * plane.v)).z();
      low = std::min(low, z);
      high = std::max(high, z);
    }
  return {low, high};
}

/// Where large planes over the scanners slope, the storey ends at their lowest place.
void end_at_slopes(Storey& storey, const std::vector<const PlanePatch*>& slopes,
                   std::vector<std::string>& remarks) {
  double low = 1e300, high = -1e300, steepest = 0;
  for (const PlanePatch* plane : slopes) {
    const auto [from, to] = heights(*plane);
    low = std::min(low, from);
    high = std::max(high, to);
    steepest = std::max(steepest, std::acos(std::min(1.0, std::abs(plane->normal.z()))));
  }
  storey.ceiling_z_m = std::max(low, storey.floor_z_m + 0.5);
  storey.ceiling_rise_m = std::max(high - storey.ceiling_z_m, 0.01);
  char text[200];
  std::snprintf(
      text, sizeof text,
      "the ceiling slopes by %.1f degrees, from %.2f m to %.2f m above the floor; the room is modelled "
      "with a level ceiling at its lowest place",
      steepest * 180 / std::numbers::pi, storey.height_m(), high - storey.floor_z_m);
  remarks.emplace_back(text);
}

}  // namespace

Storey find_storey(const std::vector<PlanePatch>& planes, const RegisteredCloud& cloud,
                   const std::string& room, const WallOptions& options, std::vector<std::string>& remarks) {
  Vec2 middle = Vec2::Zero();
  double lowest = 1e300, highest = -1e300;
  for (const RegisteredCloud::Part& part : cloud.parts) {
    middle += part.scanner_m.head<2>() / static_cast<double>(cloud.parts.size());
    lowest = std::min(lowest, part.scanner_m.z());
    highest = std::max(highest, part.scanner_m.z());
  }
  constexpr double kLeastSlope = 0.5;  // of |n_z|: steeper planes are walls that lean
  std::vector<Level> under, above;
  std::vector<const PlanePatch*> slopes;
  for (const PlanePatch& plane : planes) {
    if (std::abs(plane.normal.z()) < kLeastSlope) continue;
    if (const double over = (plane.rho_m - plane.normal.head<2>().dot(middle)) / plane.normal.z();
        1 - std::abs(plane.normal.z()) > options.vertical_epsilon * options.vertical_epsilon &&
        over > highest + 0.1)
      slopes.push_back(&plane);
    if (1 - std::abs(plane.normal.z()) > options.vertical_epsilon * options.vertical_epsilon) continue;
    const double z = (plane.rho_m - plane.normal.head<2>().dot(middle)) / plane.normal.z();
    if (z < lowest - 0.1) under.push_back({z, plane.area_m2, plane.band_m, plane.support});
    if (z > highest + 0.1) above.push_back({z, plane.area_m2, plane.band_m, plane.support});
  }
  const auto fail = [&](const char* what, std::size_t candidates) {
    char text[200];
    std::snprintf(text, sizeof text, "no %s was found: of %s, %zu lie level %s the scanners", what,
                  said_count(planes.size(), "plane").c_str(), candidates, *what == 'f' ? "under" : "above");
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
  const Level floor = outermost(under, -1);
  // Slopes are the ceiling where they are not small beside its largest plane (less than that is a beam, a
  // lamp), end over people's knees, and were seen nearly as densely as the floor: through stray points a
  // plane can be laid from floor to ceiling.
  constexpr double kLeastEaves_m = 0.7, kLeastDensityShare = 0.2;
  double largest = floor.area_m2 / 2;
  for (const Level& level : above) largest = std::max(largest, level.area_m2);
  for (const PlanePatch* plane : slopes) largest = std::max(largest, plane->area_m2);
  const double floor_density = static_cast<double>(floor.support) / floor.area_m2;
  std::erase_if(slopes, [&](const PlanePatch* plane) {
    return plane->area_m2 < 0.3 * largest || heights(*plane).first < floor.z_m + kLeastEaves_m ||
           static_cast<double>(plane->support) < kLeastDensityShare * floor_density * plane->area_m2;
  });
  if (above.empty() && slopes.empty()) fail("ceiling", above.size());
  Storey storey;
  storey.floor_z_m = floor.z_m;
  storey.floor_band_m = floor.band_m;
  if (!slopes.empty()) {
    end_at_slopes(storey, slopes, remarks);
    return storey;
  }
  const Level ceiling = outermost(above, 1);
  storey.ceiling_z_m = ceiling.z_m;
  storey.ceiling_band_m = ceiling.band_m;
  return storey;
}

}  // namespace gramap
