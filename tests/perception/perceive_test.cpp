#include "perception/perceive.h"

#include <doctest/doctest.h>

#include <cmath>

#include "geometry/error.h"
#include "tests/support/room_cloud.h"

using namespace gramap;

namespace {

/// The greatest distance of a true corner from the nearest corner found.
double corner_error_m(const Polygon& truth, const Polygon& found) {
  double worst = 0;
  for (const Vec2& corner : truth) {
    double nearest = 1e9;
    for (const Vec2& other : found) nearest = std::min(nearest, (corner - other).norm());
    worst = std::max(worst, nearest);
  }
  return worst;
}

struct Shape {
  const char* name;
  Polygon ring;
  Vec3 scanner;
};

const std::vector<Shape> kShapes = {
    {"box", {{0, 0}, {5, 0}, {5, 4}, {0, 4}}, {2, 2, 1.5}},
    {"hallway", {{0, 0}, {30, 0}, {30, 2}, {0, 2}}, {12, 1, 1.5}},
    {"L", {{0, 0}, {6, 0}, {6, 2.5}, {3, 2.5}, {3, 5}, {0, 5}}, {1.5, 1.5, 1.5}},
    {"T", {{0, 0}, {6, 0}, {6, 2}, {4, 2}, {4, 5}, {2, 5}, {2, 2}, {0, 2}}, {3, 1.5, 1.5}},
    {"bay", {{0, 0}, {5, 0}, {5, 4}, {3.5, 4}, {3, 4.8}, {2, 4.8}, {1.5, 4}, {0, 4}}, {2.5, 2, 1.5}},
    {"oblique", {{0, 0}, {6, 0}, {5, 4}, {0, 3}}, {2.5, 1.5, 1.5}},
};

}  // namespace

TEST_CASE("rooms of any shape come out with their corners, wherever they stand and however they are turned") {
  for (const Shape& shape : kShapes)
    for (const double turn : {0.0, 0.3, 2.0}) {
      CAPTURE(shape.name);
      CAPTURE(turn);
      const Vec2 shift(4000 * turn, -70);
      Eigen::Matrix2d rotation;
      rotation << std::cos(turn), -std::sin(turn), std::sin(turn), std::cos(turn);
      // The scan is made in the shape's own frame; the pose puts it in place.
      RoomScans scans =
          test::room_scan({.ring = shape.ring, .points = 80000, .stray_share = 0.02}, shape.scanner);
      Eigen::Isometry3d place = Eigen::Isometry3d::Identity();
      place.linear().topLeftCorner<2, 2>() = rotation;
      place.translation() << shift, 12;
      scans.scans[0].room_from_scanner = place * scans.scans[0].room_from_scanner;
      Polygon truth;
      for (const Vec2& corner : shape.ring) truth.push_back(rotation * corner + shift);
      const RoomObservation room = perceive_room(scans);
      CHECK(room.outline.size() == shape.ring.size());
      CHECK(corner_error_m(truth, room.outline) < 0.01);
      CHECK(signed_area(room.outline) == doctest::Approx(signed_area(shape.ring)).epsilon(0.005));
      CHECK(room.height.value_m == doctest::Approx(2.7).epsilon(0.002));
      CHECK(room.floor_z_m == doctest::Approx(12).epsilon(0.001));
      REQUIRE(room.walls.size() == room.outline.size());
      for (std::size_t i = 0; i < room.walls.size(); ++i) {
        CHECK(room.walls[i].a == room.outline[i]);
        CHECK(room.walls[i].b == room.outline[(i + 1) % room.outline.size()]);
      }
    }
}

TEST_CASE("a room observation survives being written and read") {
  RoomObservation room = perceive_room(test::room_scan({.ring = kShapes[2].ring}, kShapes[2].scanner));
  room.openings.push_back({"door", 2, 0.5, 0.9, 0, 2.1, 0.75});
  room.furniture.push_back({"table", {{1, 1}, {2, 1}, {2, 2}}, 0.7, 0.75, 0.5});
  room.remarks.push_back("with \"quotes\" and ü");
  const std::string text = to_json(room);
  CHECK(to_json(observation_from_json(text, "room.json")) == text);
}

TEST_CASE("observations that cannot be read are refused with the place of the fault") {
  const std::string good =
      to_json(perceive_room(test::room_scan({.ring = kShapes[0].ring}, kShapes[0].scanner)));
  const auto refusal = [](const std::string& text) {
    try {
      observation_from_json(text, "room.json");
    } catch (const InputError& error) {
      return to_string(error.place) + ": " + error.what();
    }
    return std::string("accepted");
  };
  CHECK(refusal("{\n\"a\": ,}") == "room.json:2: this is no JSON");
  CHECK(refusal("[]") == "room.json: expected an object at ''");
  CHECK(refusal("{}") == "room.json: expected a member at '/gramap'");
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    const auto at = text.find(from);
    REQUIRE(at != std::string::npos);
    return refusal(text.replace(at, from.size(), to));
  };
  CHECK(with("\"points\": 60000", "\"points\": -1") ==
        "room.json: expected a whole number that is not negative at '/points'");
  CHECK(with("\"floor_z_m\"", "\"floor\"") == "room.json: expected a member at '/floor_z_m'");
  for (std::size_t cut = 0; cut + 2 < good.size(); cut += 97)
    CHECK(refusal(good.substr(0, cut)) != "accepted");
}

TEST_CASE("scans that hold no room are refused with what was found") {
  RoomScans scans = test::room_scan({.ring = kShapes[0].ring}, kShapes[0].scanner);
  const auto refusal = [&] {
    try {
      perceive_room(scans);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  std::vector<Point>& points = scans.scans[0].points_m;
  const std::vector<Point> all = points;
  std::erase_if(points, [](const Point& p) { return p.z() < -1.4; });
  CHECK(refusal().find("no floor was found") == 0);
  points = all;
  std::erase_if(points, [](const Point& p) { return p.z() > 1.1; });
  CHECK(refusal().find("no ceiling was found") == 0);
  points.resize(3);
  CHECK(refusal() != "accepted");
}

TEST_CASE("a beam under the ceiling, which the scanner looks through beneath, is no wall") {
  const Polygon ring = {{0, 0}, {8, 0}, {8, 4}, {0, 4}};
  const Vec3 scanner(2, 2, 1.5);
  RoomScans scans = test::room_scan({.ring = ring, .points = 60000}, scanner);
  Random random(1);
  for (int i = 0; i < 3000; ++i) {
    const Vec3 on_face(5 + 0.01 * random.normal(), 4 * random.uniform(), 2.3 + 0.4 * random.uniform());
    scans.scans[0].points_m.push_back((on_face - scanner).cast<float>());
  }
  CHECK(corner_error_m(ring, perceive_room(scans).outline) < 0.02);
}
