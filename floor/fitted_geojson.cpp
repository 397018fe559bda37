#include "floor/fitted_geojson.h"

namespace gramap {

FloorTruth truth_of(const FittedFloor& fitted) {
  FloorTruth truth;
  const double elevation_m = fitted.floor.elevation_m;
  const auto add = [&](const std::vector<FittedRoom>& rooms, const char* type) {
    for (const FittedRoom& room : rooms) {
      const double height = room.height_m > 0 ? room.height_m : fitted.height_m;
      truth.rooms.push_back({room.id, room.type.empty() ? type : room.type, room.name, room.outline,
                             elevation_m, elevation_m + height});
      for (const FittedOpening& opening : room.openings)
        truth.openings.push_back({opening.kind, room.id, opening.a, opening.b, (opening.b - opening.a).norm(),
                                  opening.sill_m, opening.head_m});
      for (const FittedFurniture& piece : room.furniture)
        truth.furniture.push_back({room.id, piece.type, piece.outline, piece.bottom_m, piece.top_m});
    }
  };
  add(fitted.hallways, "Hallway");
  add(fitted.fixed, "Fixed");
  add(fitted.rooms, "");
  return truth;
}

std::string to_geojson(const FittedFloor& fitted) {
  FloorGroundTruth floor = fitted.floor;
  if (fitted.height_m > 0) floor.ceiling_height_m = fitted.height_m;
  if (fitted.inner_wall_m > 0) floor.inner_wall_m = fitted.inner_wall_m;
  if (fitted.outer_wall_m > 0) floor.outer_wall_m = fitted.outer_wall_m;
  return to_geojson(floor, truth_of(fitted));
}

}  // namespace gramap
