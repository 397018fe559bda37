// What of a room's shape a model of upright, straight walls only approximates.
#pragma once

#include <string>
#include <vector>

#include "perception/outline.h"

namespace gramap {

/// A remark for every wall that leans and for every chain of walls that turns little by little: a round wall.
std::vector<std::string> remarks_on_shape(const RoomOutline& outline, const std::vector<WallLine>& lines);

}  // namespace gramap
