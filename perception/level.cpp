#include "perception/level.h"

#include <Eigen/Dense>
#include <cmath>

namespace gramap {

double level(RegisteredCloud& cloud, std::vector<PlanePatch>& planes) {
  // Up is the direction that walls' normals are most across and level planes' normals most along.
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const PlanePatch& plane : planes) {
    const double slope = std::abs(plane.normal.z()), weight = plane.area_m2;
    if (slope < 0.1) spread += weight * plane.normal * plane.normal.transpose();
    if (slope > 0.995) spread -= weight * plane.normal * plane.normal.transpose();
  }
  if (spread.isZero()) return 0;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(spread);
  Vec3 up = solver.eigenvectors().col(0);
  if (up.z() < 0) up = -up;
  const double angle = std::acos(std::min(1.0, up.z()));
  // Less than a twentieth of a degree is beyond the planes' own accuracy and moves nothing by a millimetre.
  if (angle < 0.001 || angle > 0.09) return 0;
  const Eigen::Matrix3d turn = Eigen::Quaterniond::FromTwoVectors(up, Vec3::UnitZ()).toRotationMatrix();
  Vec3 middle = Vec3::Zero();
  for (const RegisteredCloud::Part& part : cloud.parts)
    middle += part.scanner_m / static_cast<double>(cloud.parts.size());
  const Vec3 shift = middle - turn * middle;
  const Eigen::Matrix3f turn_f = turn.cast<float>();
  const Point shift_f = shift.cast<float>();
  for (Point& point : cloud.points_m) point = turn_f * point + shift_f;
  for (RegisteredCloud::Part& part : cloud.parts) part.scanner_m = turn * part.scanner_m + shift;
  for (PlanePatch& plane : planes) {
    plane.normal = turn * plane.normal;
    plane.u = turn * plane.u;
    plane.v = turn * plane.v;
    plane.corner = turn * plane.corner + shift;
    plane.rho_m += plane.normal.dot(shift);
  }
  return angle;
}

}  // namespace gramap
