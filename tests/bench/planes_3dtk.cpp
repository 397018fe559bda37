// Peer: 3DTK, by way of its files, as it is no Debian package (docs/benchmarks.md says how to run it).
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "geometry/file.h"
#include "perception/plane_fit.h"
#include "tests/bench/planes.h"

namespace gramap::bench {
namespace {

/// 3DTK's axes: left-handed, y up, centimetres.
Vec3 in_3dtk(const Vec3& p) {
  return 100 * Vec3(-p.y(), p.z(), p.x());
}

Vec3 from_3dtk(const Vec3& p) {
  return Vec3(p.z(), -p.x(), p.y()) / 100;
}

}  // namespace

void write_for_3dtk(const std::filesystem::path& folder, std::span<const Point> points) {
  std::string text;
  char line[100];
  for (const Point& point : points) {
    const Vec3 p = in_3dtk(point.cast<double>());
    text.append(line, static_cast<std::size_t>(
                          std::snprintf(line, sizeof line, "%.5f %.5f %.5f\n", p.x(), p.y(), p.z())));
  }
  make_folder(folder);
  write_file(folder / "scan000.3d", text);
  write_file(folder / "scan000.pose", "0 0 0\n0 0 0\n");
}

std::vector<FoundPlane> planes_of_3dtk(const std::filesystem::path& folder) {
  std::vector<FoundPlane> planes;
  for (int i = 0;; ++i) {
    char name[40];
    std::snprintf(name, sizeof name, "plane%03d.3d", i);
    std::ifstream hull(folder / name);
    if (!hull) return planes;
    Moments moments;
    int corners = 0;
    for (double x, y, z; hull >> x >> y >> z; ++corners) moments.add(from_3dtk(Vec3(x, y, z)));
    if (corners < 3) continue;
    const FittedPlane plane = fit_plane(moments);
    planes.push_back({plane.normal, plane.rho_m});
  }
}

}  // namespace gramap::bench
