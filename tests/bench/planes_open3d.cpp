// Peer: Open3D's RANSAC for planes, the largest first, its inliers taken out. (Its detector of planar patches
// came after Debian 12's version 0.16.)
#include "tests/bench/planes.h"

#ifdef GRAMAP_BENCH_OPEN3D
#include <omp.h>
#include <open3d/geometry/PointCloud.h>
#include <open3d/utility/Random.h>

namespace gramap::bench {
namespace {

std::vector<FoundPlane> repeated_ransac(std::span<const Point> points) {
  omp_set_num_threads(1);
  open3d::utility::random::Seed(1);
  open3d::geometry::PointCloud cloud;
  cloud.points_.reserve(points.size());
  for (const Point& p : points) cloud.points_.push_back(p.cast<double>());
  const std::size_t least = points.size() / 100;
  std::vector<FoundPlane> planes;
  while (cloud.points_.size() > least && planes.size() < 30) {
    const auto [plane, inliers] = cloud.SegmentPlane(0.03, 3, 1000);
    if (inliers.size() < least) break;
    planes.push_back({plane.head<3>(), -plane[3]});
    cloud = *cloud.SelectByIndex(inliers, true);
  }
  return planes;
}

}  // namespace

std::vector<PlaneMethod> open3d_methods() {
  return {{"Open3D SegmentPlane, repeated", 200000, repeated_ransac}};
}

}  // namespace gramap::bench
#else
namespace gramap::bench {
std::vector<PlaneMethod> open3d_methods() {
  return {};
}
}  // namespace gramap::bench
#endif
