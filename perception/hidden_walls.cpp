#include "perception/hidden_walls.h"

#include <algorithm>
#include <cmath>

namespace gramap {
namespace {

constexpr std::size_t kPoints = 400000;  // of the cloud that are looked through
constexpr double kLeastWidthOverNoise = 25;

}  // namespace

std::vector<PlanePatch> find_hidden_walls(const std::vector<PlanePatch>& planes, const RegisteredCloud& cloud,
                                          const Storey& storey, const WallOptions& options,
                                          HoughOptions hough) {
  const float low =
      static_cast<float>(storey.ceiling_z_m - std::max(2 * options.top_band_m, 0.25 * storey.height_m()));
  const float high = static_cast<float>(storey.ceiling_z_m - 0.05);
  std::vector<const PlanePatch*> upright;
  for (const PlanePatch& plane : planes)
    if (std::abs(plane.normal.z()) <= options.vertical_epsilon) upright.push_back(&plane);
  // A known wall's points and the rim of their noise; its own patch may have gaps under the ceiling.
  const auto known = [&](const Vec3& p) {
    return std::any_of(upright.begin(), upright.end(), [&](const PlanePatch* plane) {
      const double along = plane->u.dot(p - plane->corner) / plane->cell_m;
      return along >= 0 && along <= plane->columns &&
             std::abs(plane->distance(p)) <= std::max(3 * plane->band_m, 0.08);
    });
  };
  std::vector<Point> rest;
  const std::size_t step = std::max<std::size_t>(1, cloud.points_m.size() / kPoints);
  for (std::size_t i = 0; i < cloud.points_m.size(); i += step) {
    const Point& p = cloud.points_m[i];
    if (p.z() > low && p.z() < high && !known(p.cast<double>())) rest.push_back(p);
  }
  hough.min_area_m2 = std::min(hough.min_area_m2, 0.08);
  hough.patch_cell_m = std::min(hough.patch_cell_m, 0.15);
  std::vector<PlanePatch> found = detect_planes(rest, hough);
  // A face not much wider than its noise is thick has no direction of its own: those are looked for in the
  // plan.
  std::erase_if(found, [&](const PlanePatch& plane) {
    return std::abs(plane.normal.z()) > options.vertical_epsilon ||
           (plane.columns - 2) * plane.cell_m < kLeastWidthOverNoise * plane.rms_m;
  });
  return found;
}

}  // namespace gramap
