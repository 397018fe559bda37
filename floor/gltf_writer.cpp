#include "floor/gltf_writer.h"

#include <tiny_gltf.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

namespace gramap {
namespace {

tinygltf::Value value_of(const nlohmann::json& json) {
  switch (json.type()) {
    case nlohmann::json::value_t::boolean:
      return tinygltf::Value(json.get<bool>());
    case nlohmann::json::value_t::number_integer:
    case nlohmann::json::value_t::number_unsigned: {
      const auto number = json.get<long long>();
      if (number == static_cast<int>(number)) return tinygltf::Value(static_cast<int>(number));
      return tinygltf::Value(static_cast<double>(number));
    }
    case nlohmann::json::value_t::number_float: {
      if (!std::isfinite(json.get<double>()))
        throw std::logic_error("a number in the model's extras is not finite");
      return tinygltf::Value(json.get<double>());
    }
    case nlohmann::json::value_t::string:
      return tinygltf::Value(json.get<std::string>());
    case nlohmann::json::value_t::array: {
      tinygltf::Value::Array array;
      for (const auto& item : json) array.push_back(value_of(item));
      return tinygltf::Value(array);
    }
    case nlohmann::json::value_t::object: {
      tinygltf::Value::Object object;
      for (const auto& [key, item] : json.items()) object.emplace(key, value_of(item));
      return tinygltf::Value(object);
    }
    default:
      throw std::logic_error("a null in the model's extras");
  }
}

/// sRGB to linear (IEC 61966-2-1): glTF's colour factors are linear.
double linear(double channel) {
  return channel <= 0.04045 ? channel / 12.92 : std::pow((channel + 0.055) / 1.055, 2.4);
}

using Float3 = std::array<float, 3>;

/// glTF's axes: +Y up, the plan's y runs to -Z.
Float3 gltf_axes(const Vec3& p) {
  return {static_cast<float>(p.x()), static_cast<float>(p.z()), static_cast<float>(-p.y())};
}

}  // namespace

struct GltfWriter::State {
  Vec2 origin;
  tinygltf::Model model;
  std::vector<Float3> positions, normals;
  std::vector<std::uint32_t> indices;
  std::map<Material, int> materials;
};

GltfWriter::GltfWriter(const Vec2& origin) : state_(std::make_unique<State>()) {
  state_->origin = origin;
}
GltfWriter::~GltfWriter() = default;

int GltfWriter::material(Material material) {
  const auto [entry, is_new] =
      state_->materials.try_emplace(material, static_cast<int>(state_->model.materials.size()));
  if (is_new) {
    const PaletteEntry& colour = palette().at(static_cast<std::size_t>(material));
    tinygltf::Material added;
    added.name = colour.name;
    added.pbrMetallicRoughness.baseColorFactor = {linear(colour.rgba[0]), linear(colour.rgba[1]),
                                                  linear(colour.rgba[2]), colour.rgba[3]};
    added.pbrMetallicRoughness.metallicFactor = colour.metallic;
    added.pbrMetallicRoughness.roughnessFactor = colour.roughness;
    if (colour.rgba[3] < 1) added.alphaMode = "BLEND";
    state_->model.materials.push_back(std::move(added));
  }
  return entry->second;
}

int GltfWriter::add_mesh(const std::string& name, const std::vector<std::pair<Material, const Mesh*>>& parts,
                         double elevation_m) {
  return mesh(name, parts, Vec3(-state_->origin.x(), -state_->origin.y(), elevation_m));
}

int GltfWriter::add_shared_mesh(const std::string& name,
                                const std::vector<std::pair<Material, const Mesh*>>& parts) {
  return mesh(name, parts, Vec3::Zero());
}

/// Accessors hold their place among all points (or indices) as byteOffset for now; the buffer is laid out at
/// the end.
int GltfWriter::mesh(const std::string& name, const std::vector<std::pair<Material, const Mesh*>>& parts,
                     const Vec3& shift) {
  tinygltf::Mesh result;
  result.name = name;
  for (const auto& [colour, part] : parts) {
    if (part->triangles.empty()) continue;
    const std::size_t first = state_->positions.size(), first_index = state_->indices.size();
    // In floats, as they are stored: GCC 12 at -O3 leaves out a rounding to float and back.
    Eigen::Array3f low = Eigen::Array3f::Constant(std::numeric_limits<float>::max()), high = -low;
    // Flat shading: a corner is shared by triangles of one plane only.
    std::map<std::tuple<int, float, float, float>, std::uint32_t> corners;
    for (const Triangle& t : part->triangles) {
      const Vec3 a = part->points[t[0]], b = part->points[t[1]], c = part->points[t[2]];
      Vec3 normal = (b - a).cross(c - a).normalized();
      if (!a.allFinite() || !b.allFinite() || !c.allFinite() || !normal.allFinite())
        throw std::logic_error("mesh " + name +
                               " has a coordinate that is not finite or a triangle without area");
      // Rounded so that the triangles of one face agree; the length is put right again.
      normal = (normal * 4096).array().round().matrix().normalized();
      const Float3 n = gltf_axes(normal);
      for (const int p : t) {
        const auto [entry, is_new] = corners.try_emplace(
            {p, n[0], n[1], n[2]}, static_cast<std::uint32_t>(state_->positions.size() - first));
        if (is_new) {
          const Float3 position = gltf_axes(part->points[p] + shift);
          state_->positions.push_back(position);
          state_->normals.push_back(n);
          const Eigen::Array3f stored(position[0], position[1], position[2]);
          low = low.min(stored);
          high = high.max(stored);
        }
        state_->indices.push_back(entry->second);
      }
    }
    const auto accessor = [this](int view, std::size_t offset, std::size_t count, int component, int type) {
      tinygltf::Accessor added;
      added.bufferView = view;
      added.byteOffset = offset;
      added.count = count;
      added.componentType = component;
      added.type = type;
      state_->model.accessors.push_back(added);
      return static_cast<int>(state_->model.accessors.size()) - 1;
    };
    const std::size_t count = state_->positions.size() - first;
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.material = material(colour);
    primitive.attributes["POSITION"] =
        accessor(0, first * 12, count, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3);
    state_->model.accessors.back().minValues = {low.x(), low.y(), low.z()};
    state_->model.accessors.back().maxValues = {high.x(), high.y(), high.z()};
    primitive.attributes["NORMAL"] =
        accessor(1, first * 12, count, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3);
    primitive.indices = accessor(2, first_index * 4, state_->indices.size() - first_index,
                                 TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TYPE_SCALAR);
    result.primitives.push_back(std::move(primitive));
  }
  state_->model.meshes.push_back(std::move(result));
  return static_cast<int>(state_->model.meshes.size()) - 1;
}

int GltfWriter::add_node(const std::string& name, int parent, int mesh, const std::string& extras_json) {
  tinygltf::Node node;
  node.name = name;
  node.mesh = mesh;
  if (!extras_json.empty()) node.extras = value_of(nlohmann::json::parse(extras_json));
  const int index = static_cast<int>(state_->model.nodes.size());
  state_->model.nodes.push_back(std::move(node));
  if (parent >= 0)
    state_->model.nodes[static_cast<std::size_t>(parent)].children.push_back(index);
  else {
    if (state_->model.scenes.empty()) state_->model.scenes.emplace_back();
    state_->model.scenes[0].nodes.push_back(index);
  }
  return index;
}

void GltfWriter::place(int node, const Vec3& origin, const Vec2& x_axis) {
  tinygltf::Node& placed = state_->model.nodes[static_cast<std::size_t>(node)];
  placed.translation = {origin.x() - state_->origin.x(), origin.z(), -(origin.y() - state_->origin.y())};
  // A turn in the plan about up is a turn about glTF's +Y by the same angle.
  const double half_angle = std::atan2(x_axis.y(), x_axis.x()) / 2;
  if (half_angle != 0) placed.rotation = {0, std::sin(half_angle), 0, std::cos(half_angle)};
}

std::string GltfWriter::written(const std::string& generator, const std::string& scene_name, bool as_binary) {
  tinygltf::Model& model = state_->model;
  const std::size_t points = state_->positions.size() * 12, indices = state_->indices.size() * 4;
  tinygltf::Buffer buffer;
  buffer.name = "geometry";
  buffer.data.resize(2 * points + indices);
  std::memcpy(buffer.data.data(), state_->positions.data(), points);
  std::memcpy(buffer.data.data() + points, state_->normals.data(), points);
  std::memcpy(buffer.data.data() + 2 * points, state_->indices.data(), indices);
  model.buffers = {buffer};
  const auto view = [](const char* name, std::size_t offset, std::size_t length, std::size_t stride,
                       int target) {
    tinygltf::BufferView added;
    added.name = name;
    added.buffer = 0;
    added.byteOffset = offset;
    added.byteLength = length;
    added.byteStride = stride;
    added.target = target;
    return added;
  };
  model.bufferViews = {view("positions", 0, points, 12, TINYGLTF_TARGET_ARRAY_BUFFER),
                       view("normals", points, points, 12, TINYGLTF_TARGET_ARRAY_BUFFER),
                       view("indices", 2 * points, indices, 0, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER)};
  model.asset.version = "2.0";
  model.asset.generator = generator;
  model.scenes.at(0).name = scene_name;
  model.defaultScene = 0;
  std::ostringstream stream;
  tinygltf::TinyGLTF writer;
  if (!writer.WriteGltfSceneToStream(&model, stream, !as_binary, as_binary) || !stream)
    throw std::runtime_error("the glTF could not be put together");
  return stream.str();
}

std::string GltfWriter::binary(const std::string& generator, const std::string& scene_name) {
  return written(generator, scene_name, true);
}

std::string GltfWriter::text(const std::string& generator, const std::string& scene_name) {
  return written(generator, scene_name, false);
}

}  // namespace gramap
