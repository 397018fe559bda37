// Floor and ceiling among the level planes.
#pragma once

#include <string>
#include <vector>

#include "perception/wall_lines.h"

namespace gramap {

/// The floor lies under the scanners, the ceiling above them. Of the level planes there, the outermost one
/// that is not small beside the largest: table tops, lamps and what is seen through doors are small. A
/// ceiling that slopes is taken as level where it is lowest, so that all walls reach it; `remarks` says so.
/// Throws InputError when there is none, saying what was found.
Storey find_storey(const std::vector<PlanePatch>& planes, const RegisteredCloud& cloud,
                   const std::string& room, const WallOptions& options, std::vector<std::string>& remarks);

}  // namespace gramap
