#include "perception/compressed_cloud.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "geometry/error.h"
#include "perception/random.h"

using namespace gramap;

namespace {

std::vector<Point> cloud(int count, std::uint64_t seed) {
  Random random(seed);
  std::vector<Point> points;
  for (int i = 0; i < count; ++i)
    points.emplace_back(static_cast<float>(random.uniform(-3, 4)), static_cast<float>(random.uniform(-2, 2)),
                        i % 3 ? -1.4f : static_cast<float>(random.uniform(-1.4, 1.3)));
  return points;
}

std::string refusal(const std::string& bytes) {
  try {
    decompress_points(bytes, "cut.gpc");
  } catch (const InputError& error) {
    CHECK(error.place.file == "cut.gpc");
    return error.what();
  }
  return "accepted";
}

}  // namespace

TEST_CASE("every point is within half a voxel's diagonal of one that was kept, and the other way round") {
  for (const double resolution : {0.005, 0.02, 0.1}) {
    const std::vector<Point> before = cloud(800, 3);
    const std::vector<Point> after = decompress_points(compress_points(before, resolution), "x");
    const auto limit = static_cast<float>(0.5 * std::sqrt(3.0) * resolution + 1e-5);
    const auto near = [&](const Point& p, const std::vector<Point>& others) {
      return std::any_of(others.begin(), others.end(),
                         [&](const Point& q) { return (p - q).norm() <= limit; });
    };
    CHECK(after.size() <= before.size());
    for (const Point& p : before) REQUIRE(near(p, after));
    for (const Point& p : after) REQUIRE(near(p, before));
  }
}

TEST_CASE("compressing again changes nothing but the order") {
  const std::string bytes = compress_points(cloud(5000, 5), 0.02);
  const std::vector<Point> once = decompress_points(bytes, "x");
  const std::vector<Point> twice = decompress_points(compress_points(once, 0.02), "x");
  REQUIRE(once.size() == twice.size());
  for (std::size_t i = 0; i < once.size(); ++i) CHECK((once[i] - twice[i]).norm() < 1e-5);
}

TEST_CASE("few points, far away points, none") {
  CHECK(decompress_points(compress_points({}, 0.02), "x").empty());
  const std::vector<Point> one = {Point(1000.01f, -2000.0f, 3)};
  const std::vector<Point> back = decompress_points(compress_points(one, 0.02), "x");
  REQUIRE(back.size() == 1);
  CHECK((back[0] - one[0]).norm() < 0.02);
  const std::vector<Point> apart = {Point(0, 0, 0), Point(1e6f, 0, 0)};
  CHECK_THROWS_AS(compress_points(apart, 0.02), InputError);
}

TEST_CASE("whatever is cut off or changed, the file is refused or read as some cloud") {
  const std::string whole = compress_points(cloud(300, 9), 0.02);
  for (std::size_t cut = 0; cut < whole.size(); ++cut) CHECK(refusal(whole.substr(0, cut)) != "accepted");
  CHECK(refusal("GRAMAPC2" + whole.substr(8)) ==
        "this is no compressed scan: it does not begin with GRAMAPC1");
  CHECK(refusal(std::string("GRAMAPC1") + std::string(200, '\xff')) == "the head of the file makes no sense");
  Random random(2);
  for (int trial = 0; trial < 500; ++trial) {
    std::string damaged = whole;
    damaged[static_cast<std::size_t>(random.below(static_cast<int>(damaged.size())))] ^=
        static_cast<char>(1 << random.below(8));
    refusal(damaged);
  }
}
