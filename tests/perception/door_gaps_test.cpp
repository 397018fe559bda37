#include "perception/door_gaps.h"

#include <doctest/doctest.h>

using namespace gramap;

namespace {

/// A hallway of 10 m x 2 m seen from its middle: one wall has a door at 3.0 to 4.0 m and a window at 6.0
/// to 7.0 m, both open.
struct Scene {
  RoomObservation room;
  RegisteredCloud cloud;
};

Scene scene() {
  Scene result;
  result.room.outline = {{0, 0}, {10, 0}, {10, 2}, {0, 2}};
  for (std::size_t i = 0; i < 4; ++i) {
    WallObservation wall;
    wall.a = result.room.outline[i], wall.b = result.room.outline[(i + 1) % 4];
    result.room.walls.push_back(wall);
  }
  const Vec3 scanner(5, 1, 1.4);
  // One ray through the middle of every 2 cm patch of the wall y = 0.
  for (double x = 0.01; x < 10; x += 0.02)
    for (double z = 0.01; z < 2.7; z += 0.02) {
      const bool door = x > 3 && x < 4 && z<2.1, window = x> 6 && x < 7 && z > 0.9 && z < 2.4;
      const Vec3 on_wall(x, 0, z);
      result.cloud.points_m.push_back(
          (door || window ? scanner + (on_wall - scanner) * 2.0 : on_wall).cast<float>());
    }
  result.cloud.parts.push_back({scanner, 0, result.cloud.points_m.size()});
  return result;
}

}  // namespace

TEST_CASE("an open door is a gap in the wall, a window above its parapet is not") {
  const Scene s = scene();
  const auto doors = find_door_gaps(s.cloud, s.room);
  REQUIRE(doors.size() == 1);
  CHECK(doors[0].kind == "door");
  CHECK(doors[0].wall == 0);
  CHECK(doors[0].start_m == doctest::Approx(3).epsilon(0.02));
  CHECK(doors[0].width_m == doctest::Approx(1).epsilon(0.06));
  CHECK(doors[0].confidence > 0.9);
}

TEST_CASE("a wall that nobody looked through has no doors") {
  Scene s = scene();
  for (Point& point : s.cloud.points_m) point.y() = 0;
  CHECK(find_door_gaps(s.cloud, s.room).empty());
}
