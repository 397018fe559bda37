// Triangle meshes with shared vertices, and prisms over triangulated plan cells: everything solid on a floor
// is made of them.
#pragma once

#include <array>
#include <vector>

#include "geometry/types.h"

namespace gramap {

using Triangle = std::array<int, 3>;

/// Triangles over shared points, metres, Z up; counter-clockwise seen from outside.
struct Mesh {
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
};

/// Appends `part` to `mesh`, points unshared.
void append(Mesh& mesh, const Mesh& part);

/// Signed volume in m³ by the divergence theorem: positive when the mesh is closed and faces outward.
double signed_volume(const Mesh& mesh);

/// An axis-aligned box in the frame (origin, u, v, up): a closed solid of 12 triangles. `u` and `v` are unit
/// vectors in the plan, v to the left of u.
Mesh box(const Vec3& origin, const Vec2& u, const Vec2& v, double length_m, double breadth_m,
         double height_m);

/// A triangulated piece of the plan and the heights between which it is solid.
struct PrismCell {
  std::vector<Triangle> triangles;  ///< over the plan points, counter-clockwise
  /// Solid between first and second, metres; sorted, disjoint, not touching.
  std::vector<std::array<double, 2>> heights_m;
};

/// The closed surface of the union of prisms over cells that tile a piece of the plan (they share plan points
/// and overlap nowhere). Every vertex of a neighbour is a vertex of the side faces, so solids that abut do so
/// without cracks.
Mesh extrude(const std::vector<Vec2>& plan_points, const std::vector<PrismCell>& cells);

}  // namespace gramap
