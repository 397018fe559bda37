#include "perception/hough.h"

#include <doctest/doctest.h>

#include <cmath>

#include "tests/support/room_cloud.h"

using namespace gramap;

namespace {

const Polygon kRoom = {{0, 0}, {5, 0}, {5, 4}, {0, 4}};

}  // namespace

TEST_CASE("the six faces of a room are found on every seed, exactly, with no others") {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    test::RoomRecipe recipe{.ring = kRoom, .points = 100000, .stray_share = 0.1, .seed = seed};
    const std::vector<Point> points = test::room_points(recipe);
    const std::vector<PlanePatch> planes = detect_planes(points, {.seed = seed});
    CHECK(planes.size() == 6);
    for (const PlanePatch& plane : planes) {
      const int axis = std::abs(plane.normal.x()) > 0.9 ? 0 : std::abs(plane.normal.y()) > 0.9 ? 1 : 2;
      CHECK(std::abs(plane.normal[axis]) > 1 - 1e-6);
      const double far = axis == 0 ? 5 : axis == 1 ? 4 : 2.7;
      // Distance of the found plane from the true face, root mean square over the face's corners.
      double squares = 0;
      const double place = plane.rho_m > far / 2 ? far : 0;
      for (int corner = 0; corner < 4; ++corner) {
        Vec3 p(corner & 1 ? 5 : 0, corner & 2 ? 4 : 0, corner & 1 ? 2.7 : 0);
        if (axis == 0) p = Vec3(place, corner & 2 ? 4 : 0, corner & 1 ? 2.7 : 0);
        if (axis == 1) p = Vec3(corner & 2 ? 5 : 0, place, corner & 1 ? 2.7 : 0);
        if (axis == 2) p = Vec3(corner & 2 ? 5 : 0, corner & 1 ? 4 : 0, place);
        squares += plane.distance(p) * plane.distance(p) / 4;
      }
      CHECK(std::sqrt(squares) < 0.001);
      CHECK(plane.rms_m == doctest::Approx(0.01).epsilon(0.1));
    }
  }
}

TEST_CASE(
    "the cube of the ball accumulator's paper: six faces under ten centimetres of noise, however turned") {
  for (int turn = 0; turn < 9; ++turn) {
    Random random(static_cast<std::uint64_t>(turn + 1));
    const Eigen::Matrix3f rotation =
        (Eigen::AngleAxisf(static_cast<float>(turn) * 0.174f, Eigen::Vector3f(1, 2, 3).normalized()))
            .toRotationMatrix();
    std::vector<Point> points;
    for (int face = 0; face < 6; ++face)
      for (int i = 0; i < 10000; ++i) {
        Point p;
        p[face / 2] = static_cast<float>((face % 2 ? 4.0 : 0.0) + random.uniform(-0.1, 0.1));
        p[(face / 2 + 1) % 3] = static_cast<float>(random.uniform(0, 4));
        p[(face / 2 + 2) % 3] = static_cast<float>(random.uniform(0, 4));
        points.push_back(rotation * p);
      }
    const std::vector<PlanePatch> planes =
        detect_planes(points, {.min_pair_m = 0.5, .max_pair_m = 2, .max_distance_m = 0.15});
    int faces = 0;
    for (const PlanePatch& plane : planes) faces += plane.support > 6000;
    CHECK(faces == 6);
  }
}

TEST_CASE("the same cloud gives the same planes; too little or senseless input gives none") {
  const std::vector<Point> points = test::room_points({.ring = kRoom, .points = 5000});
  const std::vector<PlanePatch> a = detect_planes(points), b = detect_planes(points);
  REQUIRE(a.size() == b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    CHECK(a[i].normal == b[i].normal);
    CHECK(a[i].rho_m == b[i].rho_m);
  }
  CHECK(detect_planes({}).empty());
  CHECK(detect_planes(std::vector<Point>(1, Point(1, 2, 3))).empty());
  CHECK(detect_planes(std::vector<Point>(5000, Point(1, 2, 3))).empty());
  std::vector<Point> line;
  for (int i = 0; i < 5000; ++i) line.emplace_back(static_cast<float>(i) * 0.001f, 1, 1);
  CHECK(detect_planes(line).empty());
}
