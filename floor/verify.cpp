#include "floor/verify.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <utility>

#include "floor/reachable.h"
#include "geometry/polygon.h"
#include "geometry/say.h"
#include "geometry/watertight.h"

namespace gramap {
namespace {

std::string number(double value, int digits) {
  char text[48];
  std::snprintf(text, sizeof text, "%.*f", digits, value);
  return text;
}

void check_plan(const FloorModel& model, VerifyReport& report) {
  const auto at = [](const Vec2& p) { return Vec3(p.x(), p.y(), 0); };
  for (const PlanFault& fault : model.plan.faults) {
    if (fault.kind == PlanFault::Kind::lost_opening) continue;
    const bool overlap = fault.kind == PlanFault::Kind::overlap;
    report.faults.push_back(
        {overlap ? "overlap" : "bounds",
         model.rooms[fault.a].node + (overlap ? " overlaps another room" : " is not within the outline"),
         at(fault.at)});
  }
  std::vector<Triangle> parts;
  for (const PlanCell& cell : model.plan.cells)
    parts.insert(parts.end(), cell.triangles.begin(), cell.triangles.end());
  if (const auto stray = stray_border(model.plan.points, parts, model.outline, 1e-6))
    report.faults.push_back({"gap", "rooms and walls do not close up", at(*stray)});
  report.totals.area_exact = model.plan.exact && areas_exact(model.plan);
  if (!report.totals.area_exact)
    report.faults.push_back(
        {"gap",
         "the areas of rooms and walls differ from the outline's by " +
             number(report.totals.outline_m2 - model.plan.rooms_area_m2 - model.plan.walls_area_m2, 9) +
             " m²",
         Vec3::Zero()});
}

void count(const FloorModel& model, VerifyTotals& totals) {
  totals.outline_m2 = model.plan.outline_area_m2;
  totals.walls_m2 = model.plan.walls_area_m2;
  for (const PlanCell& cell : model.plan.cells) {
    if (cell.kind != PlanCell::Kind::room) continue;
    switch (model.rooms[cell.room].kind) {
      case ModelRoom::Kind::room:
        totals.rooms_m2 += cell.area_m2;
        break;
      case ModelRoom::Kind::hallway:
        totals.hallways_m2 += cell.area_m2;
        break;
      case ModelRoom::Kind::fixed:
        totals.fixed_m2 += cell.area_m2;
        break;
    }
  }
  for (const ModelRoom& room : model.rooms)
    ++(room.kind == ModelRoom::Kind::room      ? totals.rooms
       : room.kind == ModelRoom::Kind::hallway ? totals.hallways
                                               : totals.fixed);
  for (const ModelWall& wall : model.walls) ++(wall.type == "junction" ? totals.junctions : totals.walls);
  for (const ModelOpening& opening : model.openings)
    ++(opening.fitted.kind == "door" ? totals.doors : totals.windows);
  totals.furniture = static_cast<int>(model.furniture.size());
}

const char* code(MeshFault::Kind kind) {
  switch (kind) {
    case MeshFault::Kind::open_edge:
      return "open";
    case MeshFault::Kind::non_manifold:
      return "manifold";
    case MeshFault::Kind::orientation:
    case MeshFault::Kind::inside_out:
      return "orientation";
    case MeshFault::Kind::self_intersection:
      return "self-intersection";
    case MeshFault::Kind::degenerate:
    case MeshFault::Kind::not_finite:
      break;
  }
  return "degenerate";
}

/// Every closed mesh of the model with its name.
std::vector<std::pair<std::string, const Mesh*>> solids(const FloorModel& model) {
  std::vector<std::pair<std::string, const Mesh*>> all{{"slab", &model.slab}};
  for (const ModelRoom& room : model.rooms) all.emplace_back(room.node, &room.volume);
  for (const ModelWall& wall : model.walls) all.emplace_back(wall.node, &wall.solid);
  return all;
}

void check_solids(const FloorModel& model, VerifyReport& report) {
  const auto all = solids(model);
  report.totals.slabs = 1;
  report.totals.room_volumes = static_cast<int>(model.rooms.size());
  report.totals.wall_solids = static_cast<int>(model.walls.size());
  std::vector<std::vector<MeshFault>> faults(all.size());
  tbb::parallel_for(std::size_t{0}, all.size(),
                    [&](std::size_t i) { faults[i] = check_solid(*all[i].second); });
  for (std::size_t i = 0; i < all.size(); ++i) {
    report.totals.triangles += static_cast<int>(all[i].second->triangles.size());
    for (const MeshFault& fault : faults[i])
      report.faults.push_back(
          {code(fault.kind), all[i].first + " has a mesh fault: " + to_string(fault.kind), fault.at});
  }
}

/// Every opening has its cut in a wall, and walls reach above its head.
void check_openings(const FloorModel& model, VerifyReport& report) {
  std::vector<int> cuts(model.openings.size(), 0);
  for (const PlanCell& cell : model.plan.cells)
    if (cell.opening >= 0 && cell.kind == PlanCell::Kind::wall) ++cuts[cell.opening];
  for (std::size_t o = 0; o < model.openings.size(); ++o) {
    const ModelOpening& opening = model.openings[o];
    const Vec3 at(opening.fitted.a.x(), opening.fitted.a.y(), opening.fitted.sill_m);
    if (cuts[o] != 1 || opening.wall < 0)
      report.faults.push_back({"opening", opening.node + " is not cut through a wall", at});
    if (opening.fitted.sill_m < 0 || opening.fitted.head_m >= model.height_m ||
        opening.fitted.head_m <= opening.fitted.sill_m)
      report.faults.push_back({"opening", opening.node + " reaches out of its wall", at});
  }
}

/// Rooms that no door or open border joins to a hallway or the outside. Says nothing of a floor without any
/// doors.
void check_doors(const FloorModel& model, VerifyReport& report) {
  std::vector<std::pair<std::string, std::string>> passages;
  for (const ModelOpening& opening : model.openings)
    if (opening.fitted.kind == "door") passages.emplace_back(opening.room, opening.other);
  if (passages.empty()) return;
  for (const PlanCell& cell : model.plan.cells)
    if (cell.kind == PlanCell::Kind::room)
      for (const int other : cell.touching)
        if (other != kOutside)
          passages.emplace_back(model.rooms[cell.room].fitted.id, model.rooms[other].fitted.id);
  std::vector<std::string> ids, from{"outside"};
  for (const ModelRoom& room : model.rooms) {
    ids.push_back(room.fitted.id);
    if (room.kind == ModelRoom::Kind::hallway) from.push_back(room.fitted.id);
  }
  for (const std::string& id : unreachable(ids, passages, from))
    for (const ModelRoom& room : model.rooms)
      if (room.fitted.id == id) {
        const Vec2 at = centroid(room.fitted.outline);
        report.warnings.push_back({"unreachable", "no door leads to " + room.node, Vec3(at.x(), at.y(), 0)});
      }
}

}  // namespace

VerifyReport verify(const FloorModel& model) {
  VerifyReport report;
  count(model, report.totals);
  check_plan(model, report);
  check_solids(model, report);
  check_openings(model, report);
  check_doors(model, report);
  return report;
}

std::string to_text(const VerifyReport& report) {
  const VerifyTotals& t = report.totals;
  std::string text = "areas: rooms " + number(t.rooms_m2, 2) + " + hallways " + number(t.hallways_m2, 2) +
                     " + fixed " + number(t.fixed_m2, 2) + " + walls " + number(t.walls_m2, 2) +
                     (t.area_exact ? " = outline " : ", not the outline's ") + number(t.outline_m2, 2) +
                     " m²" + (t.area_exact ? " exactly\n" : "\n");
  const auto said = [](int count, const char* one, const char* many = "") {
    return said_count(static_cast<std::size_t>(count), one, many);
  };
  text += "parts: " + said(t.rooms, "room") + ", " + said(t.hallways, "hallway") + ", " +
          said(t.fixed, "fixed room") + ", " + said(t.walls, "wall") + ", " + said(t.junctions, "junction") +
          ", " + said(t.doors, "door") + ", " + said(t.windows, "window") + ", " +
          said(t.furniture, "piece of furniture", "pieces of furniture") + "\n";
  text += said(static_cast<int>(t.solids()), "solid") + " (";
  const char* comma = "";
  for (const auto& [count, one, many] :
       {std::tuple(t.slabs, "slab", "slabs"),
        std::tuple(t.wall_solids, "wall or junction", "walls and junctions"),
        std::tuple(t.room_volumes, "room volume", "room volumes"),
        std::tuple(t.opening_parts, "part of doors and windows", "parts of doors and windows"),
        std::tuple(t.furniture_parts, "part of furniture", "parts of furniture")})
    if (count > 0) text += std::exchange(comma, ", ") + said(static_cast<int>(count), one, many);
  text += "), " + std::to_string(t.triangles) + " triangles: " +
          (report.ok() ? "closed, 2-manifold, outward, free of self-intersection\n" : "with faults\n");
  const auto add = [&text](const char* label, const std::vector<VerifyFault>& list) {
    for (const VerifyFault& fault : list)
      text += std::string(label) + " [" + fault.code + "] " + fault.message + " at (" +
              number(fault.at.x(), 2) + ", " + number(fault.at.y(), 2) + ", " + number(fault.at.z(), 2) +
              ")\n";
  };
  add("fault", report.faults);
  add("warning", report.warnings);
  return text;
}

std::string to_json(const VerifyReport& report) {
  using json = nlohmann::ordered_json;
  const auto list = [](const std::vector<VerifyFault>& faults) {
    json array = json::array();
    for (const VerifyFault& fault : faults)
      array.push_back({{"code", fault.code},
                       {"message", fault.message},
                       {"at", {fault.at.x(), fault.at.y(), fault.at.z()}}});
    return array;
  };
  const VerifyTotals& t = report.totals;
  const json document = {{"ok", report.ok()},
                         {"faults", list(report.faults)},
                         {"warnings", list(report.warnings)},
                         {"areas_m2",
                          {{"outline", t.outline_m2},
                           {"rooms", t.rooms_m2},
                           {"hallways", t.hallways_m2},
                           {"fixed", t.fixed_m2},
                           {"walls", t.walls_m2},
                           {"exact", t.area_exact}}},
                         {"parts",
                          {{"rooms", t.rooms},
                           {"hallways", t.hallways},
                           {"fixed", t.fixed},
                           {"walls", t.walls},
                           {"junctions", t.junctions},
                           {"doors", t.doors},
                           {"windows", t.windows},
                           {"furniture", t.furniture},
                           {"solids", t.solids()},
                           {"slabs", t.slabs},
                           {"wall_solids", t.wall_solids},
                           {"room_volumes", t.room_volumes},
                           {"opening_parts", t.opening_parts},
                           {"furniture_parts", t.furniture_parts},
                           {"triangles", t.triangles}}}};
  return document.dump(1) + "\n";
}

}  // namespace gramap
