// From a fitted floor to its model: partition of the plan, then prisms over its cells.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

#include "floor/model.h"
#include "floor/node_names.h"
#include "floor/place_furniture.h"
#include "floor/wall_openings.h"
#include "geometry/error.h"
#include "geometry/polygon.h"
#include "geometry/say.h"

namespace gramap {
namespace {

constexpr double kUsualHeight_m = 2.7;

std::string side_name(const FloorModel& model, int side) {
  return side == kOutside ? "outside" : model.rooms[side].fitted.id;
}

std::string described(const ModelRoom& room, const std::string& room_kind) {
  const std::string kind = room.kind == ModelRoom::Kind::fixed     ? "fixed room"
                           : room.kind == ModelRoom::Kind::hallway ? "hallway"
                                                                   : room_kind;
  return kind + " '" + room.fitted.id + "'";
}

void add_rooms(FloorModel& model, NodeNames& names, const std::string& room_kind = "room") {
  const FittedFloor& fitted = model.fitted;
  std::set<std::string> ids;
  const auto add = [&](ModelRoom::Kind kind, const std::vector<FittedRoom>& rooms) {
    for (const FittedRoom& room : rooms) {
      ModelRoom added;
      added.kind = kind;
      added.fitted = room;
      added.node = names.name(std::string(kind_name(kind)) + "_" + room.id);
      added.height_m = room.height_m > 0 ? room.height_m : model.height_m;
      // A space may have the id of a room: it is none.
      const bool space = kind == ModelRoom::Kind::room && room_kind != "room";
      if (!ids.insert(space ? room_kind + "/" + room.id : room.id).second)
        throw InputError({}, "two rooms have the id '" + room.id + "'", "give each room an id of its own");
      if (room.outline.size() < 3 || std::abs(signed_area(room.outline)) < 1e-4)
        throw InputError({}, described(added, room_kind) + " has no area",
                         "draw its clear outline as a polygon");
      for (const Vec2& p : room.outline)
        if (!p.allFinite())
          throw InputError({}, described(added, room_kind) + " has a coordinate that is not finite");
      if (signed_area(added.fitted.outline) < 0)
        std::reverse(added.fitted.outline.begin(), added.fitted.outline.end());
      model.rooms.push_back(std::move(added));
    }
  };
  add(ModelRoom::Kind::hallway, fitted.hallways);
  add(ModelRoom::Kind::fixed, fitted.fixed);
  add(ModelRoom::Kind::room, fitted.rooms);
  if (model.rooms.empty())
    throw InputError({}, "the floor has no rooms", "give it spaces, hallways or fixed rooms");
  for (const ModelRoom& room : model.rooms) model.height_m = std::max(model.height_m, room.height_m);
}

PlanInput plan_input(const FloorModel& model) {
  PlanInput input;
  for (const ModelRoom& room : model.rooms) input.rooms.push_back(room.fitted.outline);
  // Walls as thick as the floor says are walls, drawn somewhat thicker as well.
  input.thickest_wall_m =
      std::max({input.thickest_wall_m, 1.25 * model.fitted.outer_wall_m, 1.25 * model.fitted.inner_wall_m});
  const FloorGroundTruth& floor = model.fitted.floor;
  if (floor.outline.empty()) {
    input.outline = outline_around(input.rooms, std::max(model.fitted.outer_wall_m, 0.05));
    return input;
  }
  input.outline.push_back(floor.outline);
  input.outline.insert(input.outline.end(), floor.courtyards.begin(), floor.courtyards.end());
  for (std::size_t i = 0; i < input.outline.size(); ++i)
    if ((signed_area(input.outline[i]) > 0) != (i == 0))
      std::reverse(input.outline[i].begin(), input.outline[i].end());
  return input;
}

/// A contradiction in what was given, as one sentence.
[[noreturn]] void refuse(const FloorModel& model, const PlanFault& fault,
                         const std::string& room_kind = "room") {
  if (fault.kind == PlanFault::Kind::crossing_outlines)
    throw InputError({},
                     "the floor's outline and its courtyards cross one another at " + said_point(fault.at),
                     "draw courtyards inside of the outline, apart from each other");
  const std::string a = described(model.rooms[fault.a], room_kind);
  char area[32];
  std::snprintf(area, sizeof area, "%.3g m²", fault.area_m2);
  switch (fault.kind) {
    case PlanFault::Kind::overlap:
      throw InputError({},
                       a + " and " + described(model.rooms[fault.b], room_kind) + " overlap by " + area +
                           " at " + said_point(fault.at),
                       "move their borders apart in the floor file; between them there is room for a wall");
    case PlanFault::Kind::outside_outline:
      throw InputError({}, a + " reaches " + area + " out of the floor's outline at " + said_point(fault.at),
                       "the outline is the outer face of the outer walls: draw it around all rooms");
    case PlanFault::Kind::zero_wall:
      throw InputError(
          {},
          a + " touches the floor's outline at " + said_point(fault.at) +
              ", which leaves no outer wall there",
          "the outline is the outer face of the outer walls, a room's polygon its clear area: leave the "
          "wall's thickness between them");
    case PlanFault::Kind::lost_opening:
    case PlanFault::Kind::crossing_outlines:
      break;
  }
  throw std::logic_error("not a fault of the plan");
}

std::vector<Triangle> triangles_of_rooms(const FloorModel& model, int room) {
  std::vector<Triangle> triangles;
  for (const PlanCell& cell : model.plan.cells)
    if (cell.kind == PlanCell::Kind::room && cell.room == room)
      triangles.insert(triangles.end(), cell.triangles.begin(), cell.triangles.end());
  return triangles;
}

/// The triangles as a face at a height, up or down.
Mesh face(const std::vector<Vec2>& plan, const std::vector<Triangle>& triangles, double height_m, bool up) {
  Mesh mesh;
  std::vector<int> index(plan.size(), -1);
  for (Triangle t : triangles) {
    for (int& p : t) {
      if (index[p] < 0) {
        index[p] = static_cast<int>(mesh.points.size());
        mesh.points.emplace_back(plan[p].x(), plan[p].y(), height_m);
      }
      p = index[p];
    }
    if (!up) std::swap(t[1], t[2]);
    mesh.triangles.push_back(t);
  }
  return mesh;
}

void add_room_faces(FloorModel& model) {
  for (int i = 0; i < static_cast<int>(model.rooms.size()); ++i) {
    ModelRoom& room = model.rooms[i];
    const std::vector<Triangle> triangles = triangles_of_rooms(model, i);
    room.floor = face(model.plan.points, triangles, 0, true);
    room.ceiling = face(model.plan.points, triangles, room.height_m, false);
    room.volume = extrude(model.plan.points, {{triangles, {{0, room.height_m}}}});
  }
}

void add_walls(FloorModel& model, NodeNames& names) {
  for (const Partition::Wall& part : model.plan.walls) {
    ModelWall wall;
    wall.cells = part.cells;
    wall.thickness_m = part.thickness_m;
    wall.length_m = part.length_m;
    switch (part.kind) {
      case PlanCell::Kind::wall:
        wall.type = part.side_b == kOutside ? "outer" : "inner";
        wall.sides = {side_name(model, part.side_a), side_name(model, part.side_b)};
        wall.node = names.name("wall_" + wall.sides[0] + "_" + wall.sides[1]);
        break;
      case PlanCell::Kind::mass:
        wall.type = "mass";
        wall.node = names.numbered("mass");
        break;
      default:
        wall.type = "junction";
        wall.node = names.numbered("junction");
    }
    std::vector<PrismCell> cells;
    for (const int c : part.cells) {
      const PlanCell& cell = model.plan.cells[c];
      cells.push_back({cell.triangles, {{-model.finish_m, model.height_m}}});
      wall.facade = wall.facade || (!cell.touching.empty() && cell.touching.front() == kOutside);
      if (cell.opening < 0) continue;
      ModelOpening& opening = model.openings[cell.opening];
      opening.wall = static_cast<int>(model.walls.size());
      cells.back().heights_m = {{-model.finish_m, opening.fitted.sill_m},
                                {opening.fitted.head_m, model.height_m}};
    }
    wall.solid = extrude(model.plan.points, cells);
    model.walls.push_back(std::move(wall));
  }
}

/// Openings that the partition could cut, numbered within their room and kind.
void add_openings(FloorModel& model, PlanInput& input, NodeNames& names) {
  PlacedOpenings placed = place_openings(model.rooms, model.plan);
  model.set_aside = std::move(placed.set_aside);
  // A cut that meets a junction after all is taken out again; the others do not depend on it.
  while (true) {
    input.openings = placed.cuts;
    model.plan = partition(input);
    std::vector<int> lost;
    for (const PlanFault& fault : model.plan.faults)
      if (fault.kind == PlanFault::Kind::lost_opening) lost.push_back(fault.a);
    if (lost.empty()) break;
    std::sort(lost.rbegin(), lost.rend());
    for (const int o : lost) {
      const ModelOpening& opening = placed.openings[o];
      if (opening.fitted.origin != Origin::derived)
        model.set_aside.push_back({"the " + opening.fitted.kind + " of room '" + opening.room + "' at " +
                                       said_point(opening.fitted.a),
                                   "it cannot be cut straight through one wall"});
      placed.openings.erase(placed.openings.begin() + o);
      placed.cuts.erase(placed.cuts.begin() + o);
    }
  }
  model.openings = std::move(placed.openings);
  for (std::size_t o = 0; o < model.openings.size(); ++o) {
    ModelOpening& opening = model.openings[o];
    opening.footprint = model.plan.footprints[o];
    opening.node = names.numbered(opening.fitted.kind + "_" + opening.room);
    const Vec2 along = opening.footprint[1] - opening.footprint[0];
    const Vec2 into = Vec2(-along.y(), along.x()).normalized();
    opening.width_m = along.norm();
    opening.thickness_m = std::min((opening.footprint[3] - opening.footprint[0]).dot(into),
                                   (opening.footprint[2] - opening.footprint[1]).dot(into));
  }
}

void add_furniture(FloorModel& model, NodeNames& names) {
  for (const ModelRoom& room : model.rooms)
    for (ModelFurniture& piece : place_furniture(room, model.set_aside)) {
      piece.node =
          names.numbered((piece.fitted.type.empty() ? "furniture" : piece.fitted.type) + "_" + piece.room);
      model.furniture.push_back(std::move(piece));
    }
}

void add_slab(FloorModel& model) {
  PrismCell all;
  all.heights_m = {{-model.slab_thickness_m, -model.finish_m}};
  for (const PlanCell& cell : model.plan.cells)
    all.triangles.insert(all.triangles.end(), cell.triangles.begin(), cell.triangles.end());
  model.slab = extrude(model.plan.points, {all});
}

}  // namespace

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

FloorModel build_model(const FittedFloor& fitted, const BuildOptions& options) {
  FloorModel model;
  model.slab_thickness_m = options.slab_thickness_m;
  model.finish_m = options.finish_m;
  model.fitted = fitted;
  model.name = fitted.floor.name;
  model.elevation_m = fitted.floor.elevation_m;
  model.height_m =
      fitted.height_m > 0 ? fitted.height_m : fitted.floor.ceiling_height_m.value_or(kUsualHeight_m);

  NodeNames names;
  add_rooms(model, names);
  PlanInput input = plan_input(model);
  model.outline = input.outline;
  model.plan = partition(input);
  for (const PlanFault& fault : model.plan.faults) refuse(model, fault);
  add_openings(model, input, names);
  add_furniture(model, names);
  add_room_faces(model);
  add_walls(model, names);
  add_slab(model);
  return model;
}

void check_plan(const FittedFloor& given, const std::string& room_kind) {
  FloorModel model;
  model.fitted = given;
  NodeNames names;
  add_rooms(model, names, room_kind);
  for (const PlanFault& fault : partition(plan_input(model)).faults) refuse(model, fault, room_kind);
}

}  // namespace gramap
