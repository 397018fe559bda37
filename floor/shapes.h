// Doors, windows and furniture as closed solids in their own frame, so that equal ones share one mesh.
#pragma once

#include <string>
#include <vector>

#include "floor/palette.h"
#include "geometry/mesh.h"

namespace gramap {

/// One closed solid.
struct Part {
  std::string name;  ///< "leaf", "frame", "pane", ...
  Material material = Material::furniture;
  Mesh mesh;
};

/// In the opening's frame: x along the wall's face from 0 to width, y into the wall from the room's face to
/// thickness, z from 0 to height above the sill. Rounded down to whole millimetres.
std::vector<Part> door_parts(double width_m, double height_m, double thickness_m);
std::vector<Part> window_parts(double width_m, double height_m, double thickness_m);

/// In the piece's frame: x from 0 to length, y from 0 to breadth, z from 0 to height. What `type` does not
/// tell apart is a plain block. A chair's back is at y = breadth.
std::vector<Part> furniture_parts(const std::string& type, double length_m, double breadth_m, double height_m,
                                  bool derived);

}  // namespace gramap
