// Least-squares planes from sums over points.
#pragma once

#include <Eigen/Dense>

#include "perception/scan.h"

namespace gramap {

/// Zeroth to second moments of weighted points. Points should lie near the origin (within a building's size).
struct Moments {
  double weight = 0;
  Vec3 sum = Vec3::Zero();
  Eigen::Matrix3d outer = Eigen::Matrix3d::Zero();

  void add(const Vec3& p, double w = 1) {
    weight += w;
    sum += w * p;
    outer.noalias() += (w * p) * p.transpose();
  }
  void add(const Moments& other) {
    weight += other.weight;
    sum += other.sum;
    outer += other.outer;
  }
};

struct FittedPlane {
  Vec3 normal = Vec3::UnitZ();
  double rho_m = 0;  ///< never negative
  double rms_m = 0;
};

/// The plane of least squared distances: through the centroid, across the direction of least spread.
inline FittedPlane fit_plane(const Moments& m) {
  const Vec3 centre = m.sum / m.weight;
  const Eigen::Matrix3d spread = m.outer / m.weight - centre * centre.transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(spread);
  FittedPlane plane;
  plane.normal = solver.eigenvectors().col(0);
  plane.rho_m = plane.normal.dot(centre);
  if (plane.rho_m < 0) {
    plane.normal = -plane.normal;
    plane.rho_m = -plane.rho_m;
  }
  plane.rms_m = std::sqrt(std::max(0.0, solver.eigenvalues()[0]));
  return plane;
}

}  // namespace gramap
