#include "geometry/overlap.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace gramap;

TEST_CASE("a unit square and the same turned by 45 degrees share a regular octagon") {
  const double r = std::sqrt(0.5);
  const Polygon square = {{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}};
  const Polygon turned = {{0, -r}, {r, 0}, {0, r}, {-r, 0}};
  const double octagon = 2 * (std::sqrt(2.0) - 1);
  CHECK(shared_area(square, turned) == doctest::Approx(octagon));
  CHECK(shared_area(turned, square) == doctest::Approx(octagon));
  CHECK(shared_area(Polygon(square.rbegin(), square.rend()), turned) == doctest::Approx(octagon));
  CHECK(intersection_over_union(square, turned) == doctest::Approx(octagon / (2 - octagon)));
}

TEST_CASE("an L and a bar across its notch share two pieces") {
  const Polygon u = {{0, 0}, {5, 0}, {5, 3}, {4, 3}, {4, 1}, {1, 1}, {1, 3}, {0, 3}};
  const Polygon bar = {{-1, 2}, {6, 2}, {6, 2.5}, {-1, 2.5}};
  CHECK(shared_area(u, bar) == doctest::Approx(1));
  CHECK(shared_area(u, u) == doctest::Approx(9));
  CHECK(shared_area(u, {{10, 0}, {11, 0}, {11, 1}}) == 0);
}
