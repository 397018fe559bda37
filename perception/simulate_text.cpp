// Simulated scans as the text files of 3DTK's convention.
#include <charconv>
#include <cmath>
#include <cstdio>

#include "perception/simulate.h"

namespace gramap {

std::string xyz_text(const std::vector<Vec3>& points, int decimals) {
  std::string text;
  text.reserve(points.size() * 24);
  char digits[64];
  for (const Vec3& p : points)
    for (int axis = 0; axis < 3; ++axis) {
      const auto end =
          std::to_chars(digits, digits + sizeof digits, p[axis], std::chars_format::fixed, decimals);
      text.append(digits, end.ptr);
      text.push_back(axis < 2 ? ' ' : '\n');
    }
  return text;
}

std::string pose_text(const Eigen::Isometry3d& frame_from_scanner) {
  Eigen::Matrix3d left_from_right;  // p_l = (−y, z, x)
  left_from_right << 0, -1, 0, 0, 0, 1, 1, 0, 0;
  const Eigen::Matrix3d r = left_from_right * frame_from_scanner.linear() * left_from_right.transpose();
  const Vec3 t = 100 * (left_from_right * frame_from_scanner.translation());
  // R = Rx·Ry·Rz has sin θy at (0, 2). Of its two solutions take the one that turns least about x, so that a
  // level scanner reads as a heading alone.
  double y = std::asin(std::fmax(-1, std::fmin(1, r(0, 2))));
  double x = std::atan2(-r(1, 2), r(2, 2)), z = std::atan2(-r(0, 1), r(0, 0));
  if (std::abs(x) > 0.5 * 3.141592653589793) {
    y = 3.141592653589793 - y;
    x = std::atan2(r(1, 2), -r(2, 2));
    z = std::atan2(r(0, 1), -r(0, 0));
  }
  const double degrees = 180 / 3.141592653589793;
  char text[200];
  std::snprintf(text, sizeof text, "%.4f %.4f %.4f\n%.6f %.6f %.6f\n", t.x(), t.y(), t.z(), x * degrees,
                y * degrees, z * degrees);
  return text;
}

}  // namespace gramap
