// Furniture of a room: tops of tables, chairs and low cupboards, and bodies too tall for their tops to be
// seen.
#pragma once

#include <string>
#include <vector>

#include "perception/forest.h"
#include "perception/observation.h"
#include "perception/scan.h"

namespace gramap {

/// The classes of the furniture's forest, in its order. `kNoFurniture` is also what stands for two pieces
/// taken for one or for a part of a piece.
enum FurnitureClass { kNoFurniture, kTable, kChair, kOther };
const std::vector<std::string>& furniture_class_names();
const std::vector<std::string>& furniture_feature_names();

struct FurnitureOptions {
  double lowest_m = 0.20;     ///< tops below are thresholds and cables
  double highest_m = 2.40;    ///< things above hang from the ceiling
  double from_wall_m = 0.07;  ///< points nearer to a wall are the wall's
  double least_area_m2 = 0.05;
  double most_floor_share = 0.5;   ///< of the room: larger is a floor, not furniture
  double least_confidence = 0.35;  ///< share of the forest's votes for any of the three classes
};

/// A box in the plan that may be a piece of furniture.
struct FurnitureCandidate {
  Polygon footprint;  ///< rectangle, in the cloud's frame
  double top_m = 0;   ///< above the floor
  std::vector<float> features;
  std::vector<int> parts;  ///< pairs of candidates that it could be cut into: first, second, first, second, …
};

/// For every connected surface or body its box, and the boxes that straight cuts make of it. The first
/// `roots.size()` … `roots` are the whole ones.
struct FurnitureCandidates {
  std::vector<FurnitureCandidate> all;
  std::vector<int> roots;
};
FurnitureCandidates furniture_candidates(const RegisteredCloud& cloud, const RoomObservation& room,
                                         const FurnitureOptions& options = {});

/// Of each connected thing the cutting that the forest believes in most; what it takes for nothing is left
/// out. Footprints are moved by the cloud's `origin_m`.
std::vector<FurnitureObservation> judge_furniture(const FurnitureCandidates& candidates, const Vec3& origin_m,
                                                  const Forest& forest, double least_confidence);

std::vector<FurnitureObservation> find_furniture(const RegisteredCloud& cloud, const RoomObservation& room,
                                                 const Forest& forest, const FurnitureOptions& options = {});

}  // namespace gramap
