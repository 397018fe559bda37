#include "floor/floor_of_truth.h"

#include <algorithm>
#include <map>

#include "geometry/polygon.h"

namespace gramap {
namespace {

FittedRoom given(const std::string& id, const std::string& name, const std::string& type,
                 const Polygon& outline) {
  FittedRoom room;
  room.id = id;
  room.name = name;
  room.type = type;
  room.origin = Origin::given;
  room.outline = outline;
  const OrientedBox box = oriented_box(outline);
  room.width_m = box.breadth_m;
  room.depth_m = box.length_m;
  return room;
}

/// The space that a room lies in, and its place along the space's reference line.
void put_into_space(FittedRoom& room, const std::vector<Space>& spaces) {
  for (const Space& space : spaces) {
    if (space.outline.empty() || !contains(space.outline, centroid(room.outline))) continue;
    const Vec2 along = (space.end - space.start).normalized(), left(-along.y(), along.x());
    double start = 1e300, end = -1e300, near = 1e300, far = -1e300;
    for (const Vec2& p : room.outline) {
      start = std::min(start, (p - space.start).dot(along));
      end = std::max(end, (p - space.start).dot(along));
      near = std::min(near, (p - space.start).dot(left));
      far = std::max(far, (p - space.start).dot(left));
    }
    room.space = space.id;
    room.start_m = start;
    room.width_m = end - start;
    room.depth_m = far - near;
    return;
  }
}

}  // namespace

FittedFloor floor_of_truth(const FloorGroundTruth& floor, const FloorTruth& truth) {
  FittedFloor fitted;
  fitted.floor = floor;
  fitted.inner_wall_m = floor.inner_wall_m.value_or(0.1);
  fitted.outer_wall_m = floor.outer_wall_m.value_or(0.3);
  fitted.height_m = floor.ceiling_height_m.value_or(0);
  for (const Hallway& hallway : floor.hallways)
    fitted.hallways.push_back(given(hallway.id, hallway.name, "Hallway", hallway.outline));
  for (const FixedRoom& room : floor.fixed)
    fitted.fixed.push_back(given(room.id, room.name, room.type, room.outline));
  const auto known = [](std::vector<FittedRoom>& rooms, const std::string& id) {
    return std::find_if(rooms.begin(), rooms.end(), [&id](const FittedRoom& room) { return room.id == id; });
  };
  std::map<std::string, double> floor_height_m;
  for (const TrueRoom& room : truth.rooms) {
    floor_height_m[room.id] = room.floor_m;
    auto place = known(fitted.hallways, room.id);
    if (place == fitted.hallways.end()) {
      place = known(fitted.fixed, room.id);
      if (place == fitted.fixed.end())
        place = fitted.rooms.insert(fitted.rooms.end(), given(room.id, room.name, room.type, room.outline));
    }
    put_into_space(*place, floor.spaces);
    place->height_m = std::max(0.0, room.ceiling_m - room.floor_m);
  }
  const auto with_room = [&](const std::string& id, const auto& use) {
    for (std::vector<FittedRoom>* rooms : {&fitted.rooms, &fitted.hallways, &fitted.fixed})
      if (const auto room = known(*rooms, id); room != rooms->end()) return use(*room);
  };
  for (const TrueOpening& opening : truth.openings)
    with_room(opening.room, [&](FittedRoom& room) {
      room.openings.push_back(
          {opening.kind, Origin::given, opening.a, opening.b, opening.sill_m, opening.head_m, 1});
    });
  for (const TrueFurniture& piece : truth.furniture)
    with_room(piece.room, [&](FittedRoom& room) {
      room.furniture.push_back({piece.type, Origin::given, piece.outline, piece.bottom_m, piece.top_m, 1});
    });
  return fitted;
}

}  // namespace gramap
