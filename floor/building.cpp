#include "floor/building.h"

#include <map>

#include "geometry/error.h"
#include "geometry/polygon.h"
#include "geometry/say.h"

namespace gramap {

Building building_of(const FloorTruth& truth, const std::string& file) {
  if (truth.rooms.empty())
    throw InputError({file}, "there is no room in the truth to simulate scans of",
                     "give a GeoJSON with features of kind 'room' (and door, window, furniture)");
  Building building;
  std::map<std::string, std::size_t> index;
  for (const TrueRoom& room : truth.rooms) {
    if (!(room.ceiling_m > room.floor_m + 1))
      throw InputError({file}, "room '" + room.id + "' has no height to stand in",
                       "give its feature \"floor\" and \"ceiling\" in metres");
    index[room.id] = building.rooms.size();
    building.rooms.push_back({room.id, room.outline, room.floor_m, room.ceiling_m, {}, {}});
  }
  const auto room_of = [&](const std::string& what, const Vec2& at, const std::string& id) -> BuildingRoom& {
    const auto room = index.find(id);
    if (room == index.end())
      throw InputError({file},
                       "a " + what + " at " + said_point(at) +
                           " belongs to no room, so no scan would show it" +
                           (id.empty() ? "" : ": there is no room '" + id + "'"),
                       "add \"room\" to the feature's properties, the id of the room that it is seen from");
    return building.rooms[room->second];
  };
  for (const TrueOpening& opening : truth.openings) {
    BuildingRoom& room = room_of(opening.kind, (opening.a + opening.b) / 2, opening.room);
    if (!(opening.head_m > opening.sill_m))
      throw InputError({file}, "a " + opening.kind + " of room '" + opening.room + "' has no height",
                       "give its feature \"sill\" and \"head\" in metres over the floor");
    room.openings.push_back({opening.kind, opening.a, opening.b, opening.sill_m, opening.head_m});
  }
  for (const TrueFurniture& piece : truth.furniture)
    room_of("piece of furniture", centroid(piece.outline), piece.room)
        .furniture.push_back({piece.type, piece.outline, piece.bottom_m, piece.top_m, false});
  return building;
}

}  // namespace gramap
