// The mechanics of glTF: buffers, accessors, materials, nodes. What the nodes mean is gltf.cpp's business.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "floor/palette.h"
#include "geometry/mesh.h"

namespace gramap {

class GltfWriter {
 public:
  /// `origin`: taken off all plan coordinates, so that single precision keeps tenths of a millimetre.
  explicit GltfWriter(const Vec2& origin);
  ~GltfWriter();
  GltfWriter(const GltfWriter&) = delete;
  GltfWriter& operator=(const GltfWriter&) = delete;

  /// A mesh of parts in one material each, plan coordinates and height, `elevation_m` added. Returns its
  /// index. Throws std::logic_error when a coordinate is not finite.
  int add_mesh(const std::string& name, const std::vector<std::pair<Material, const Mesh*>>& parts,
               double elevation_m);

  /// A mesh about its own origin, for instances.
  int add_shared_mesh(const std::string& name, const std::vector<std::pair<Material, const Mesh*>>& parts);

  /// A node under `parent` (-1: of the scene). `mesh` may be -1; `extras_json` an object or empty. Returns
  /// its index.
  int add_node(const std::string& name, int parent, int mesh, const std::string& extras_json);

  /// Places a node: the origin of its mesh in the plan and above z = 0, and the direction of its x axis.
  void place(int node, const Vec3& origin, const Vec2& x_axis);

  std::string binary(const std::string& generator, const std::string& scene_name);
  std::string text(const std::string& generator, const std::string& scene_name);

 private:
  struct State;
  int mesh(const std::string& name, const std::vector<std::pair<Material, const Mesh*>>& parts,
           const Vec3& shift);
  int material(Material material);
  std::string written(const std::string& generator, const std::string& scene_name, bool as_binary);
  std::unique_ptr<State> state_;
};

}  // namespace gramap
