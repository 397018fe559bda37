// `extras.gramap`: the fitted floor's facts as the model carries them, written and read in one place.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "floor/fitted_floor.h"

namespace gramap {

/// What the extras of each kind of thing say.
nlohmann::ordered_json extras_of_floor(const FittedFloor& floor);
nlohmann::ordered_json extras_of_room(const FittedRoom& room, const char* kind);
nlohmann::ordered_json extras_of_opening(const FittedOpening& opening, const std::string& room);
nlohmann::ordered_json extras_of_furniture(const FittedFurniture& piece, const std::string& room);

/// And back: members that are missing or of another type keep the struct's defaults.
FittedFloor floor_of_extras(const nlohmann::json& about);

/// Adds the thing that `about` describes to the floor; nothing when it is no room, opening or furniture.
/// Rooms must come before what is in them.
void add_extras(FittedFloor& floor, const nlohmann::json& about, const std::string& name);

std::string text(const nlohmann::json& object, const char* key);
std::vector<Vec2> plan_points(const nlohmann::json& array);

}  // namespace gramap
