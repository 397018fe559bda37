#include "floor/gltf.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "floor/global_id.h"
#include "floor/gltf_extras.h"
#include "floor/gltf_writer.h"
#include "floor/node_names.h"
#include "floor/verify.h"

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

const char* kind_name(ModelRoom::Kind kind) {
  switch (kind) {
    case ModelRoom::Kind::hallway:
      return "hallway";
    case ModelRoom::Kind::fixed:
      return "fixed";
    case ModelRoom::Kind::room:
      break;
  }
  return "room";
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
    for (const ModelWall& wall : model.walls) add_wall(model, wall, floor);
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
    if (options_.room_volumes) part("_volume", "Volume", "IfcSpace", Material::glass, room.volume);
  }

  void add_wall(const FloorModel& model, const ModelWall& wall, int floor) {
    const std::string name = names_.name(prefix_ + wall.node);
    const Material material = wall.type == "mass"    ? Material::mass
                              : wall.type == "outer" ? Material::wall_outer
                                                     : Material::wall_inner;
    json extras = thing(wall.node, "IfcWall", name);
    extras["gramap"] = {{"kind", "wall"},         {"id", wall.node},       {"type", wall.type},
                        {"origin", "given"},      {"between", wall.sides}, {"thickness", wall.thickness_m},
                        {"length", wall.length_m}};
    writer_.add_node(name, floor, writer_.add_mesh(name, {{material, &wall.solid}}, model.elevation_m),
                     extras.dump());
  }

  const std::vector<FloorModel>& storeys_;
  const RunInfo& run_;
  const GltfOptions& options_;
  Vec2 origin_;
  GltfWriter writer_;
  NodeNames names_;
  std::string storey_;  ///< the current one's id
  std::string prefix_;  ///< of node names, in buildings
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
