// Peer: PCL's RANSAC for planes, the largest first, its inliers taken out.
#include "tests/bench/planes.h"

#ifdef GRAMAP_BENCH_PCL
#include <pcl/filters/extract_indices.h>
#include <pcl/segmentation/sac_segmentation.h>

namespace gramap::bench {
namespace {

std::vector<FoundPlane> repeated_ransac(std::span<const Point> points) {
  using Cloud = pcl::PointCloud<pcl::PointXYZ>;
  Cloud::Ptr cloud(new Cloud);
  cloud->reserve(points.size());
  for (const Point& p : points) cloud->push_back({p.x(), p.y(), p.z()});
  const std::size_t least = points.size() / 100;
  pcl::SACSegmentation<pcl::PointXYZ> segmentation;
  segmentation.setOptimizeCoefficients(true);
  segmentation.setModelType(pcl::SACMODEL_PLANE);
  segmentation.setMethodType(pcl::SAC_RANSAC);
  segmentation.setDistanceThreshold(0.03);
  segmentation.setMaxIterations(1000);
  std::vector<FoundPlane> planes;
  while (cloud->size() > least && planes.size() < 30) {
    pcl::PointIndices::Ptr inliers(new pcl::PointIndices);
    pcl::ModelCoefficients plane;
    segmentation.setInputCloud(cloud);
    segmentation.segment(*inliers, plane);
    if (inliers->indices.size() < least) break;
    planes.push_back({Vec3(static_cast<double>(plane.values[0]), static_cast<double>(plane.values[1]),
                           static_cast<double>(plane.values[2])),
                      -static_cast<double>(plane.values[3])});
    Cloud::Ptr rest(new Cloud);
    pcl::ExtractIndices<pcl::PointXYZ> extract;
    extract.setInputCloud(cloud);
    extract.setIndices(inliers);
    extract.setNegative(true);
    extract.filter(*rest);
    cloud = rest;
  }
  return planes;
}

}  // namespace

std::vector<PlaneMethod> pcl_methods() {
  return {{"PCL SACSegmentation, repeated", 200000, repeated_ransac}};
}

}  // namespace gramap::bench
#else
namespace gramap::bench {
std::vector<PlaneMethod> pcl_methods() {
  return {};
}
}  // namespace gramap::bench
#endif
