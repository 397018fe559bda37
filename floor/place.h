// Which space, hallway or fixed room each scanned room belongs to, and what it says about that space's
// widths.
#pragma once

#include <optional>
#include <vector>

#include "floor/fitted_floor.h"
#include "floor/ground_truth.h"
#include "grammar/space.h"
#include "perception/observation.h"

namespace gramap {

/// What frame the poses of a scan folder are in.
enum class ScanFrame {
  automatic,  ///< a room with a pin is in a frame of its own, one without is in the building's
  building,
  room,
};

struct PlacementOptions {
  ScanFrame frame = ScanFrame::automatic;
  double pose_sigma_m = 0.25;    ///< how far off the poses of a whole room may be (1 sigma), building frame
  double least_overlap = 0.3;    ///< share of the room's area that must lie in the space it is placed on
  double pin_reach_m = 2.0;      ///< a pin farther than this from every space lies in none
  double least_sigma_m = 0.005;  ///< no width is believed to be better than this
};

/// One scanned room, placed.
struct PlacedObservation {
  enum class On { space, hallway, fixed };
  int observation = 0;  ///< index of the observation
  On on = On::space;
  int index = 0;          ///< into FloorGroundTruth::spaces, hallways or fixed
  RoomEvidence evidence;  ///< for the fit of the space; unused for hallways and fixed rooms
};

struct Placement {
  std::vector<PlacedObservation> placed;  ///< in the order of the observations
  std::vector<SetAsideInput> set_aside;   ///< rooms that lie nowhere, each with its reason
};

Placement place_observations(const FloorGroundTruth& floor, const std::vector<RoomObservation>& observations,
                             const PlacementOptions& options = {});

/// True when at least the share `least_overlap` of the outline's area lies in the target.
bool lies_on(const Polygon& outline, const Polygon& target, const PlacementOptions& options = {});

/// Clear length of the space along its reference line and its greatest depth away from it, metres.
double clear_length_m(const Space& space);
double clear_depth_m(const Space& space);

/// The space as a problem of the fit, before anything was observed in it.
SpaceProblem bare_problem(const FloorGroundTruth& floor, double outer_wall_m, const Space& space);

}  // namespace gramap
