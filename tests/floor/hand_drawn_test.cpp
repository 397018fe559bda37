// Plans as people draw them, each corner some millimetres off and the whole at an angle: the walls between
// rooms that are nearly in line still make up a floor without remainder.
#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "floor/floor_of_truth.h"
#include "floor/model.h"
#include "floor/verify.h"

using namespace gramap;

namespace {

struct Drawn {
  FloorGroundTruth floor;
  FloorTruth truth;
};

/// A hallway with a row of rooms on either side, walls of 0.2 m, every corner up to `off_m` off.
Drawn hand_drawn(unsigned seed, double off_m) {
  std::mt19937 random(seed);
  const auto uniform = [&](double most) { return most * (static_cast<double>(random()) / 2147483648.0 - 1); };
  const double angle = 0.28 + uniform(0.2);
  const auto box = [&](double x0, double y0, double x1, double y1) {
    Polygon ring{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
    for (Vec2& p : ring) {
      p += Vec2(uniform(off_m), uniform(off_m));
      p = Vec2(std::cos(angle) * p.x() - std::sin(angle) * p.y(),
               std::sin(angle) * p.x() + std::cos(angle) * p.y());
    }
    return ring;
  };
  Drawn drawn;
  drawn.floor.inner_wall_m = 0.2;
  double length = 0;
  for (const double side : {0.0, 1.0}) {
    double x = 0;
    for (int i = 0; i < 8; ++i) {
      const double width = i % 3 == 2 ? 5.8 : 2.8;
      const double y = side > 0 ? 2.2 : -5.2;
      drawn.truth.rooms.push_back(
          {std::to_string(drawn.truth.rooms.size()), "Room", "", box(x, y, x + width, y + 5), 0, 2.7});
      x += width + 0.2;
    }
    length = x - 0.2;
  }
  drawn.floor.hallways = {{"H", "", box(0, 0, length, 2)}};
  return drawn;
}

}  // namespace

TEST_CASE("plans drawn by hand, corners off by one and five millimetres, are whole floors") {
  for (const double off_m : {1e-3, 5e-3})
    for (unsigned seed = 1; seed <= 150; ++seed) {
      CAPTURE(off_m);
      CAPTURE(seed);
      const Drawn drawn = hand_drawn(seed, off_m);
      const VerifyReport report = verify(build_model(floor_of_truth(drawn.floor, drawn.truth)));
      INFO(to_text(report));
      CHECK(report.ok());
    }
}
