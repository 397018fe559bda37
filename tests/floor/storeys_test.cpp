#include "floor/storeys.h"

#include <doctest/doctest.h>

#include "geometry/error.h"

using namespace gramap;

namespace {

FloorGroundTruth storey(const std::string& name, double elevation, double stairs_x) {
  FloorGroundTruth floor;
  floor.name = name;
  floor.elevation_m = elevation;
  floor.fixed.push_back(
      {"stairs_" + name, "Stairs", "", {{stairs_x, 0}, {stairs_x + 3, 0}, {stairs_x + 3, 6}, {stairs_x, 6}}});
  return floor;
}

}  // namespace

TEST_CASE("stairs that stand on one another pass, shifted and missing ones are named") {
  CHECK(check_cores({storey("a", 0, 10), storey("b", 3, 10), storey("c", 6, 10)}).empty());
  const auto shifted = check_cores({storey("b", 3, 10.5), storey("a", 0, 10)});
  REQUIRE(shifted.size() == 1);
  CHECK(shifted[0].find("0.50 m") != std::string::npos);
  CHECK(shifted[0].find("stairs_a of a and stairs_b of b") != std::string::npos);
  FloorGroundTruth none = storey("b", 3, 10);
  none.fixed.clear();
  const auto missing = check_cores({storey("a", 0, 10), none, storey("c", 6, 10)});
  REQUIRE(missing.size() == 1);
  CHECK(missing[0].find("b between them has none") != std::string::npos);
}

TEST_CASE("two floors at one height are refused") {
  CHECK_THROWS_AS(storey_order({storey("a", 3, 10), storey("b", 3, 10)}), InputError);
  CHECK(storey_order({storey("b", 3, 10), storey("a", 0, 10)}) == std::vector<std::size_t>{1, 0});
}
