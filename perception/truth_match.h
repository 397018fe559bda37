// What was found in a room against what is truly there: for training and scoring only.
#pragma once

#include <vector>

#include "perception/observation.h"
#include "perception/simulate.h"

namespace gramap {

/// The true room in the frame of its observation: turned by the difference of their outlines' directions and
/// shifted centre upon centre. Of the four quarter turns the least, unless outline and openings found fit
/// clearly better after another (poses in a frame of the room's own). Heights stay above the floor.
BuildingRoom aligned_truth(const BuildingRoom& truth, const RoomObservation& observed);

/// The true openings as stretches of the observed room's walls; those on no observed wall (farther than 0.3
/// m) have wall −1.
std::vector<OpeningObservation> true_openings(const BuildingRoom& aligned, const RoomObservation& observed);

/// Intersection over union on the wall; 0 on different walls.
double overlap(const OpeningObservation& a, const OpeningObservation& b);

/// The room's outline and walls as a perfect observation in the given frame, for training without finding
/// planes.
RoomObservation observation_of_truth(const BuildingRoom& truth, const Eigen::Isometry3d& frame_from_building);

}  // namespace gramap
