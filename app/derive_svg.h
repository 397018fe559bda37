// Derived layouts as a picture: rooms in their spaces, coloured by type, with their doors and windows.
#pragma once

#include <string>

#include "floor/fitted_floor.h"

namespace gramap {

/// An SVG at 20 units a metre, plan coordinates up.
std::string derivation_svg(const FittedFloor& floor);

}  // namespace gramap
