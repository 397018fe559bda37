#include "perception/scan.h"

#include <doctest/doctest.h>

#include <unistd.h>
#include <cmath>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "geometry/error.h"
#include "perception/point_reader.h"

using namespace gramap;

namespace {

/// A folder of its own, gone at the end.
struct Folder {
  std::filesystem::path path;
  Folder() {
    static int number = 0;
    path = std::filesystem::temp_directory_path() /
           ("gramap_scan_test_" + std::to_string(::getpid()) + "_" + std::to_string(number++));
    std::filesystem::create_directories(path);
  }
  ~Folder() { std::filesystem::remove_all(path); }
  void write(const char* name, const std::string& text) const {
    std::ofstream(path / name, std::ios::binary) << text;
  }
};

std::string refusal(const Folder& folder) {
  try {
    read_room_scans(folder.path);
  } catch (const InputError& error) {
    const std::string place = to_string(error.place);
    CHECK(place.rfind(folder.path.string(), 0) == 0);
    return place.substr(folder.path.string().size()) + ": " + error.what();
  }
  return "accepted";
}

}  // namespace

TEST_CASE("numbers are read as the library reads them") {
  for (const char* text : {"0", "-0.147", "4.5e-3", "1E2", "+7.25", ".5", "3.", "123456789.123456789",
                           "0.00000000000000001234", "9007199254740993", "1e-320"}) {
    const char* at = text;
    double value = -1;
    CHECK(parse_number(at, text + std::strlen(text), value));
    CHECK(*at == 0);
    CHECK(value == std::strtod(text, nullptr));
  }
  for (const char* text : {"", "-", ".", "e5", "x", "--1"}) {
    const char* at = text;
    double value = 0;
    CHECK_FALSE(parse_number(at, text + std::strlen(text), value));
  }
}

TEST_CASE("a pose brings points home by the formula of 3DTK's frame") {
  const Eigen::Isometry3d pose = pose_from_text("-453.668 412.5539 471.9983\n10 20 30\n", "p");
  const double d = M_PI / 180;
  const Vec3 p(0.3, -1.2, 0.8);
  Vec3 left(-100 * p.y(), 100 * p.z(), 100 * p.x());
  const auto turn = [&](double angle, const Vec3& axis) {
    return Eigen::AngleAxisd(angle * d, axis).toRotationMatrix();
  };
  left = turn(10, Vec3::UnitX()) * turn(20, Vec3::UnitY()) * turn(30, Vec3::UnitZ()) * left +
         Vec3(-453.668, 412.5539, 471.9983);
  CHECK((pose * p - Vec3(left.z(), -left.x(), left.y()) / 100).norm() < 1e-12);
  CHECK((pose_from_text(pose_to_text(pose), "p").matrix() - pose.matrix()).norm() < 1e-6);
}

TEST_CASE("scans are read in order, with further columns, comments, Windows line ends and no last line end") {
  const Folder folder;
  folder.write("scan001.xyz", "# made by hand\r\n1 2 3 17 0.5 red\r\n\r\n  4,5,6\r\n-1.5e0;2;.5");
  folder.write("scan000.xyz", "0 0 1\n");
  folder.write("scan001.pose", "0 100 0 0 0 0");
  const RoomScans room = read_room_scans(folder.path);
  REQUIRE(room.scans.size() == 2);
  CHECK(room.scans[0].file.filename() == "scan000.xyz");
  REQUIRE(room.scans[1].points_m.size() == 3);
  CHECK(room.scans[1].points_m[2] == Point(-1.5f, 2, 0.5f));
  CHECK(room.scans[1].room_from_scanner.translation() == Vec3(0, 0, 1));
  const RegisteredCloud cloud = registered(room);
  CHECK((cloud.points_m[3].cast<double>() + cloud.origin_m - Vec3(-1.5, 2, 1.5)).norm() < 1e-6);
}

TEST_CASE("a scan that is there in several formats is read once, and the other files are named") {
  const Folder folder;
  folder.write("scan000.xyz", "1 2 3\n");
  folder.write("scan000.gpc", "never read");
  folder.write("scan000.xyz.gz", "never read");
  folder.write("scan001.xyz", "4 5 6\n");
  folder.write("scan000.pose", "0 100 0 0 0 0");
  const RoomScans room = read_room_scans(folder.path);
  REQUIRE(room.scans.size() == 2);
  CHECK(room.scans[0].points_m == std::vector<Point>{Point(1, 2, 3)});
  CHECK(room.scans[1].points_m == std::vector<Point>{Point(4, 5, 6)});
  const std::vector<std::string> remarks{"scan000.xyz.gz was not read: scan000.xyz is the same scan",
                                         "scan000.gpc was not read: scan000.xyz is the same scan"};
  CHECK(room.remarks == remarks);
  CHECK(registered(room).remarks == remarks);
}

TEST_CASE("lines longer than a piece of the file are read whole") {
  const Folder folder;
  std::string text;
  for (int i = 0; i < 200000; ++i) text += "1.25 -2.5 " + std::to_string(i % 10) + " 255 255 255\n";
  folder.write("scan000.xyz", text);
  const RoomScans room = read_room_scans(folder.path);
  REQUIRE(room.scans[0].points_m.size() == 200000);
  for (int i = 0; i < 200000; ++i)
    REQUIRE(room.scans[0].points_m[i] == Point(1.25f, -2.5f, static_cast<float>(i % 10)));
}

TEST_CASE("what is wrong with a scan is said with its place") {
  struct Case {
    const char *cloud, *pose, *message;
  };
  const Case cases[] = {
      {"", "0 0 0 0 0 0", "/scan000.xyz: the scan has no points"},
      {"\n# nothing\n", "0 0 0 0 0 0", "/scan000.xyz: the scan has no points"},
      {"1 2 3\n1 2\n", "0 0 0 0 0 0", "/scan000.xyz:2:4: expected three coordinates 'x y z', found '1 2'"},
      {"1 2 3\n1 nan 3\n", "0 0 0 0 0 0", "/scan000.xyz:2:3: the coordinate is not a finite number"},
      {"1 2 inf\n", "0 0 0 0 0 0", "/scan000.xyz:1:5: the coordinate is not a finite number"},
      {"1 2 1e999\n", "0 0 0 0 0 0", "/scan000.xyz:1:5: the coordinate is not a finite number"},
      {"x y z\n", "0 0 0 0 0 0", "/scan000.xyz:1:1: expected three coordinates 'x y z', found 'x y z'"},
      {"1 2 3m\n", "0 0 0 0 0 0", "/scan000.xyz:1:5: expected three coordinates 'x y z', found '1 2 3m'"},
      {"1 2 3\n", "0 0 0 0 0", "/scan000.pose:1: expected six numbers in the pose, found 5"},
      {"1 2 3\n", "0 0 0\n0 0 0 1\n", "/scan000.pose:3: expected six numbers in the pose, found 7"},
      {"1 2 3\n", "0 0 0\n0 zero 0\n", "/scan000.pose:2: expected a number in the pose"},
      {"2000 1000 1500\n3000 0 20\n", "0 0 0 0 0 0",
       "/scan000.xyz: half of the points are more than 3000 m from the scanner: this looks like millimetres"},
      {"200 100 150\n300 0 2\n", "0 0 0 0 0 0",
       "/scan000.xyz: half of the points are more than 300 m from the scanner: this looks like centimetres"},
  };
  for (const Case& c : cases) {
    const Folder folder;
    folder.write("scan000.xyz", c.cloud);
    folder.write("scan000.pose", c.pose);
    CHECK(refusal(folder) == c.message);
  }
  CHECK(refusal(Folder()) == ": there are no scans here");
}
