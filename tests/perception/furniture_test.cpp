#include "perception/furniture.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "geometry/overlap.h"
#include "geometry/polygon.h"
#include "perception/models.h"
#include "perception/training.h"

using namespace gramap;

namespace {

Polygon box(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

Building room_with(std::vector<BuildingFurniture> furniture) {
  return {{{"room", box(0, 0, 5, 4.5), 0, 2.7, {}, std::move(furniture)}}};
}

std::vector<FurnitureObservation> found_in(const Building& building) {
  SimulateOptions options;
  options.points_per_room = 80000;
  const TrainingRoom known = known_rooms(building, options, 0)[0];
  auto found = find_furniture(known.cloud, known.room, shipped_furniture_forest());
  return found;
}

}  // namespace

TEST_CASE("an empty room has no furniture") {
  CHECK(found_in(room_with({})).empty());
}

TEST_CASE("a table, a stool and a cupboard are found and told apart") {
  const Building building = room_with({{"table", box(1.5, 1.5, 3.1, 2.3), 0, 0.75, false},
                                       {"chair", box(2.1, 2.5, 2.5, 2.9), 0, 0.45, false},
                                       {"other", box(4.5, 1, 4.99, 2.3), 0, 2.0, false}});
  SimulateOptions options;
  options.points_per_room = 80000;
  const TrainingRoom known = known_rooms(building, options, 0)[0];
  const auto found = find_furniture(known.cloud, known.room, shipped_furniture_forest());
  REQUIRE(found.size() == 3);
  for (const BuildingFurniture& piece : known.truth.furniture) {
    INFO("the ", piece.type);
    const auto same = [&](const FurnitureObservation& one) {
      return intersection_over_union(one.footprint, piece.outline) > 0.75 && one.type == piece.type &&
             std::abs(one.top_m - piece.top_m) < 0.1;
    };
    CHECK(std::count_if(found.begin(), found.end(), same) == 1);
  }
}

TEST_CASE("tables side by side stay two, a cupboard known by its front alone reaches the wall") {
  const Building building = room_with({{"table", box(1.5, 1.2, 3.1, 1.999), 0, 0.75, false},
                                       {"table", box(1.5, 2.001, 3.1, 2.8), 0, 0.75, false},
                                       {"other", box(0.01, 0.01, 1.2, 0.5), 0, 2.2, false}});
  const auto found = found_in(building);
  int tables = 0, others = 0;
  for (const FurnitureObservation& one : found) tables += one.type == "table", others += one.type == "other";
  CHECK(tables == 2);
  CHECK(others == 1);
}

TEST_CASE("no points or no outline give nothing") {
  TrainingRoom known = known_rooms(room_with({}), {}, 0)[0];
  known.cloud.points_m.clear();
  CHECK(find_furniture(known.cloud, known.room, shipped_furniture_forest()).empty());
  known.room.outline.clear();
  CHECK(find_furniture(known.cloud, known.room, shipped_furniture_forest()).empty());
}
