// Is a mesh the boundary of a solid? The same checker ends every test that makes one.
#pragma once

#include <string>
#include <vector>

#include "geometry/mesh.h"

namespace gramap {

/// What is wrong with a mesh, each with a place. Empty: closed, 2-manifold, outward, free of degenerate
/// triangles and of self-intersection.
struct MeshFault {
  enum class Kind {
    open_edge,
    non_manifold,
    orientation,
    degenerate,
    inside_out,
    self_intersection,
    not_finite
  };
  Kind kind = Kind::open_edge;
  Vec3 at = Vec3::Zero();
};
const char* to_string(MeshFault::Kind kind);

/// Points with equal coordinates count as one. At most `limit` faults are listed.
std::vector<MeshFault> check_solid(const Mesh& mesh, int limit = 10);

}  // namespace gramap
