// Doors seen from a hallway tell where the rooms beside it are: the hallway's scan is laid onto the hallway
// of the floor file, and each door in its walls becomes evidence for the space behind that wall.
#pragma once

#include <vector>

#include "floor/place.h"
#include "grammar/space.h"

namespace gramap {

struct HallwayDoorOptions {
  /// Standard deviation of a door's position along the wall, as far as it is not the hallway's own misfit.
  double door_sigma_m = 0.015;
  double width_sigma_m = 0.04;  ///< and of its width
  double reach_m =
      0.7;  ///< a hallway's wall this near a reference line, and parallel to it, is that space's wall
  double least_confidence = 0.5;  ///< doors less sure than this are not used
};

/// A rigid motion of the plan: plan = rotation(angle)·p + shift.
struct PlanMotion {
  double angle_rad = 0;
  Vec2 shift = Vec2::Zero();
  /// How far apart the outlines still are: root mean square distance of the moved corners from the given
  /// border, metres. A walk that drifted along a hallway is longer or shorter than the hallway.
  double misfit_m = 0;
  Vec2 operator()(const Vec2& point) const;
};

/// How a hallway's observed outline lies on its given outline, best first. In the building's frame one
/// answer, near the identity; in a frame of its own every way round whose extents match (a long rectangle
/// fits two ways).
std::vector<PlanMotion> hallway_motions(const RoomObservation& seen, const Polygon& given, bool own_frame);

/// Adds to the problems (one per space of the floor, in order) the doors that the hallway shows and the
/// stretches of their walls that it has seen.
void add_door_evidence(const FloorGroundTruth& floor, const RoomObservation& hallway,
                       const PlanMotion& plan_from_hallway, std::vector<SpaceProblem>& problems,
                       const HallwayDoorOptions& options = {});

}  // namespace gramap
