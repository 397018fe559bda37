// The nearest hit of a ray among flat faces: what a simulated sensor sees.
#pragma once

#include <limits>
#include <vector>

#include "geometry/types.h"

namespace gramap {

/// A flat face: the rectangle `origin + s·u + t·v`, s and t in [0, 1], u and v at right angles. When `ring`
/// is not empty the face is instead the polygon `ring` in the plan at the height of `origin`.
struct Face {
  Vec3 origin = Vec3::Zero();
  Vec3 u = Vec3::UnitX();
  Vec3 v = Vec3::UnitY();
  Polygon ring;
};

/// Faces made ready for many rays. A few hundred faces are tried one after another, which is faster than a
/// tree at that size; `FaceSet` is cut down to what is within the sensor's reach first.
class FaceSet {
 public:
  explicit FaceSet(const std::vector<Face>& faces);

  /// The faces that come nearer to `centre` than `radius_m`.
  FaceSet within(const Vec3& centre, double radius_m) const;

  /// Distance in metres along the unit vector `direction` to the nearest face, infinity when there is none.
  double distance(const Vec3& from, const Vec3& direction) const;

 private:
  struct Plane {
    Vec3 origin, normal;
    Vec3 u_over_uu, v_over_vv;  // so that a dot product gives s and t
    Vec3 low, high;             // bounding box
    int ring;                   // index into rings_, or −1
  };
  FaceSet() = default;
  std::vector<Plane> planes_;
  std::vector<Polygon> rings_;
};

}  // namespace gramap
