// The plain types that every folder shares. Metres, right-handed, Z up; plan coordinates are the x and y of
// that frame.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace gramap {

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;

/// A simple polygon's ring: counter-clockwise unless said otherwise, the first point not repeated at the end.
using Polygon = std::vector<Vec2>;

}  // namespace gramap
