#include "floor/verify_file.h"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "floor/gltf_extras.h"
#include "floor/reachable.h"
#include "geometry/overlay.h"
#include "geometry/partition.h"
#include "geometry/polygon.h"
#include "geometry/watertight.h"

namespace gramap {
namespace {

using json = nlohmann::json;

bool is_room(const std::string& kind) {
  return kind == "room" || kind == "hallway" || kind == "fixed";
}

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

/// Plan triangles of one storey, points shared where their coordinates are equal.
struct PlanSheet {
  std::vector<Vec2> points;
  std::vector<Triangle> triangles;
  std::map<std::pair<double, double>, int> index;

  void add(const Vec3& a, const Vec3& b, const Vec3& c) {
    Triangle t{};
    int k = 0;
    for (const Vec3& p : {a, b, c}) {
      const auto [entry, is_new] = index.try_emplace({p.x(), p.y()}, static_cast<int>(points.size()));
      if (is_new) points.emplace_back(p.x(), p.y());
      t[k++] = entry->second;
    }
    triangles.push_back(t);
  }
};

class Verification {
 public:
  explicit Verification(const ReadModel& model) : model_(model) {
    for (const ReadNode& node : model.nodes) by_name_[node.node] = &node;
  }

  VerifyReport run() {
    names();
    solids();
    for (const ReadNode& node : model_.nodes)
      if (node.kind == "floor") plan(node);
    for (const FittedFloor& storey : model_.storeys) count(storey);
    reach();
    return std::move(report_);
  }

 private:
  void fault(const std::string& code, const std::string& message, const Vec3& at) {
    report_.faults.push_back({code, message, at});
  }

  void names() {
    std::set<std::string> seen;
    for (const ReadNode& node : model_.nodes) {
      if (!seen.insert(node.node).second) fault("name", "two nodes are named " + node.node, Vec3::Zero());
      if (node.node.empty() ||
          node.node.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-") !=
              std::string::npos)
        fault("name", "the node name '" + node.node + "' has other characters than A-Z a-z 0-9 _ -",
              Vec3::Zero());
    }
  }

  bool is_face(const ReadNode& node) const {
    const auto parent = by_name_.find(node.parent);
    return parent != by_name_.end() && is_room(parent->second->kind) &&
           (ends_with(node.node, "_floor") || ends_with(node.node, "_ceiling"));
  }

  int& kind_of_solid(const ReadNode& node) {
    VerifyTotals& t = report_.totals;
    if (node.kind == "wall") return t.wall_solids;
    const auto parent = by_name_.find(node.parent);
    const std::string kind = parent == by_name_.end() ? "" : parent->second->kind;
    return kind == "door" || kind == "window" ? t.opening_parts
           : kind == "furniture"              ? t.furniture_parts
           : is_room(kind)                    ? t.room_volumes
                                              : t.slabs;
  }

  void solids() {
    std::vector<const ReadNode*> closed;
    for (const ReadNode& node : model_.nodes)
      if (!node.mesh.triangles.empty() && !is_face(node)) closed.push_back(&node);
    std::vector<std::vector<MeshFault>> faults(closed.size());
    tbb::parallel_for(std::size_t{0}, closed.size(),
                      [&](std::size_t i) { faults[i] = check_solid(closed[i]->mesh); });
    for (std::size_t i = 0; i < closed.size(); ++i) {
      ++kind_of_solid(*closed[i]);
      report_.totals.triangles += static_cast<int>(closed[i]->mesh.triangles.size());
      for (const MeshFault& f : faults[i]) {
        const bool open = f.kind == MeshFault::Kind::open_edge;
        fault(open                                           ? "open"
              : f.kind == MeshFault::Kind::self_intersection ? "self-intersection"
                                                             : "manifold",
              closed[i]->node + " has a mesh fault: " + to_string(f.kind), f.at);
      }
    }
  }

  /// Undersides of the walls and floors of the rooms, which together must tile the outline.
  void plan(const ReadNode& floor) {
    PlanSheet sheet;
    double rooms = 0, walls = 0;
    for (const ReadNode& node : model_.nodes) {
      if (node.storey != floor.node) continue;
      double area = 0;
      if (node.kind == "wall") {
        double lowest = 1e300;
        for (const Vec3& p : node.mesh.points) lowest = std::min(lowest, p.z());
        area = add_facing(sheet, node.mesh, -1, [lowest](const Vec3& p) { return p.z() == lowest; });
        walls += area;
      } else if (is_face(node) && ends_with(node.node, "_floor")) {
        area = add_facing(sheet, node.mesh, 1, [](const Vec3&) { return true; });
        rooms += area;
        const std::string& kind = by_name_.at(node.parent)->kind;
        (kind == "room"      ? report_.totals.rooms_m2
         : kind == "hallway" ? report_.totals.hallways_m2
                             : report_.totals.fixed_m2) += area;
        face_up(node);
      } else if (is_face(node)) {
        PlanSheet ceiling;
        add_facing(ceiling, node.mesh, -1, [](const Vec3&) { return true; });
        if (ceiling.triangles.size() != node.mesh.triangles.size())
          fault("orientation", node.node + " does not face down", node.mesh.points.front());
      }
    }
    report_.totals.walls_m2 += walls;
    double outline = 0;
    std::vector<Polygon> rings;
    const json about = json::parse(floor.extras_json);
    if (about.contains("outline"))
      for (const json& ring : about["outline"]) {
        rings.push_back(plan_points(ring));
        outline += signed_area(rings.back());
      }
    report_.totals.outline_m2 += outline;
    if (const auto stray = stray_border(sheet.points, sheet.triangles, rings, 1e-3))
      fault("gap", "rooms and walls of " + floor.node + " do not close up: some overlap or leave a gap",
            Vec3(stray->x(), stray->y(), 0));
    const bool tiled = tiles_exactly(sheet.points, sheet.triangles);
    double enclosed = 0, border_length = 0;
    for (const Polygon& ring : border(sheet.points, sheet.triangles)) {
      enclosed += signed_area(ring);
      for (std::size_t i = 0; i < ring.size(); ++i)
        border_length += (ring[(i + 1) % ring.size()] - ring[i]).norm();
    }
    if (!tiled)
      fault("overlap",
            "rooms and walls of " + floor.node + " do not tile its plan: some overlap or leave a gap",
            Vec3::Zero());
    // Single precision moves the border by less than 0.1 mm.
    if (std::abs(enclosed - outline) > 1e-4 * std::max(1.0, border_length))
      fault("gap",
            "rooms and walls of " + floor.node + " cover " + std::to_string(enclosed) +
                " m² of an outline of " + std::to_string(outline) + " m²",
            Vec3::Zero());
    exact_ = exact_ && tiled;
    report_.totals.area_exact = exact_;
  }

  void face_up(const ReadNode& node) {
    for (const Triangle& t : node.mesh.triangles) {
      const Vec3 a = node.mesh.points[t[0]], b = node.mesh.points[t[1]], c = node.mesh.points[t[2]];
      if ((b - a).cross(c - a).z() > 0) continue;
      fault("orientation", node.node + " does not face up", a);
      return;
    }
  }

  /// Adds the level triangles that face up (sign 1) or down (-1), all of them turned up. Returns their area.
  template <typename Wanted>
  static double add_facing(PlanSheet& sheet, const Mesh& mesh, int sign, Wanted wanted) {
    double area = 0;
    for (const Triangle& t : mesh.triangles) {
      const Vec3 a = mesh.points[t[0]], b = mesh.points[t[1]], c = mesh.points[t[2]];
      if (!wanted(a) || !wanted(b) || !wanted(c)) continue;
      const double doubled = (b - a).cross(c - a).z() * sign;
      if (doubled <= 0) continue;
      area += doubled / 2;
      sign > 0 ? sheet.add(a, b, c) : sheet.add(a, c, b);
    }
    return area;
  }

  void count(const FittedFloor& storey) {
    VerifyTotals& t = report_.totals;
    t.rooms += static_cast<int>(storey.rooms.size());
    t.hallways += static_cast<int>(storey.hallways.size());
    t.fixed += static_cast<int>(storey.fixed.size());
  }

  void reach() {
    std::map<std::string, std::vector<std::pair<std::string, std::string>>> doors;
    VerifyTotals& t = report_.totals;
    for (const ReadNode& node : model_.nodes) {
      if (node.kind == "wall") ++(node.type == "junction" ? t.junctions : t.walls);
      if (node.kind == "window") ++t.windows;
      if (node.kind == "furniture") ++t.furniture;
      if (node.kind != "door") continue;
      ++t.doors;
      const json about = json::parse(node.extras_json);
      doors[node.storey].emplace_back(text(about, "room"), text(about, "other"));
    }
    for (const auto& [storey, passages] : doors) {
      std::vector<std::string> ids, from{"outside"};
      std::map<std::string, Vec3> place;
      for (const ReadNode& node : model_.nodes) {
        if (node.storey != storey || !is_room(node.kind)) continue;
        ids.push_back(node.id);
        if (node.kind == "hallway") from.push_back(node.id);
        const Polygon outline = plan_points(json::parse(node.extras_json)["outline"]);
        if (!outline.empty()) place[node.id] = Vec3(centroid(outline).x(), centroid(outline).y(), 0);
      }
      for (const std::string& id : unreachable(ids, passages, from))
        report_.warnings.push_back({"unreachable", "no door leads to '" + id + "'", place[id]});
    }
  }

  const ReadModel& model_;
  std::map<std::string, const ReadNode*> by_name_;
  bool exact_ = true;
  VerifyReport report_;
};

}  // namespace

VerifyReport verify_file(const ReadModel& model) {
  return Verification(model).run();
}

}  // namespace gramap
