// The fit of a whole floor: observations are placed on spaces, every space is fitted by itself, and the rooms
// get their places in the plan.
#pragma once

#include <optional>
#include <vector>

#include "floor/fitted_floor.h"
#include "floor/hallway_doors.h"
#include "floor/place.h"
#include "grammar/rules.h"
#include "grammar/space.h"
#include "perception/observation.h"

namespace gramap {

struct FloorFitOptions {
  PlacementOptions placement;
  HallwayDoorOptions doors;
  FitOptions space;
  /// Likeness::deviation, instead of what the floor's scans show (grammar/like_scanned.h).
  std::optional<double> likeness;
};

/// What the observations say of each space: one problem per space of the floor, in its order, with scanned
/// rooms and the doors that scanned hallways show. Adds what lies nowhere to `set_aside`.
std::vector<SpaceProblem> space_problems(const FloorGroundTruth& floor, const RuleSet& rules,
                                         const std::vector<RoomObservation>& observations,
                                         const FloorFitOptions& options,
                                         std::vector<SetAsideInput>& set_aside);

/// The rules as they hold on this floor: its own wall thicknesses and height go before the rule file's.
RuleSet rules_on_floor(const RuleSet& rules, const FloorGroundTruth& floor);

/// How every space of the floor is fitted: `options.space` with what only the floor as a whole can tell, how
/// many rooms show no door and how alike the rooms of a space are. `rules` as they hold on the floor.
FitOptions space_options(const RuleSet& rules, const std::vector<SpaceProblem>& problems,
                         const FloorFitOptions& options);

/// The most probable complete floor, from one problem per space in the floor's order. `observations` are
/// those that the problems come from, if any: they add heights and what was measured of the hallways. What of
/// the input had to be set aside is said in the result. Throws InputError when a space has no derivation at
/// all.
FittedFloor fit_floor(const FloorGroundTruth& floor, const RuleSet& rules,
                      const std::vector<SpaceProblem>& problems,
                      const std::vector<RoomObservation>& observations, const FloorFitOptions& options = {});

/// The floor whose spaces have these layouts (the `best` of each), drawn from the rules for instance, with
/// the doors, windows and furniture that the rules say its rooms have.
FittedFloor floor_of_layouts(const FloorGroundTruth& floor, const RuleSet& rules,
                             const std::vector<SpaceProblem>& problems, const std::vector<SpaceFit>& layouts);

/// The piece of a space between two positions along its reference line, as a clear outline.
Polygon slab(const Space& space, double start_m, double end_m);

}  // namespace gramap
