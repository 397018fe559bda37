// How fast scans are read, one core: megabytes of the file and points a second, by format. A Markdown table.
//
// usage: bench_readers [POINTS [RUNS]]     (2000000, 5; the fastest run counts)
// The files are made in a temporary folder and removed; they are in the page cache, so that no disk is
// measured.
#include <zlib.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <string>

#include "geometry/file.h"
#include "perception/compressed_cloud.h"
#include "perception/point_reader.h"
#include "perception/random.h"
#include "perception/simulate.h"
#include "tests/support/bench_main.h"

using namespace gramap;
namespace fs = std::filesystem;

namespace {

/// The points of a room of 6 × 5 × 3 m, to the millimetre.
std::vector<Vec3> cloud(std::size_t count) {
  Random random(1);
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < count; ++i)
    points.emplace_back(random.uniform(-3, 3), random.uniform(-2.5, 2.5), random.uniform(-1.5, 1.5));
  return points;
}

std::string with_colours(const std::string& text) {
  std::string coloured;
  for (const char c : text) {
    if (c == '\n') coloured += " 120 64 255";
    coloured += c;
  }
  return coloured;
}

std::string binary_ply(const std::vector<Point>& points) {
  std::string bytes = "ply\nformat binary_little_endian 1.0\nelement vertex " +
                      std::to_string(points.size()) +
                      "\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
  return bytes.append(reinterpret_cast<const char*>(points.data()), points.size() * sizeof(Point));
}

void write_gz(const fs::path& path, const std::string& bytes) {
  const gzFile file = gzopen(path.c_str(), "wb6");
  gzwrite(file, bytes.data(), static_cast<unsigned>(bytes.size()));
  gzclose(file);
}

void print_row(const char* name, const fs::path& path, int runs) {
  double least_s = 1e9;
  std::size_t points = 0;
  for (int run = 0; run < runs; ++run) {
    const std::clock_t begin = std::clock();
    points = read_points(path).size();
    least_s = std::min(least_s, static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
  }
  const auto bytes = static_cast<double>(fs::file_size(path));
  std::printf("| %s | %.1f | %.3f | %.0f | %.1f |\n", name, 1e-6 * bytes, least_s, 1e-6 * bytes / least_s,
              1e-6 * static_cast<double>(points) / least_s);
}

int run(int count, char** arguments) {
  const auto points = static_cast<std::size_t>(count > 1 ? std::max(1, std::atoi(arguments[1])) : 2000000);
  const int runs = count > 2 ? std::max(1, std::atoi(arguments[2])) : 5;
  std::string name = (fs::temp_directory_path() / "gramap_readersXXXXXX").string();
  if (!::mkdtemp(name.data())) return 1;
  const fs::path folder = name;
  const std::vector<Vec3> exact = cloud(points);
  std::vector<Point> single;
  for (const Vec3& p : exact) single.push_back(p.cast<float>());
  const std::string text = xyz_text(exact, 3);
  write_file(folder / "plain.xyz", text);
  write_file(folder / "coloured.xyz", with_colours(text));
  write_gz(folder / "packed.xyz.gz", text);
  write_file(folder / "binary.ply", binary_ply(single));
  write_file(folder / "octree.gpc", compress_points(single, 0.02));
  std::printf("| file | MB | CPU s | MB/s | million points/s |\n| --- | ---: | ---: | ---: | ---: |\n");
  print_row(".xyz", folder / "plain.xyz", runs);
  print_row(".xyz with colours", folder / "coloured.xyz", runs);
  print_row(".xyz.gz", folder / "packed.xyz.gz", runs);
  print_row(".ply, binary", folder / "binary.ply", runs);
  print_row(".gpc, voxels of 2 cm", folder / "octree.gpc", runs);
  fs::remove_all(folder);
  return 0;
}

}  // namespace

int main(int count, char** arguments) {
  return test::bench_main("bench_readers", [&] { return run(count, arguments); });
}
