#include "perception/raycast.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "geometry/polygon.h"

namespace gramap {

FaceSet::FaceSet(const std::vector<Face>& faces) {
  planes_.reserve(faces.size());
  for (const Face& face : faces) {
    Plane plane{face.origin,
                face.u.cross(face.v).normalized(),
                face.u / face.u.squaredNorm(),
                face.v / face.v.squaredNorm(),
                {},
                {},
                -1};
    if (face.ring.empty()) {
      const Vec3 far_corner = face.origin + face.u + face.v;
      const Vec3 along_u = face.origin + face.u, along_v = face.origin + face.v;
      plane.low = face.origin.cwiseMin(far_corner).cwiseMin(along_u).cwiseMin(along_v);
      plane.high = face.origin.cwiseMax(far_corner).cwiseMax(along_u).cwiseMax(along_v);
    } else {
      plane.normal = Vec3::UnitZ();
      plane.low = plane.high = {face.ring[0].x(), face.ring[0].y(), face.origin.z()};
      for (const Vec2& p : face.ring) {
        plane.low = plane.low.cwiseMin(Vec3(p.x(), p.y(), face.origin.z()));
        plane.high = plane.high.cwiseMax(Vec3(p.x(), p.y(), face.origin.z()));
      }
      plane.ring = static_cast<int>(rings_.size());
      rings_.push_back(face.ring);
    }
    planes_.push_back(plane);
  }
}

FaceSet FaceSet::within(const Vec3& centre, double radius_m) const {
  FaceSet near;
  near.rings_ = rings_;
  for (const Plane& plane : planes_) {
    const Vec3 nearest = centre.cwiseMax(plane.low).cwiseMin(plane.high);
    if ((nearest - centre).squaredNorm() < radius_m * radius_m) near.planes_.push_back(plane);
  }
  return near;
}

double FaceSet::distance(const Vec3& from, const Vec3& direction) const {
  double best = std::numeric_limits<double>::infinity();
  for (const Plane& plane : planes_) {
    const double t = plane.normal.dot(plane.origin - from) / plane.normal.dot(direction);
    if (!(t > 1e-6 && t < best)) continue;  // also refuses the NaN of a ray in the plane
    const Vec3 hit = from + t * direction;
    if (plane.ring >= 0) {
      if (contains(rings_[static_cast<std::size_t>(plane.ring)], hit.head<2>())) best = t;
      continue;
    }
    const double s = plane.u_over_uu.dot(hit - plane.origin);
    const double r = plane.v_over_vv.dot(hit - plane.origin);
    if (s >= 0 && s <= 1 && r >= 0 && r <= 1) best = t;
  }
  return best;
}

}  // namespace gramap
