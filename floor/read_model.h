// A model read back from glTF, for `view`, `verify` and `evaluate`: what `extras.gramap` says of each thing,
// and its triangles.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "floor/fitted_floor.h"
#include "geometry/mesh.h"

namespace gramap {

/// One node that is a thing: a room, wall, door, window, piece of furniture.
struct ReadNode {
  std::string node;
  std::string parent;  ///< the parent's node name; empty for roots
  std::string storey;  ///< the node name of the floor that it belongs to
  std::string kind;
  std::string id;
  std::string type;
  std::string extras_json;  ///< `extras.gramap` as it stands in the file
  Mesh mesh;                ///< all triangles of the node itself, plan coordinates and height (z up)
};

struct ReadModel {
  std::string run_json;  ///< the root's `extras.gramap`
  std::vector<ReadNode> nodes;
  /// Rooms, hallways and fixed rooms with openings and furniture, as the extras say them; the lowest storey
  /// first.
  std::vector<FittedFloor> storeys;
  FittedFloor floor;  ///< the first storey
};

/// Reads a .glb or .gltf written by gramap. Throws InputError for anything else.
ReadModel read_model(const std::filesystem::path& path);

}  // namespace gramap
