#include "perception/range_noise.h"

#include <cmath>

namespace gramap {

RangeNoise learned_noise(const std::vector<PlanePatch>& planes, const RegisteredCloud& cloud) {
  constexpr std::size_t kPoints = 20000;  // enough for each bin's median
  RangeNoise noise(0.1);
  const std::size_t step = std::max<std::size_t>(1, cloud.points_m.size() / kPoints);
  for (const RegisteredCloud::Part& part : cloud.parts)
    for (std::size_t i = part.begin; i < part.end; i += step) {
      const Vec3 p = cloud.points_m[i].cast<double>(), ray = p - part.scanner_m;
      const double range = ray.norm();
      double nearest = 0.3, along = 0;
      for (const PlanePatch& plane : planes) {
        const double distance = std::abs(plane.distance(p));
        if (distance >= nearest || !plane.covers(p)) continue;
        const double slope = std::abs(plane.normal.dot(ray)) / range;
        nearest = distance;
        along = slope > 0.5 ? distance / slope : -1;
      }
      if (nearest < 0.3 && along >= 0) noise.add(range, along);
    }
  noise.learn();
  return noise;
}

}  // namespace gramap
