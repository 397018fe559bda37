// What each stage of perception saw, as files to look at.
#pragma once

#include <filesystem>

#include "perception/perceive.h"

namespace gramap {

/// Writes into `folder` (made when it is not there):
///   planes.ply   the points, each plane in a colour of its own, points of no plane grey
///   planes.txt   a plane a line, with what became of it and why
///   plan.svg     points, what the scanners saw, wall lines and where they reach the ceiling, the outline,
///                doors brown, windows blue, furniture with its class and height
void write_debug(const std::filesystem::path& folder, const Perception& perception);

}  // namespace gramap
