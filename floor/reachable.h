// Doors of rooms, and which rooms can be reached through them.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "floor/fitted_floor.h"

namespace gramap {

bool has_door(const FittedRoom& room);

/// Of the rooms `ids`, those that no sequence of `passages` (pairs of ids; "outside" counts as a place) joins
/// to any of `from`. In the order of `ids`.
std::vector<std::string> unreachable(const std::vector<std::string>& ids,
                                     const std::vector<std::pair<std::string, std::string>>& passages,
                                     const std::vector<std::string>& from);

}  // namespace gramap
