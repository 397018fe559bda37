#include "geometry/mesh.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "geometry/watertight.h"

using namespace gramap;

namespace {

bool has(const std::vector<MeshFault>& faults, MeshFault::Kind kind) {
  return std::any_of(faults.begin(), faults.end(), [kind](const MeshFault& f) { return f.kind == kind; });
}

/// Nine unit squares: point (x, y) is 4 y + x.
std::vector<Vec2> grid_points() {
  std::vector<Vec2> points;
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 4; ++x) points.emplace_back(x, y);
  return points;
}
std::vector<Triangle> square(int x, int y) {
  const int a = 4 * y + x;
  return {{a, a + 1, a + 5}, {a, a + 5, a + 4}};
}

}  // namespace

TEST_CASE("a box is a solid of its volume") {
  const Mesh mesh = box({1, 2, 3}, Vec2(0.6, 0.8), Vec2(-0.8, 0.6), 4, 2, 0.5);
  CHECK(check_solid(mesh).empty());
  CHECK(signed_volume(mesh) == doctest::Approx(4));
  CHECK(mesh.triangles.size() == 12);
}

TEST_CASE("prisms side by side make one solid, with holes through it and steps in it") {
  std::vector<PrismCell> cells;
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 3; ++x) {
      PrismCell cell{square(x, y), {{0, 3}}};
      if (x == 1 && y == 0) cell.heights_m = {{0, 0.5}, {2, 3}};
      if (x == 2 && y == 2) cell.heights_m = {{0, 2.5}};
      if (x == 0 && y == 2) cell.heights_m = {};
      cells.push_back(cell);
    }
  const Mesh mesh = extrude(grid_points(), cells);
  CHECK(check_solid(mesh).empty());
  CHECK(signed_volume(mesh) == doctest::Approx(6 * 3 + 1.5 + 2.5));
}

TEST_CASE("cells that touch in an edge only are no 2-manifold, and it is said") {
  const Mesh mesh = extrude(grid_points(), {{square(0, 0), {{0, 1}}}, {square(1, 1), {{0, 1}}}});
  CHECK(has(check_solid(mesh), MeshFault::Kind::non_manifold));
}

TEST_CASE("every kind of fault is found") {
  const Mesh good = box(Vec3::Zero(), Vec2::UnitX(), Vec2::UnitY(), 1, 1, 1);
  REQUIRE(check_solid(good).empty());
  Mesh mesh = good;
  SUBCASE("a missing face") {
    mesh.triangles.pop_back();
    CHECK(has(check_solid(mesh), MeshFault::Kind::open_edge));
  }
  SUBCASE("a face turned over") {
    std::swap(mesh.triangles[0][0], mesh.triangles[0][1]);
    CHECK(has(check_solid(mesh), MeshFault::Kind::orientation));
  }
  SUBCASE("inside out") {
    for (Triangle& t : mesh.triangles) std::swap(t[0], t[1]);
    CHECK(has(check_solid(mesh), MeshFault::Kind::inside_out));
  }
  SUBCASE("a triangle without area") {
    mesh.triangles.push_back({0, 1, 1});
    CHECK(has(check_solid(mesh), MeshFault::Kind::degenerate));
  }
  SUBCASE("two boxes through each other") {
    append(mesh, box({0.5, 0.5, 0.5}, Vec2::UnitX(), Vec2::UnitY(), 1, 1, 1));
    CHECK(has(check_solid(mesh), MeshFault::Kind::self_intersection));
  }
  SUBCASE("a corner pulled through the opposite side") {
    for (Vec3& p : mesh.points)
      if (p == Vec3(1, 1, 1)) p = Vec3(-1, -1, 0.5);
    CHECK_FALSE(check_solid(mesh).empty());
  }
  SUBCASE("a coordinate that is no number") {
    mesh.points[0].x() = std::nan("");
    CHECK(has(check_solid(mesh), MeshFault::Kind::not_finite));
  }
}

TEST_CASE("two separate boxes in one mesh are fine") {
  Mesh mesh = box(Vec3::Zero(), Vec2::UnitX(), Vec2::UnitY(), 1, 1, 1);
  append(mesh, box({3, 0, 0}, Vec2::UnitX(), Vec2::UnitY(), 1, 1, 1));
  CHECK(check_solid(mesh).empty());
}
