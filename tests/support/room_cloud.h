// Clouds of rooms of any plan, made point by point: the simplest truth there is for tests of planes and
// outlines.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "geometry/polygon.h"
#include "perception/random.h"
#include "perception/scan.h"

namespace gramap::test {

struct RoomRecipe {
  Polygon ring;  ///< counter-clockwise
  double height_m = 2.7;
  double floor_z_m = 0;
  int points = 60000;
  double noise_m = 0.01;
  double stray_share = 0;  ///< of the points, anywhere in the box around
  std::uint64_t seed = 1;
};

/// Points spread evenly over floor, ceiling and walls, with noise across them.
inline std::vector<Point> room_points(const RoomRecipe& room) {
  Random random(room.seed);
  Vec2 low = room.ring.front(), high = low;
  double length = 0;
  for (std::size_t i = 0; i < room.ring.size(); ++i) {
    low = low.cwiseMin(room.ring[i]);
    high = high.cwiseMax(room.ring[i]);
    length += (room.ring[(i + 1) % room.ring.size()] - room.ring[i]).norm();
  }
  const double area = signed_area(room.ring), walls = length * room.height_m;
  std::vector<Point> points;
  const auto inside = [&] {
    while (true) {
      const Vec2 p(random.uniform(low.x(), high.x()), random.uniform(low.y(), high.y()));
      if (contains(room.ring, p)) return p;
    }
  };
  for (int i = 0; i < room.points; ++i) {
    Vec3 p;
    if (random.chance(room.stray_share)) {
      p << random.uniform(low.x(), high.x()), random.uniform(low.y(), high.y()),
          random.uniform(0, room.height_m);
    } else if (random.chance(walls / (walls + 2 * area))) {
      double along = random.uniform(0, length);
      std::size_t edge = 0;
      Vec2 way;
      for (;; ++edge) {
        way = room.ring[(edge + 1) % room.ring.size()] - room.ring[edge];
        if (along <= way.norm() || edge + 1 == room.ring.size()) break;
        along -= way.norm();
      }
      const Vec2 unit = way.normalized(), across(-unit.y(), unit.x());
      p << Vec2(room.ring[edge] + along * unit + room.noise_m * random.normal() * across),
          random.uniform(0, room.height_m);
    } else {
      p << inside(), (random.chance(0.5) ? 0 : room.height_m) + room.noise_m * random.normal();
    }
    p.z() += room.floor_z_m;
    points.push_back(p.cast<float>());
  }
  return points;
}

/// The same as one scan from `scanner`, in the room's frame.
inline RoomScans room_scan(const RoomRecipe& room, const Vec3& scanner) {
  RoomScans scans;
  scans.room = "room";
  scans.scans.resize(1);
  scans.scans[0].room_from_scanner.translation() = scanner;
  for (const Point& p : room_points(room)) scans.scans[0].points_m.push_back(p - scanner.cast<float>());
  return scans;
}

}  // namespace gramap::test
