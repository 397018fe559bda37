#include "floor/building.h"

#include <map>

#include "geometry/error.h"

namespace gramap {

Building building_of(const FloorTruth& truth) {
  if (truth.rooms.empty())
    throw InputError({}, "there is no room in the truth to simulate scans of",
                     "give a GeoJSON with features of kind 'room' (and door, window, furniture)");
  Building building;
  std::map<std::string, std::size_t> index;
  for (const TrueRoom& room : truth.rooms) {
    if (!(room.ceiling_m > room.floor_m + 1))
      throw InputError({}, "room '" + room.id + "' has no height to stand in",
                       "give its feature \"floor\" and \"ceiling\" in metres");
    index[room.id] = building.rooms.size();
    building.rooms.push_back({room.id, room.outline, room.floor_m, room.ceiling_m, {}, {}});
  }
  const auto room_of = [&](const std::string& what, const std::string& id) -> BuildingRoom& {
    const auto room = index.find(id);
    if (room == index.end())
      throw InputError({}, "a " + what + " belongs to no room, so no scan would show it",
                       "add \"room\" to the feature's properties, the id of the room that it is seen from");
    return building.rooms[room->second];
  };
  for (const TrueOpening& opening : truth.openings) {
    BuildingRoom& room = room_of(opening.kind, opening.room);
    if (!(opening.head_m > opening.sill_m))
      throw InputError({}, "a " + opening.kind + " of room '" + opening.room + "' has no height",
                       "give its feature \"sill\" and \"head\" in metres over the floor");
    room.openings.push_back({opening.kind, opening.a, opening.b, opening.sill_m, opening.head_m});
  }
  for (const TrueFurniture& piece : truth.furniture)
    room_of("piece of furniture", piece.room)
        .furniture.push_back({piece.type, piece.outline, piece.bottom_m, piece.top_m, false});
  return building;
}

}  // namespace gramap
