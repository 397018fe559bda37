#include <doctest/doctest.h>
#include <unistd.h>
#include <zlib.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "geometry/error.h"
#include "perception/point_reader.h"
#include "perception/random.h"

using namespace gramap;

namespace {

struct File {
  std::filesystem::path path;
  File(const std::string& name, const std::string& bytes)
      : path(std::filesystem::temp_directory_path() / (std::to_string(::getpid()) + name)) {
    std::ofstream(path, std::ios::binary) << bytes;
  }
  ~File() { std::filesystem::remove(path); }
};

std::string bytes_of(std::initializer_list<float> values, bool swap = false) {
  std::string bytes;
  for (const float value : values) {
    char own[4];
    std::memcpy(own, &value, 4);
    if (swap) std::swap(own[0], own[3]), std::swap(own[1], own[2]);
    bytes.append(own, 4);
  }
  return bytes;
}

const std::string kPlyProperties =
    "element vertex 2\nproperty float x\nproperty uchar red\nproperty float y\nproperty float z\n";

std::string ply_body(bool swap) {
  return bytes_of({1}, swap) + "r" + bytes_of({2, 3}, swap) + bytes_of({-4}, swap) + "s" +
         bytes_of({5.5, 6}, swap);
}

std::string pcd_header(const std::string& data) {
  return "# .PCD v0.7\nVERSION 0.7\nFIELDS intensity x y z\nSIZE 4 4 4 4\nTYPE F F F F\nCOUNT 1 1 1 1\nWIDTH "
         "2\nHEIGHT 1\n"
         "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS 2\nDATA " +
         data + "\n";
}

/// Every kind of file with the points (1 2 3) and (-4 5.5 6).
std::vector<std::pair<std::string, std::string>> files() {
  // Compressed: field by field, as literal runs and one reference back (the four bytes 9 9 9 9).
  std::string fields = "\x01\x02\x03\x04\x05\x06\x07\x08" + bytes_of({1, -4, 2, 5.5, 3, 6});
  std::string packed;
  packed += static_cast<char>(31);
  packed += fields;
  const auto size = [](std::uint32_t value) { return std::string(reinterpret_cast<const char*>(&value), 4); };
  return {
      {"a.xyz", "1 2 3\n-4 5.5 6\n"},
      {"a.ply", "ply\nformat ascii 1.0\ncomment x\n" + kPlyProperties + "end_header\n1 9 2 3\n-4 9 5.5 6\n"},
      {"b.ply", "ply\nformat binary_little_endian 1.0\n" + kPlyProperties + "end_header\n" + ply_body(false)},
      {"c.ply", "ply\nformat binary_big_endian 1.0\n" + kPlyProperties + "end_header\n" + ply_body(true)},
      {"d.ply", "ply\nformat binary_little_endian 1.0\nelement camera 2\nproperty double f\n" +
                    kPlyProperties + "end_header\n0123456789abcdef" + ply_body(false)},
      {"a.pcd", pcd_header("ascii") + "7 1 2 3\n7 -4 5.5 6\n"},
      {"b.pcd", pcd_header("binary") + bytes_of({7, 1, 2, 3, 7, -4, 5.5, 6})},
      {"c.pcd",
       pcd_header("binary_compressed") + size(static_cast<std::uint32_t>(packed.size())) + size(32) + packed},
      {"a.3d", "-200 300 100\n-550 600 -400\n"},
  };
}

}  // namespace

TEST_CASE("every format gives the same points, packed with gzip too") {
  for (const auto& [name, bytes] : files()) {
    CAPTURE(name);
    for (const bool packed : {false, true}) {
      const File file(packed ? name + ".gz" : name, packed ? "" : bytes);
      if (packed) {
        gzFile out = gzopen(file.path.c_str(), "wb");
        gzwrite(out, bytes.data(), static_cast<unsigned>(bytes.size()));
        gzclose(out);
      }
      const std::vector<Point> points = read_points(file.path);
      REQUIRE(points.size() == 2);
      CHECK((points[0] - Point(1, 2, 3)).norm() < 1e-6);
      CHECK((points[1] - Point(-4, 5.5, 6)).norm() < 1e-6);
    }
  }
}

TEST_CASE("no truncated or damaged file does more than throw") {
  Random random(7);
  for (const auto& [name, bytes] : files()) {
    const auto try_to_read = [&, &file_name = name](const std::string& damaged) {
      const File file(file_name, damaged);
      try {
        for (const Point& point : read_points(file.path)) CHECK(point.allFinite());
      } catch (const InputError& error) {
        CHECK(error.place.file == file.path.string());
        CHECK(std::strlen(error.what()) > 0);
      }
    };
    for (std::size_t cut = 0; cut < bytes.size(); cut += 3) try_to_read(bytes.substr(0, cut));
    for (int trial = 0; trial < 200; ++trial) {
      std::string damaged = bytes;
      for (int changes = random.below(4); changes >= 0; --changes)
        damaged[static_cast<std::size_t>(random.below(static_cast<int>(damaged.size())))] =
            static_cast<char>(random.below(256));
      try_to_read(damaged);
    }
  }
}

TEST_CASE("binary clouds that end early say how many points there were") {
  const std::string whole = files()[2].second;
  const File file("cut.ply", whole.substr(0, whole.size() - 5));
  std::string message;
  try {
    read_points(file.path);
  } catch (const InputError& error) {
    message = error.what();
  }
  CHECK(message == "the file ends after 1 of 2 points");
}

TEST_CASE("a cloud without one finite point is refused as such") {
  const File ply(
      "nan.ply",
      "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float "
      "z\nend_header\nnan nan nan\nnan 1 2\n");
  const File pcd("nan.pcd", pcd_header("binary") + bytes_of({7, NAN, 2, 3, 7, NAN, 5.5, 6}));
  for (const File* file : {&ply, &pcd}) {
    std::string message;
    try {
      read_points(file->path);
    } catch (const InputError& error) {
      message = error.what();
    }
    CHECK(message == "the scan has no points with finite coordinates");
  }
}
