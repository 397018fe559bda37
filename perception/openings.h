// Doors and windows of a room, from what its walls look like from the scanner positions.
#pragma once

#include <vector>

#include "perception/forest.h"
#include "perception/label_image.h"
#include "perception/opening_candidates.h"

namespace gramap {

/// The classes of the openings' forest, in its order.
enum OpeningClass { kNoOpening, kDoor, kWindow };
const std::vector<std::string>& opening_class_names();

struct OpeningOptions {
  LabelOptions labels;
  CandidateOptions candidates;
  double least_confidence = 0.5;  ///< share of the forest's votes for the two kinds together
};

/// What may be doors and windows on one wall; boxes are in pixels.
struct WallCandidates {
  double pixel_m = 0, height_m = 0;
  std::vector<OpeningCandidate> all;
};

/// The candidates on each wall of the room, in the order of its walls.
std::vector<WallCandidates> wall_candidates(const RegisteredCloud& cloud, const RoomObservation& room,
                                            const OpeningOptions& options = {});

/// Judges the candidates of each wall: those that the forest accepts are clustered by centre and area
/// (k-means), and of each cluster the most open one is kept. An opening's kind is that of most votes.
std::vector<OpeningObservation> judge_openings(const std::vector<WallCandidates>& walls, const Forest& forest,
                                               double least_confidence);

/// All doors and windows of the room, in the order of its walls and along them. None is a result, not an
/// error.
std::vector<OpeningObservation> find_openings(const RegisteredCloud& cloud, const RoomObservation& room,
                                              const Forest& forest, const OpeningOptions& options = {});

}  // namespace gramap
