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
  const TrainingRoom known = known_rooms(building, {}, 0)[0];
  return find_furniture(known.cloud, known.room, shipped_furniture_forest());
}

/// Every piece is found where it is, as high as it is, and by its name; and nothing else is.
void check_each_found_once(const Building& building, double least_overlap) {
  SimulateOptions options;
  options.points_per_room = 80000;
  const TrainingRoom known = known_rooms(building, options, 0)[0];
  const auto found = find_furniture(known.cloud, known.room, shipped_furniture_forest());
  CHECK(found.size() == known.truth.furniture.size());
  for (const BuildingFurniture& piece : known.truth.furniture) {
    INFO("the ", piece.type, " of ", piece.top_m, " m");
    const auto same = [&](const FurnitureObservation& one) {
      return intersection_over_union(one.footprint, piece.outline) > least_overlap &&
             one.type == piece.type && std::abs(one.top_m - piece.top_m) < 0.1;
    };
    CHECK(std::count_if(found.begin(), found.end(), same) == 1);
  }
}

}  // namespace

TEST_CASE("an empty room has no furniture") {
  CHECK(found_in(room_with({})).empty());
}

TEST_CASE("a table, a stool and a cupboard are found and told apart") {
  const Building building = room_with({{"table", box(1.5, 1.5, 3.1, 2.3), 0, 0.75, false},
                                       {"chair", box(2.1, 2.5, 2.5, 2.9), 0, 0.45, false},
                                       {"other", box(4.5, 1, 4.99, 2.3), 0, 2.0, false}});
  check_each_found_once(building, 0.75);
}

TEST_CASE("a long table is one, wherever it stands") {
  check_each_found_once(room_with({{"table", box(1.6, 1.8, 3.2, 2.6), 0, 0.75, false}}), 0.75);
  check_each_found_once(room_with({{"table", box(0.01, 1.4, 0.81, 3.0), 0, 0.72, false}}), 0.75);
}

TEST_CASE("tables side by side stay two, a cupboard known by its front alone reaches the wall") {
  const Building building = room_with({{"table", box(1.5, 1.2, 3.1, 1.999), 0, 0.75, false},
                                       {"table", box(1.5, 2.001, 3.1, 2.8), 0, 0.75, false},
                                       {"other", box(0.01, 0.01, 1.2, 0.5), 0, 2.2, false}});
  const auto found = found_in(building);
  // The two make a square with no chair beside it: which way they meet cannot be told.
  std::vector<double> tables;
  for (const FurnitureObservation& one : found)
    if (one.type == "table") tables.push_back(signed_area(one.footprint));
  REQUIRE(tables.size() == 2);
  for (const double area : tables) CHECK(std::abs(area) == doctest::Approx(1.6 * 0.8).epsilon(0.2));
  const Polygon& cupboard = building.rooms[0].furniture[2].outline;
  CHECK(std::count_if(found.begin(), found.end(), [&](const FurnitureObservation& one) {
          return one.type == "other" &&
                 std::abs(signed_area(one.footprint)) > 0.6 * std::abs(signed_area(cupboard));
        }) == 1);
}

TEST_CASE("no points or no outline give nothing") {
  TrainingRoom known = known_rooms(room_with({}), {}, 0)[0];
  known.cloud.points_m.clear();
  CHECK(find_furniture(known.cloud, known.room, shipped_furniture_forest()).empty());
  known.room.outline.clear();
  CHECK(find_furniture(known.cloud, known.room, shipped_furniture_forest()).empty());
}
