#include "perception/raycast.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace gramap;

TEST_CASE("a ray hits the nearest of the faces in its way") {
  const Face near_face{{1, -1, -1}, {0, 2, 0}, {0, 0, 2}, {}};
  const Face far_face{{3, -1, -1}, {0, 2, 0}, {0, 0, 2}, {}};
  const FaceSet faces({far_face, near_face});
  CHECK(faces.distance({0, 0, 0}, {1, 0, 0}) == doctest::Approx(1));
  CHECK(faces.distance({2, 0, 0}, {1, 0, 0}) == doctest::Approx(1));
  CHECK(std::isinf(faces.distance({0, 0, 0}, {-1, 0, 0})));
  CHECK(std::isinf(faces.distance({0, 5, 0}, {1, 0, 0})));
  CHECK(std::isinf(faces.distance({0, 0, 0}, {0, 0, 1})));  // in the direction of the faces
}

TEST_CASE("a polygon face is hit inside its ring only") {
  Face floor;
  floor.origin = {0, 0, 0};
  floor.ring = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
  const FaceSet faces({floor});
  CHECK(faces.distance({0.5, 1.5, 2}, {0, 0, -1}) == doctest::Approx(2));
  CHECK(std::isinf(faces.distance({1.5, 1.5, 2}, {0, 0, -1})));
}

TEST_CASE("faces out of reach are left out, and the others still give the same hits") {
  const Face near_face{{1, -1, -1}, {0, 2, 0}, {0, 0, 2}, {}};
  const Face far_face{{30, -1, -1}, {0, 2, 0}, {0, 0, 2}, {}};
  const FaceSet reachable = FaceSet({near_face, far_face}).within({0, 0, 0}, 5);
  CHECK(reachable.distance({0, 0, 0}, {1, 0, 0}) == doctest::Approx(1));
  CHECK(std::isinf(reachable.distance({2, 0, 0}, {1, 0, 0})));
}
