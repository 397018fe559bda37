// How far perceived rooms are from the truth: the table of `gramap perceive --truth`.
#pragma once

#include <string>
#include <vector>

#include "floor/ground_truth.h"
#include "perception/observation.h"

namespace gramap {

/// A room a row: true width, depth and height, the errors and deviations in millimetres, the share of the
/// true walls that a perceived wall lies within 5 cm of, and walls that lie on no true one. Rooms are matched
/// by name and, when their frame is their own, laid on their truth by the smallest squared distances of
/// corners. The last row sums up.
std::string accuracy_table(const std::vector<RoomObservation>& rooms, const FloorTruth& truth);

/// Recall and precision of doors, windows and furniture in the rooms that were scanned; of those that could
/// not be perceived all is missed. With `mistakes` each thing missed or found in vain.
std::string things_table(const std::vector<std::string>& scanned, const std::vector<RoomObservation>& rooms,
                         const FloorTruth& truth, bool mistakes);

}  // namespace gramap
