#include "floor/gltf.h"

#include <cmath>
#include <initializer_list>
#include <map>
#include <nlohmann/json.hpp>

#include "floor/global_id.h"
#include "floor/gltf_extras.h"
#include "floor/gltf_writer.h"
#include "floor/node_names.h"
#include "floor/shapes.h"

namespace gramap {
namespace {

using json = nlohmann::ordered_json;

constexpr int kFormatVersion = 1;
/// Plan coordinates beyond this get a local origin: single precision then still resolves 0.1 mm.
constexpr double kFar_m = 1000;

json points(const Polygon& ring) {
  json array = json::array();
  for (const Vec2& p : ring) array.push_back({p.x(), p.y()});
  return array;
}

class Export {
 public:
  Export(const std::vector<FloorModel>& storeys, const RunInfo& run, const GltfOptions& options)
      : storeys_(storeys), run_(run), options_(options), origin_(local_origin(storeys)), writer_(origin_) {
    int parent = -1;
    if (storeys.size() > 1) {
      json extras = thing("building", "IfcBuilding", "building");
      extras["gramap"] = run_json();
      extras["gramap"]["kind"] = "building";
      parent = writer_.add_node(names_.name("building"), -1, -1, extras.dump());
    }
    for (const FloorModel& storey : storeys) add_storey(storey, parent);
  }

  std::string binary() { return writer_.binary("gramap " + run_.version, scene_name()); }
  std::string text() { return writer_.text("gramap " + run_.version, scene_name()); }

 private:
  static Vec2 local_origin(const std::vector<FloorModel>& storeys) {
    Vec2 low = Vec2::Constant(1e300), high = -low;
    for (const FloorModel& storey : storeys)
      for (const Polygon& ring : storey.outline)
        for (const Vec2& p : ring) low = low.cwiseMin(p), high = high.cwiseMax(p);
    if (low.cwiseAbs().cwiseMax(high.cwiseAbs()).maxCoeff() <= kFar_m) return Vec2::Zero();
    return ((low + high) / 2).array().round();
  }

  std::string scene_name() const {
    if (storeys_.size() > 1) return "building";
    return storeys_.front().name.empty() ? "floor" : storeys_.front().name;
  }

  json thing(const std::string& name, const char* ifc_type, const std::string& identity) const {
    return {{"Name", name}, {"IfcType", ifc_type}, {"GlobalId", global_id(storey_ + "/" + identity)}};
  }

  json run_json() const {
    json run = {{"format", kFormatVersion},
                {"gramap", run_.version},
                {"rules", run_.rule_file},
                {"seed", run_.seed},
                {"score", run_.score}};
    run["options"] = json::object();
    for (const auto& [name, value] : run_.options) run["options"][name] = value;
    run["inputs"] = json::object();
    for (const auto& [name, hash] : run_.input_hashes) run["inputs"][name] = hash;
    if (origin_ != Vec2::Zero()) run["local_origin"] = {origin_.x(), origin_.y()};
    return run;
  }

  void add_storey(const FloorModel& model, int parent) {
    const std::string id = model.name.empty() ? "floor" : model.name;
    storey_ = id;
    const std::string node_name = names_.name(storeys_.size() > 1 ? "floor_" + id : "floor");
    prefix_ = storeys_.size() > 1 ? node_name + "_" : "";
    json extras = thing(id, "IfcBuildingStorey", "floor");
    json& about = extras["gramap"];
    if (parent < 0) about = run_json();
    about.update(extras_of_floor(model.fitted));
    about["height"] = model.height_m;
    about["outline"] = json::array();
    for (const Polygon& ring : model.outline) about["outline"].push_back(points(ring));
    about["totals"] = totals(model);
    const int floor = writer_.add_node(node_name, parent, -1, extras.dump());

    const int slab = writer_.add_mesh("slab", {{Material::slab, &model.slab}}, model.elevation_m);
    writer_.add_node(names_.name(prefix_ + "slab"), floor, slab, thing("Slab", "IfcSlab", "slab").dump());
    for (const ModelRoom& room : model.rooms) add_room(model, room, floor);
    std::vector<int> wall_nodes;
    for (const ModelWall& wall : model.walls) wall_nodes.push_back(add_wall(model, wall, floor));
    for (const ModelOpening& opening : model.openings)
      add_opening(model, opening, wall_nodes[static_cast<std::size_t>(opening.wall)]);
  }

  static json totals(const FloorModel& model) {
    const Partition& plan = model.plan;
    return {{"outline_m2", plan.outline_area_m2}, {"rooms_m2", plan.rooms_area_m2},
            {"walls_m2", plan.walls_area_m2},     {"rooms", model.rooms.size()},
            {"walls", model.walls.size()},        {"openings", model.openings.size()},
            {"furniture", model.furniture.size()}};
  }

  Material floor_material(const ModelRoom& room) const {
    if (room.kind == ModelRoom::Kind::hallway) return Material::floor_hallway;
    if (room.kind == ModelRoom::Kind::fixed) return Material::floor_fixed;
    if (options_.confidence_colours) return confidence_material(room.fitted.width_sigma_m);
    return room.fitted.origin == Origin::derived ? Material::floor_derived : Material::floor_observed;
  }

  void add_room(const FloorModel& model, const ModelRoom& room, int floor) {
    const FittedRoom& fitted = room.fitted;
    const std::string node_name = names_.name(prefix_ + room.node);
    json extras = thing(fitted.name.empty() ? fitted.id : fitted.name, "IfcSpace", node_name);
    extras["gramap"] = extras_of_room(fitted, kind_name(room.kind));
    extras["gramap"]["height"] = room.height_m;
    const int node = writer_.add_node(node_name, floor, -1, extras.dump());

    const auto part = [&](const char* suffix, const char* label, const char* ifc_type, Material material,
                          const Mesh& mesh) {
      const std::string name = names_.name(node_name + suffix);
      writer_.add_node(name, node, writer_.add_mesh(name, {{material, &mesh}}, model.elevation_m),
                       thing(label, ifc_type, name).dump());
    };
    part("_floor", "Floor", "IfcCovering", floor_material(room), room.floor);
    part("_ceiling", "Ceiling", "IfcCovering", Material::ceiling, room.ceiling);
    for (const ModelFurniture& piece : model.furniture)
      if (piece.room == fitted.id) add_furniture(model, piece, node);
    if (options_.room_volumes) part("_volume", "Volume", "IfcSpace", Material::glass, room.volume);
  }

  int add_wall(const FloorModel& model, const ModelWall& wall, int floor) {
    const std::string name = names_.name(prefix_ + wall.node);
    const Material material = wall.type == "mass" ? Material::mass
                              : wall.facade       ? Material::wall_outer
                                                  : Material::wall_inner;
    json extras = thing(wall.node, "IfcWall", name);
    extras["gramap"] = {{"kind", "wall"},         {"id", wall.node},       {"type", wall.type},
                        {"origin", "given"},      {"between", wall.sides}, {"thickness", wall.thickness_m},
                        {"length", wall.length_m}};
    return writer_.add_node(name, floor, writer_.add_mesh(name, {{material, &wall.solid}}, model.elevation_m),
                            extras.dump());
  }

  void add_opening(const FloorModel& model, const ModelOpening& opening, int wall) {
    const bool door = opening.fitted.kind == "door";
    const std::string name = names_.name(prefix_ + opening.node);
    json extras = thing(opening.node, door ? "IfcDoor" : "IfcWindow", name);
    extras["gramap"] = extras_of_opening(opening.fitted, opening.room);
    extras["gramap"]["id"] = opening.node;
    extras["gramap"]["other"] = opening.other;
    extras["gramap"]["footprint"] = points(opening.footprint);
    const int node = writer_.add_node(name, wall, -1, extras.dump());
    const Vec2& a = opening.footprint[0];
    // Shapes are whole millimetres; what is left over is shared by both sides.
    const double slack = opening.width_m - std::floor(opening.width_m * 1000 + 1e-6) / 1000;
    const Vec2 along = (opening.footprint[1] - a) / opening.width_m, corner = a + along * (slack / 2);
    writer_.place(node, Vec3(corner.x(), corner.y(), model.elevation_m + opening.fitted.sill_m), along);
    const double height = opening.fitted.head_m - opening.fitted.sill_m;
    add_parts(node, name, shape_key(opening.fitted.kind, {opening.width_m, height, opening.thickness_m}),
              [&] {
                return door ? door_parts(opening.width_m, height, opening.thickness_m)
                            : window_parts(opening.width_m, height, opening.thickness_m);
              });
  }

  void add_furniture(const FloorModel& model, const ModelFurniture& piece, int room) {
    const std::string name = names_.name(prefix_ + piece.node);
    json extras = thing(piece.fitted.type, "IfcFurniture", name);
    extras["gramap"] = extras_of_furniture(piece.fitted, piece.room);
    extras["gramap"]["id"] = piece.node;
    const int node = writer_.add_node(name, room, -1, extras.dump());
    writer_.place(node,
                  Vec3(piece.box.corner.x(), piece.box.corner.y(), model.elevation_m + piece.fitted.bottom_m),
                  piece.box.axis);
    const bool derived = piece.fitted.origin == Origin::derived;
    const double height = piece.fitted.top_m - piece.fitted.bottom_m;
    add_parts(node, name,
              shape_key(piece.fitted.type + (derived ? "/derived" : ""),
                        {piece.box.length_m, piece.box.breadth_m, height}),
              [&] {
                return furniture_parts(piece.fitted.type, piece.box.length_m, piece.box.breadth_m, height,
                                       derived);
              });
  }

  /// Shapes are made in whole millimetres; things that agree in these share their meshes.
  static std::string shape_key(std::string type, std::initializer_list<double> sizes_m) {
    for (const double size : sizes_m)
      type += "/" + std::to_string(static_cast<long>(std::floor(size * 1000 + 1e-6)));
    return type;
  }

  template <typename Make>
  void add_parts(int parent, const std::string& name, const std::string& key, Make make) {
    auto [shape, is_new] = shapes_.try_emplace(key);
    if (is_new)
      for (const Part& part : make())
        shape->second.emplace_back(part.name,
                                   writer_.add_shared_mesh(part.name, {{part.material, &part.mesh}}));
    for (const auto& [part, mesh] : shape->second)
      writer_.add_node(names_.name(name + "_" + part), parent, mesh, "");
  }

  const std::vector<FloorModel>& storeys_;
  const RunInfo& run_;
  const GltfOptions& options_;
  Vec2 origin_;
  GltfWriter writer_;
  NodeNames names_;
  std::map<std::string, std::vector<std::pair<std::string, int>>> shapes_;  ///< part names and meshes
  std::string storey_;                                                      ///< the current one's id
  std::string prefix_;                                                      ///< of node names, in buildings
};

}  // namespace

std::string to_glb(const FloorModel& model, const RunInfo& run, const GltfOptions& options) {
  return to_glb(std::vector<FloorModel>{model}, run, options);
}

std::string to_glb(const std::vector<FloorModel>& storeys, const RunInfo& run, const GltfOptions& options) {
  return Export(storeys, run, options).binary();
}

std::string to_gltf(const std::vector<FloorModel>& storeys, const RunInfo& run, const GltfOptions& options) {
  return Export(storeys, run, options).text();
}

}  // namespace gramap
