// Where a space's reference line lies on its border, and which file of a floor folder is meant.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include "geometry/types.h"

namespace gramap {

enum class LineSide { left, right, off_border };

/// On which side of the line from `start` to `end` the area lies whose border it runs along (to 5 cm).
LineSide side_of(const Polygon& outline, const Vec2& start, const Vec2& end);

/// How far the outline runs along the line (to 5 cm), beyond its ends too, metres.
double side_length(const Polygon& outline, const Vec2& start, const Vec2& end);

/// The stretch of the outline that runs beside the hallway: straight edges that face the hallway, parallel to
/// an edge of it and at most `reach_m` away, the longest overlap wins. Returned with the area on its left.
std::optional<std::pair<Vec2, Vec2>> edge_beside(const Polygon& outline, const Polygon& hallway,
                                                 double reach_m = 1.0);

/// `path` itself, or the file `name` in it when it is a folder. Throws InputError when that is missing.
std::filesystem::path floor_file(const std::filesystem::path& path, const std::string& name);

}  // namespace gramap
