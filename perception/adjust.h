// Scans and walls adjusted to one another.
//
// Every scan is a little off (a phone's tracking, a tripod's registration), so the same wall comes out at as
// many places as there are scans, and the plain mean of all points weights scans by how many points they
// happen to have on it. Here the planes of the room and a small rigid correction per scan are estimated
// together by least squares on the distances of points from planes (a bundle adjustment of planes). A scan
// that sees two opposite walls then no longer moves their distance, whatever its own error. How far scans are
// off is estimated too, and how far a scan's view of a plane is off as a whole beyond that, as variance
// components by expectation maximisation (Dempster, Laird, Rubin 1977), so that the deviations that come out
// can be trusted.
#pragma once

#include <Eigen/Dense>
#include <cstdint>
#include <vector>

#include "perception/scan.h"

namespace gramap {

/// A plane through `middle` across `normal`, with unit vectors `u` and `v` on it.
struct AdjustedPlane {
  Vec3 normal = Vec3::UnitZ();
  Vec3 middle = Vec3::Zero();
  Vec3 u = Vec3::UnitX(), v = Vec3::UnitY();
  double u_slope_sigma = 0.05;  ///< how far the plane may turn towards u, and towards v, in radians
  double v_slope_sigma = 0.003;
  // Results:
  double rms_m = 0;
  std::size_t support = 0;
};

/// A point of a scan on a plane.
struct PlanePoint {
  Vec3 point_m;
  double sigma_m = 0.01;   ///< noise of its distance from the plane
  std::uint32_t part = 0;  ///< the scan
  std::uint32_t plane = 0;
};

/// Distance of a point, moved by its scan's correction, from its plane.
inline double residual_m(const PlanePoint& point, const std::vector<AdjustedPlane>& planes,
                         const std::vector<Eigen::Isometry3d>& corrections) {
  const AdjustedPlane& plane = planes[point.plane];
  return plane.normal.dot(corrections[point.part] * point.point_m - plane.middle);
}

struct AdjustOptions {
  /// Error of one scan's view of one plane that more points do not lessen: what is known of it beforehand,
  /// and how many views that knowledge is worth beside those there are.
  double systematic_m = 0.001, systematic_worth = 4;
  double start_systematic_m = 0.001;  ///< first guess of it
  double start_shift_m = 0.01;        ///< first guess of how far scans are shifted …
  double start_turn_rad = 0.003;      ///< … and turned
};

struct Adjustment {
  std::vector<Eigen::Isometry3d> corrected_from_registered;  ///< per scan
  Eigen::MatrixXd covariance;  ///< of the planes' positions along their normals at `middle`, m²
  double shift_sigma_m = 0, turn_sigma_rad = 0;  ///< of the scans, as estimated
  double systematic_m = 0;                       ///< of a scan's view of a plane, as estimated
};

/// Moves the planes to their best places and says how each scan should move; points are not changed.
Adjustment adjust(std::vector<AdjustedPlane>& planes, const std::vector<PlanePoint>& points,
                  const std::vector<Vec3>& scanners, const AdjustOptions& options = {});

}  // namespace gramap
