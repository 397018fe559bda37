#include "floor/read_model.h"

#include <tiny_gltf.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "floor/gltf_extras.h"
#include "geometry/error.h"
#include "geometry/file.h"

namespace gramap {
namespace {

using json = nlohmann::json;

json json_of(const tinygltf::Value& value) {
  if (value.IsBool()) return value.Get<bool>();
  if (value.IsInt()) return value.Get<int>();
  if (value.IsNumber()) return value.GetNumberAsDouble();
  if (value.IsString()) return value.Get<std::string>();
  if (value.IsArray()) {
    json array = json::array();
    for (const tinygltf::Value& item : value.Get<tinygltf::Value::Array>()) array.push_back(json_of(item));
    return array;
  }
  if (value.IsObject()) {
    json object = json::object();
    for (const auto& [key, item] : value.Get<tinygltf::Value::Object>()) object[key] = json_of(item);
    return object;
  }
  return nullptr;
}

class Reader {
 public:
  explicit Reader(const std::filesystem::path& path) : path_(path) {}

  ReadModel read() {
    load();
    if (model_.scenes.empty()) fail("has no scene");
    const int scene = model_.defaultScene >= 0 ? model_.defaultScene : 0;
    if (scene >= static_cast<int>(model_.scenes.size())) fail("has no scene " + std::to_string(scene));
    find_origin();
    for (const int root : model_.scenes[scene].nodes) visit(root, "", "", Eigen::Isometry3d::Identity(), 0);
    if (storeys_.empty()) fail("holds no floor of gramap: no node with extras.gramap of kind \"floor\"");
    for (auto& [name, storey] : storeys_) result_.storeys.push_back(std::move(storey));
    std::stable_sort(
        result_.storeys.begin(), result_.storeys.end(),
        [](const FittedFloor& a, const FittedFloor& b) { return a.floor.elevation_m < b.floor.elevation_m; });
    result_.floor = result_.storeys.front();
    return std::move(result_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError({path_.string()}, "the model " + what, "give a .glb or .gltf that gramap wrote");
  }

  void load() {
    const std::string bytes = read_file(path_);
    tinygltf::TinyGLTF loader;
    loader.SetImageLoader([](tinygltf::Image*, const int, std::string*, std::string*, int, int,
                             const unsigned char*, int, void*) { return true; },
                          nullptr);
    std::string error, warning;
    const auto length = static_cast<unsigned int>(bytes.size());
    bool loaded = false;
    try {
      loaded = bytes.compare(0, 4, "glTF") == 0
                   ? loader.LoadBinaryFromMemory(&model_, &error, &warning,
                                                 reinterpret_cast<const unsigned char*>(bytes.data()), length)
                   : loader.LoadASCIIFromString(&model_, &error, &warning, bytes.c_str(), length,
                                                path_.parent_path().string());
    } catch (const std::exception& exception) {
      error = exception.what();
    }
    if (!loaded) {
      while (!error.empty() && error.back() == '\n') error.pop_back();
      fail("is no glTF 2.0 file" + (error.empty() ? std::string() : ": " + error));
    }
  }

  /// The plan coordinates that were taken off, from the root's extras.
  void find_origin() {
    for (const tinygltf::Node& node : model_.nodes) {
      const json about = gramap_of(node);
      if (about.contains("format")) result_.run_json = about.dump();
      if (!about.contains("local_origin")) continue;
      const std::vector<Vec2> origin = plan_points(json::array({about["local_origin"]}));
      if (origin.size() == 1) origin_ = origin[0];
    }
  }

  static json gramap_of(const tinygltf::Node& node) {
    if (!node.extras.IsObject() || !node.extras.Has("gramap")) return json::object();
    json about = json_of(node.extras.Get("gramap"));
    return about.is_object() ? about : json::object();
  }

  void visit(int index, const std::string& parent, std::string storey, Eigen::Isometry3d world, int depth) {
    if (index < 0 || index >= static_cast<int>(model_.nodes.size())) fail("names a node that is not there");
    if (depth > 64 || !visited_.insert(index).second) fail("has nodes that are no tree");
    const tinygltf::Node& node = model_.nodes[index];
    world = world * transform(node);
    const json about = gramap_of(node);
    ReadNode read;
    read.node = node.name;
    read.parent = parent;
    read.kind = text(about, "kind");
    read.id = text(about, "id");
    read.type = text(about, "type");
    if (read.kind == "floor") {
      storey = node.name;
      if (!storeys_.emplace(storey, floor_of_extras(about)).second) fail("has two floors of one name");
    }
    read.storey = storey;
    if (!about.empty()) read.extras_json = about.dump();
    if (node.mesh >= 0) read.mesh = mesh(node.mesh, world);
    if (!storey.empty()) add_extras(storeys_[storey], about, label(node));
    result_.nodes.push_back(std::move(read));
    for (const int child : node.children) visit(child, node.name, storey, world, depth + 1);
  }

  static std::string label(const tinygltf::Node& node) {
    if (!node.extras.IsObject() || !node.extras.Has("Name")) return {};
    const tinygltf::Value& name = node.extras.Get("Name");
    return name.IsString() ? name.Get<std::string>() : std::string();
  }

  Eigen::Isometry3d transform(const tinygltf::Node& node) const {
    if (!node.matrix.empty()) fail("has a node with a matrix, which gramap does not write");
    Eigen::Isometry3d placed = Eigen::Isometry3d::Identity();
    if (node.translation.size() == 3)
      placed.translation() = Vec3(node.translation[0], node.translation[1], node.translation[2]);
    if (node.rotation.size() == 4)
      placed.linear() =
          Eigen::Quaterniond(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2])
              .normalized()
              .toRotationMatrix();
    return placed;
  }

  /// The bytes of an accessor's element, or a fault.
  const unsigned char* element(const tinygltf::Accessor& accessor, std::size_t i, std::size_t size) const {
    if (accessor.bufferView < 0 || accessor.bufferView >= static_cast<int>(model_.bufferViews.size()))
      fail("lacks data");
    const tinygltf::BufferView& view = model_.bufferViews[accessor.bufferView];
    if (view.buffer < 0 || view.buffer >= static_cast<int>(model_.buffers.size())) fail("lacks data");
    const std::vector<unsigned char>& data = model_.buffers[view.buffer].data;
    const std::size_t stride = view.byteStride ? view.byteStride : size,
                      offset = accessor.byteOffset + i * stride;
    if (stride > 252 || i > data.size() || accessor.byteOffset > data.size() ||
        view.byteLength > data.size() || view.byteOffset > data.size() - view.byteLength ||
        offset + size > view.byteLength)
      fail("has an accessor that reaches beyond its data");
    return data.data() + view.byteOffset + offset;
  }

  const tinygltf::Accessor& accessor(int index) const {
    if (index < 0 || index >= static_cast<int>(model_.accessors.size()))
      fail("names an accessor that is not there");
    return model_.accessors[index];
  }

  std::uint32_t index_at(const tinygltf::Accessor& indices, std::size_t i) const {
    const auto as = [&](auto number) {
      std::memcpy(&number, element(indices, i, sizeof number), sizeof number);
      return static_cast<std::uint32_t>(number);
    };
    switch (indices.componentType) {
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return as(std::uint8_t{});
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return as(std::uint16_t{});
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return as(std::uint32_t{});
      default:
        fail("has indices of a type that glTF does not know");
    }
  }

  /// A mesh in plan coordinates. Corners that differ in their normals only are made one.
  Mesh mesh(int index, const Eigen::Isometry3d& world) const {
    if (index >= static_cast<int>(model_.meshes.size())) fail("names a mesh that is not there");
    Mesh result;
    std::map<std::array<float, 3>, int> corner_at;
    for (const tinygltf::Primitive& primitive : model_.meshes[index].primitives) {
      const auto position = primitive.attributes.find("POSITION");
      if (position == primitive.attributes.end() || primitive.mode != TINYGLTF_MODE_TRIANGLES) continue;
      const tinygltf::Accessor& positions = accessor(position->second);
      if (positions.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT || positions.type != TINYGLTF_TYPE_VEC3)
        fail("has positions that are no three floats");
      const std::size_t count = primitive.indices >= 0 ? accessor(primitive.indices).count : positions.count;
      Triangle triangle{};
      for (std::size_t i = 0; i < count; ++i) {
        const std::size_t vertex = primitive.indices >= 0 ? index_at(accessor(primitive.indices), i) : i;
        if (vertex >= positions.count) fail("has an index beyond its points");
        std::array<float, 3> raw;
        std::memcpy(raw.data(), element(positions, vertex, sizeof raw), sizeof raw);
        const auto [entry, is_new] = corner_at.try_emplace(raw, static_cast<int>(result.points.size()));
        if (is_new) {
          const Vec3 p = world * Vec3(raw[0], raw[1], raw[2]);
          result.points.emplace_back(p.x() + origin_.x(), -p.z() + origin_.y(), p.y());
        }
        triangle[i % 3] = entry->second;
        if (i % 3 == 2) result.triangles.push_back(triangle);
      }
    }
    return result;
  }

  const std::filesystem::path& path_;
  tinygltf::Model model_;
  Vec2 origin_ = Vec2::Zero();
  std::map<std::string, FittedFloor> storeys_;  ///< by node name
  std::set<int> visited_;
  ReadModel result_;
};

}  // namespace

ReadModel read_model(const std::filesystem::path& path) {
  return Reader(path).read();
}

}  // namespace gramap
