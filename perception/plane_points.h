// The points that a room's planes are measured on.
#pragma once

#include <optional>
#include <vector>

#include "perception/adjust.h"
#include "perception/range_noise.h"

namespace gramap {

/// A piece of a wall, in metres along the plane's `u` from its `middle`.
struct FaceStretch {
  double from, to;
};

/// Where the room's faces are: of planes 0 and 1, floor and ceiling, what lies in the ring; of the others
/// what lies between these two on their stretches. Corners hold points of two planes, and are left out.
struct RoomFaces {
  const std::vector<AdjustedPlane>& planes;
  const Polygon& ring;
  std::vector<std::vector<FaceStretch>> stretches;  ///< by plane
  bool level_ceiling = true;                        ///< false: the ceiling is sloped, and not measured

  bool covers(std::size_t plane, const Vec3& place) const;
};

/// Where the ray to a point meets a plane. Which points count, and how much, is asked of this place:
/// asked of the point itself, it would depend on its error (points measured too short have less noise at
/// their range, and lie beyond a corner less often than those measured too long), and rooms would come out
/// too small.
struct Meeting {
  Vec3 place;
  double range_m;
  double slope;  ///< cosine between the ray and the normal
};
std::optional<Meeting> meeting(const AdjustedPlane& plane, const Vec3& scanner, const Vec3& point);

/// The points on the faces, of about `most` that are asked, with the noise expected of each; chosen where the
/// scans' corrections so far put them. Of an opening and of what stands at a face some points come near
/// enough to be taken for the face's, all on one side: places of the face where rays also end elsewhere are
/// left out.
std::vector<PlanePoint> points_on(const RoomFaces& faces, const FaceNoise& noise,
                                  const RegisteredCloud& cloud,
                                  const std::vector<Eigen::Isometry3d>& corrections, std::size_t most);

}  // namespace gramap
