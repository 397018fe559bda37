// Buildings made up at random, with openings and furniture of many sizes: what forests are trained on.
#pragma once

#include <cstdint>

#include "perception/random.h"
#include "perception/simulate.h"

namespace gramap {

/// One storey: a hallway with `rooms_per_side` rooms on either side. Each building has its own habits (wall
/// thickness, height, sizes of doors and windows, where they stand, how it is furnished), each room departs
/// from them a little.
Building random_building(std::uint64_t seed, int rooms_per_side = 4);

/// What a sensor and a day may be like for that building: noise, registration, doors closed, frames, blinds.
SimulateOptions random_conditions(std::uint64_t seed);

/// Furnishes a room: tables alone, against walls or joined in groups, with chairs; cupboards, shelves, sofas
/// and boxes along the walls. Openings stay free in front. `density` 0 to 1: from nothing to crammed.
void furnish(BuildingRoom& room, double density, Random& random);

}  // namespace gramap
