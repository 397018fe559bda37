// What the benchmark of plane detection shares: clouds of known truth, and the methods that are compared.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "perception/scan.h"

namespace gramap::bench {

struct FoundPlane {
  Vec3 normal = Vec3::UnitZ();  ///< unit vector
  double rho_m = 0;             ///< normal · p = rho_m on the plane
};

struct PlaneMethod {
  std::string name;
  std::size_t most_points;  ///< it takes minutes beyond
  std::vector<FoundPlane> (*detect)(std::span<const Point> points);
};

/// CGAL's Efficient RANSAC on one point a 5 cm voxel and least squares on its inliers, and Region Growing on
/// all points.
std::vector<PlaneMethod> cgal_methods();
/// PCL's SACSegmentation, repeated on what is left; none when gramap was configured without PCL.
std::vector<PlaneMethod> pcl_methods();
/// Open3D's SegmentPlane, likewise; none when gramap was configured without Open3D.
std::vector<PlaneMethod> open3d_methods();

/// A cloud as the scan folder that 3DTK's `planes` reads: scan000.3d and scan000.pose.
void write_for_3dtk(const std::filesystem::path& folder, std::span<const Point> points);
/// The planes of the convex hulls plane000.3d, plane001.3d, … that it writes; none where there are none.
std::vector<FoundPlane> planes_of_3dtk(const std::filesystem::path& folder);

}  // namespace gramap::bench
