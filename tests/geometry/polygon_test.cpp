#include "geometry/polygon.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace gramap;

TEST_CASE("an L-shaped ring far from the origin keeps its area and centre") {
  const Vec2 far(4.5e5, 5.4e6);
  Polygon ring;
  for (const Vec2& point : Polygon{{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 3}, {0, 3}})
    ring.push_back(point + far);
  CHECK(signed_area(ring) == doctest::Approx(6));
  CHECK((centroid(ring) - far - Vec2(1.5, 1)).norm() < 1e-8);
  CHECK(contains(ring, far + Vec2(0.5, 2.5)));
  CHECK_FALSE(contains(ring, far + Vec2(2, 2)));
  CHECK(distance_to_border(ring, far + Vec2(2, 2)) == doctest::Approx(1));
}

TEST_CASE("simplified drops points on straight lines and turns clockwise rings round") {
  const Polygon ring = simplified({{0, 0}, {0, 2}, {2, 2}, {2, 1}, {2, 0}, {1, 0}});
  CHECK(ring.size() == 4);
  CHECK(signed_area(ring) == doctest::Approx(4));
}

TEST_CASE("the oriented box of a turned rectangle is the rectangle") {
  const Vec2 u(std::cos(0.3), std::sin(0.3)), v(-u.y(), u.x());
  for (const double length : {2.0, 5.0}) {
    const OrientedBox box = oriented_box({Vec2(1, 1), 1 * u + Vec2(1, 1), length * v + Vec2(1, 1),
                                          1 * u + length * v + Vec2(1, 1), 0.5 * u + Vec2(1, 1)});
    CHECK(box.length_m == doctest::Approx(length));
    CHECK(box.breadth_m == doctest::Approx(1));
    const Vec2 across(-box.axis.y(), box.axis.x());
    const Vec2 centre = box.corner + box.axis * box.length_m / 2 + across * box.breadth_m / 2;
    CHECK((centre - Vec2(1, 1) - 0.5 * u - length / 2 * v).norm() < 1e-12);
  }
}
