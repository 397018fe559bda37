// Derived layouts as a picture: rooms in their spaces, coloured by type.
#pragma once

#include <string>
#include <vector>

#include "floor/ground_truth.h"
#include "grammar/space.h"

namespace gramap {

/// A space with the rooms that were derived for it.
struct DerivedSpace {
  Space space;
  double length_m = 0;
  double depth_m = 0;
  std::vector<PlacedRoom> rooms;
};

/// An SVG at 20 units a metre, plan coordinates up. `hallways` are drawn, too.
std::string derivation_svg(const std::vector<DerivedSpace>& spaces, const std::vector<Hallway>& hallways);

}  // namespace gramap
