// The floor plan as SVG, to scale: 1 user unit is 1 mm on paper.
#pragma once

#include <string>

#include "floor/model.h"

namespace gramap {

struct SvgOptions {
  int scale = 100;          ///< 1:100
  bool uncertainty = true;  ///< ±2σ about walls that were derived: bands, or bars where they are wide
};

std::string to_svg(const FloorModel& model, const SvgOptions& options = {});

}  // namespace gramap
