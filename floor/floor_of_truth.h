// A floor whose rooms are all known, as a fitted floor: to model, export and look at plans that need no fit.
#pragma once

#include "floor/fitted_floor.h"
#include "floor/ground_truth.h"

namespace gramap {

/// The truth's rooms with openings and furniture, origin `given`. Rooms that are hallways or fixed rooms of
/// `floor` (the same id) become these. Heights are the truth's; walls are the floor's, with 0.1 m and 0.3 m
/// where it says nothing.
FittedFloor floor_of_truth(const FloorGroundTruth& floor, const FloorTruth& truth);

}  // namespace gramap
