// Peers: CGAL's Efficient RANSAC (Schnabel, Wahl, Klein 2007) and Region Growing.
#include <CGAL/Shape_detection/Efficient_RANSAC.h>
#include <CGAL/Shape_detection/Region_growing/Region_growing.h>
#include <CGAL/Shape_detection/Region_growing/Region_growing_on_point_set.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/grid_simplify_point_set.h>
#include <CGAL/pca_estimate_normals.h>
#include <CGAL/property_map.h>

#include <utility>

#include "perception/plane_fit.h"
#include "tests/bench/planes.h"

namespace gramap::bench {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using PointWithNormal = std::pair<Kernel::Point_3, Kernel::Vector_3>;
using Cloud = std::vector<PointWithNormal>;
using PointMap = CGAL::First_of_pair_property_map<PointWithNormal>;
using NormalMap = CGAL::Second_of_pair_property_map<PointWithNormal>;

constexpr unsigned kNeighbours = 12;
constexpr double kEpsilon_m = 0.03, kSmallestShare = 0.01;

Cloud cloud_of(std::span<const Point> points) {
  Cloud cloud;
  cloud.reserve(points.size());
  for (const Point& p : points)
    cloud.emplace_back(
        Kernel::Point_3(static_cast<double>(p.x()), static_cast<double>(p.y()), static_cast<double>(p.z())),
        Kernel::Vector_3(0, 0, 0));
  return cloud;
}

void estimate_normals(Cloud& cloud) {
  CGAL::pca_estimate_normals<CGAL::Sequential_tag>(
      cloud, kNeighbours, CGAL::parameters::point_map(PointMap()).normal_map(NormalMap()));
}

template <class Indices>
FoundPlane least_squares(const Cloud& cloud, const Indices& inliers) {
  Moments moments;
  for (const std::size_t i : inliers)
    moments.add(Vec3(cloud[i].first.x(), cloud[i].first.y(), cloud[i].first.z()));
  const FittedPlane plane = fit_plane(moments);
  return {plane.normal, plane.rho_m};
}

std::vector<FoundPlane> efficient_ransac(std::span<const Point> points) {
  using Traits = CGAL::Shape_detection::Efficient_RANSAC_traits<Kernel, Cloud, PointMap, NormalMap>;
  using Ransac = CGAL::Shape_detection::Efficient_RANSAC<Traits>;
  Cloud cloud = cloud_of(points);
  cloud.erase(CGAL::grid_simplify_point_set(cloud, 0.05, CGAL::parameters::point_map(PointMap())),
              cloud.end());
  cloud.shrink_to_fit();
  estimate_normals(cloud);
  CGAL::get_default_random() = CGAL::Random(1);
  Ransac ransac;
  ransac.set_input(cloud);
  ransac.add_shape_factory<CGAL::Shape_detection::Plane<Traits>>();
  Ransac::Parameters parameters;
  parameters.probability = 0.01;
  parameters.min_points = static_cast<std::size_t>(kSmallestShare * static_cast<double>(cloud.size()));
  parameters.epsilon = kEpsilon_m;
  parameters.cluster_epsilon = 0.2;
  parameters.normal_threshold = 0.85;
  ransac.detect(parameters);
  std::vector<FoundPlane> planes;
  for (const auto& shape : ransac.shapes())
    planes.push_back(least_squares(cloud, shape->indices_of_assigned_points()));
  return planes;
}

std::vector<FoundPlane> region_growing(std::span<const Point> points) {
  namespace Detection = CGAL::Shape_detection;
  using Neighbours = Detection::Point_set::K_neighbor_query<Kernel, Cloud, PointMap>;
  using Region = Detection::Point_set::Least_squares_plane_fit_region<Kernel, Cloud, PointMap, NormalMap>;
  Cloud cloud = cloud_of(points);
  estimate_normals(cloud);
  Neighbours neighbours(cloud, kNeighbours, PointMap());
  Region region(cloud, kEpsilon_m, 25,
                static_cast<std::size_t>(kSmallestShare * static_cast<double>(cloud.size())), PointMap(),
                NormalMap());
  Detection::Region_growing<Cloud, Neighbours, Region> growing(cloud, neighbours, region);
  std::vector<std::vector<std::size_t>> regions;
  growing.detect(std::back_inserter(regions));
  std::vector<FoundPlane> planes;
  for (const std::vector<std::size_t>& inliers : regions) planes.push_back(least_squares(cloud, inliers));
  return planes;
}

}  // namespace

std::vector<PlaneMethod> cgal_methods() {
  return {{"5 cm voxels, CGAL Efficient RANSAC, least squares", 20000000, efficient_ransac},
          {"CGAL Region Growing", 200000, region_growing}};
}

}  // namespace gramap::bench
