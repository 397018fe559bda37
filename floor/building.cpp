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
  for (const TrueOpening& opening : truth.openings)
    if (const auto room = index.find(opening.room); room != index.end())
      building.rooms[room->second].openings.push_back(
          {opening.kind, opening.a, opening.b, opening.sill_m, opening.head_m});
  for (const TrueFurniture& piece : truth.furniture)
    if (const auto room = index.find(piece.room); room != index.end())
      building.rooms[room->second].furniture.push_back(
          {piece.type, piece.outline, piece.bottom_m, piece.top_m, false});
  return building;
}

}  // namespace gramap
