// Plane detection beside its peers on the same clouds, one core each: CPU seconds, how many of the room's six
// faces were found, planes that are none, error, memory. A Markdown table.
//
// usage: bench_planes [CLOUDS_PER_ROW] [MOST_POINTS] [FOLDER_OF_SCANS] [METHOD]     (3, 1000000; a folder's
// cloud has no truth: what share of its points lies within 5 cm of a plane is printed instead; - for none.
// METHOD: this one only, "gramap" for ours)
//        bench_planes --3dtk FOLDER [POINTS]    (100000) writes each cloud to a folder in FOLDER, for 3DTK;
//        where
// 3DTK's planes are there (planes/plane000.3d, …), a row is printed instead
//
// The room: 5 × 4 × 2.8 m turned by 17°, a door and a window left open, a table, two chairs, a cupboard; a
// tenth of the points on these things, and, in the rows with stray points, a tenth anywhere in the volume. A
// face is found when the plane's RMS distance from the true rectangle is below 3 cm; that distance is the
// error. A plane is false when it is neither a face nor a side of a thing.
#include <sys/resource.h>
#include <sys/wait.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <optional>

#include "perception/hough.h"
#include "perception/random.h"
#include "tests/bench/planes.h"
#include "tests/support/bench_main.h"

using namespace gramap;
using namespace gramap::bench;

namespace {

/// corner + s·a + t·b with s, t in [0, 1].
struct Rectangle {
  Vec3 corner, a, b;
  double area() const { return a.cross(b).norm(); }
  Vec3 normal() const { return a.cross(b).normalized(); }
  Vec3 at(double s, double t) const { return corner + s * a + t * b; }
};

struct Scene {
  std::vector<Rectangle> faces;   // floor, ceiling, four walls
  std::vector<Rectangle> things;  // sides of furniture
  std::vector<Rectangle> holes;   // in faces
  Vec3 low, high;
};

/// The sides of a cupboard that a scanner sees: its back stands at the wall of greatest x.
void add_cupboard(std::vector<Rectangle>& sides, const Vec3& low, const Vec3& size) {
  const Vec3 x(size.x(), 0, 0), y(0, size.y(), 0), z(0, 0, size.z());
  for (const Rectangle& side :
       {Rectangle{low + z, x, y}, Rectangle{low, x, z}, Rectangle{low + y, x, z}, Rectangle{low, y, z}})
    sides.push_back(side);
}

Scene furnished_room() {
  Scene scene;
  const Vec3 x(5, 0, 0), y(0, 4, 0), z(0, 0, 2.8), o = Vec3::Zero();
  scene.faces = {{o, x, y}, {z, x, y}, {o, x, z}, {y, x, z}, {o, y, z}, {x, y, z}};
  scene.holes = {{{1, 0, 0}, {0.9, 0, 0}, {0, 0, 2.1}}, {{2, 4, 0.9}, {1.5, 0, 0}, {0, 0, 1.3}}};
  scene.things.push_back({{2, 1.5, 0.74}, {1.6, 0, 0}, {0, 0.8, 0}});
  for (const double at : {2.3, 3.0}) {
    scene.things.push_back({{at, 1.0, 0.45}, {0.45, 0, 0}, {0, 0.45, 0}});
    scene.things.push_back({{at, 1.0, 0.45}, {0.45, 0, 0}, {0, 0, 0.45}});
  }
  add_cupboard(scene.things, {4.35, 2.0, 0}, {0.6, 1.2, 1.9});
  scene.low = o;
  scene.high = x + y + z;
  const Eigen::AngleAxisd turn(17 * 3.141592653589793 / 180, Vec3::UnitZ());
  for (std::vector<Rectangle>* list : {&scene.faces, &scene.things, &scene.holes})
    for (Rectangle& r : *list) r = {turn * r.corner, turn * r.a, turn * r.b};
  return scene;
}

bool in_hole(const Scene& scene, const Vec3& p) {
  return std::any_of(scene.holes.begin(), scene.holes.end(), [&](const Rectangle& hole) {
    const Vec3 d = p - hole.corner;
    const double s = d.dot(hole.a) / hole.a.squaredNorm(), t = d.dot(hole.b) / hole.b.squaredNorm();
    return std::abs(d.dot(hole.normal())) < 1e-6 && s > 0 && s < 1 && t > 0 && t < 1;
  });
}

std::vector<Point> sampled(const Scene& scene, std::size_t count, double noise_m, double stray_share,
                           std::uint64_t seed) {
  Random random(seed);
  const auto draw = [&](const std::vector<Rectangle>& from) {
    double total = 0;
    for (const Rectangle& r : from) total += r.area();
    double at = random.uniform(0, total);
    std::size_t i = 0;
    while (i + 1 < from.size() && at > from[i].area()) at -= from[i++].area();
    return std::pair{from[i], from[i].at(random.uniform(), random.uniform())};
  };
  const Eigen::AngleAxisd turn(17 * 3.141592653589793 / 180, Vec3::UnitZ());
  std::vector<Point> points;
  points.reserve(count);
  while (points.size() < count) {
    if (random.chance(stray_share)) {
      const Vec3 size = scene.high - scene.low;
      points.push_back(
          (turn * Vec3(random.uniform() * size.x(), random.uniform() * size.y(), random.uniform() * size.z()))
              .cast<float>());
      continue;
    }
    const auto [face, p] = draw(random.chance(0.1) ? scene.things : scene.faces);
    if (in_hole(scene, p)) continue;
    points.push_back((p + noise_m * random.normal() * face.normal()).cast<float>());
  }
  return points;
}

double rms_from(const FoundPlane& plane, const Rectangle& r) {
  double sum = 0;
  for (int i = 0; i <= 4; ++i)
    for (int j = 0; j <= 4; ++j) {
      const double d = plane.normal.dot(r.at(i / 4.0, j / 4.0)) - plane.rho_m;
      sum += d * d;
    }
  return std::sqrt(sum / 25);
}

struct Result {
  double cpu_s = 0, peak_mb = 0;
  int planes = 0, faces = 0, false_planes = 0;
  double error_m = 0;     // mean over the faces found
  double near_share = 0;  // of the points, within 5 cm of a plane
};

double cpu_seconds() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

Result judged(const std::vector<FoundPlane>& planes, const Scene& scene, std::span<const Point> points) {
  Result result;
  result.planes = static_cast<int>(planes.size());
  for (const Rectangle& face : scene.faces) {
    double best = 0.03;
    for (const FoundPlane& plane : planes) best = std::min(best, rms_from(plane, face));
    if (best >= 0.03) continue;
    ++result.faces;
    result.error_m += best;
  }
  result.error_m /= std::max(1, result.faces);
  for (const FoundPlane& plane : planes) {
    const auto is_of = [&](const Rectangle& r) { return rms_from(plane, r) < 0.03; };
    if (std::none_of(scene.faces.begin(), scene.faces.end(), is_of) &&
        std::none_of(scene.things.begin(), scene.things.end(), is_of))
      ++result.false_planes;
  }
  std::size_t near = 0, asked = 0;
  for (std::size_t i = 0; i < points.size(); i += std::max<std::size_t>(1, points.size() / 20000), ++asked)
    near += std::any_of(planes.begin(), planes.end(), [&](const FoundPlane& plane) {
      return std::abs(plane.normal.dot(points[i].cast<double>()) - plane.rho_m) < 0.05;
    });
  result.near_share = static_cast<double>(near) / static_cast<double>(std::max<std::size_t>(1, asked));
  return result;
}

/// In a process of its own, so that its peak memory can be told; above what the cloud itself takes.
std::optional<Result> run(const PlaneMethod& method, const Scene& scene, const std::vector<Point>& points) {
  int ends[2];
  if (::pipe(ends) != 0) return std::nullopt;
  const pid_t child = ::fork();
  if (child == 0) {
    const tbb::global_control one_core(tbb::global_control::max_allowed_parallelism, 1);
    tbb::parallel_for(0, 2,
                      [](int) {});  // the scheduler's start is once a process, and no part of any method
    const double begin = cpu_seconds();
    const std::vector<FoundPlane> planes = method.detect(points);
    const double cpu_s = cpu_seconds() - begin;
    Result result = judged(planes, scene, points);
    result.cpu_s = cpu_s;
    ::_exit(::write(ends[1], &result, sizeof result) == sizeof result ? 0 : 1);
  }
  ::close(ends[1]);
  Result result;
  const bool got = ::read(ends[0], &result, sizeof result) == sizeof result;
  ::close(ends[0]);
  int status = 0;
  rusage used{};
  if (::wait4(child, &status, 0, &used) != child || !got) return std::nullopt;
  result.peak_mb = static_cast<double>(used.ru_maxrss) / 1024 -
                   static_cast<double>(points.size() * sizeof(Point)) / (1 << 20);
  return result;
}

std::vector<FoundPlane> ours(std::span<const Point> points) {
  std::vector<FoundPlane> planes;
  for (const PlanePatch& patch : detect_planes(points)) planes.push_back({patch.normal, patch.rho_m});
  return planes;
}

/// Medians over the clouds, but the worst of what must never happen.
void print_row(const std::string& method, const std::string& cloud, std::vector<Result> results) {
  const auto median = [&](double Result::*of) {
    std::sort(results.begin(), results.end(),
              [&](const Result& a, const Result& b) { return a.*of < b.*of; });
    return results[results.size() / 2].*of;
  };
  int faces = 6, false_planes = 0, planes = 0;
  for (const Result& r : results) {
    faces = std::min(faces, r.faces);
    false_planes = std::max(false_planes, r.false_planes);
    planes = std::max(planes, r.planes);
  }
  std::printf("| %s | %s | %.3f | %d | %d | %d | %.2f | %.0f |\n", cloud.c_str(), method.c_str(),
              median(&Result::cpu_s), planes, faces, false_planes, 1000 * median(&Result::error_m),
              median(&Result::peak_mb));
  std::fflush(stdout);
}

struct CloudKind {
  double noise_m, stray;
};
constexpr CloudKind kCloudKinds[] = {{0.01, 0}, {0.01, 0.1}, {0.02, 0}, {0.02, 0.1}};

std::string name_of(const CloudKind& kind, std::size_t points) {
  char name[80];
  std::snprintf(name, sizeof name, "%zu points, %.0f cm noise%s", points, 100 * kind.noise_m,
                kind.stray > 0 ? ", stray" : "");
  return name;
}

void print_head() {
  std::printf(
      "| cloud | method | CPU s | planes | faces of 6, least | false, most | error mm | peak MB |\n"
      "| --- | --- | ---: | ---: | ---: | ---: | ---: | ---: |\n");
}

int for_3dtk(const std::filesystem::path& folder, std::size_t count) {
  const Scene scene = furnished_room();
  print_head();
  for (const CloudKind& kind : kCloudKinds) {
    const std::vector<Point> points = sampled(scene, count, kind.noise_m, kind.stray, 1);
    std::string name = std::to_string(std::lround(100 * kind.noise_m)) + "cm";
    if (kind.stray > 0) name += "-stray";
    if (!std::filesystem::exists(folder / name / "scan000.3d")) write_for_3dtk(folder / name, points);
    const std::vector<FoundPlane> planes = planes_of_3dtk(folder / name / "planes");
    if (planes.empty()) continue;
    const Result result = judged(planes, scene, points);
    std::printf("| %s | 3DTK | – | %d | %d | %d | %.2f | – |\n", name_of(kind, count).c_str(), result.planes,
                result.faces, result.false_planes, 1000 * result.error_m);
  }
  return 0;
}

int run_all(int count, char** arguments) {
  if (count > 2 && std::string(arguments[1]) == "--3dtk")
    return for_3dtk(arguments[2], count > 3 ? static_cast<std::size_t>(std::atoll(arguments[3])) : 100000);
  const int clouds = count > 1 ? std::max(1, std::atoi(arguments[1])) : 3;
  const std::size_t most = count > 2 ? static_cast<std::size_t>(std::atoll(arguments[2])) : 1000000;
  std::vector<PlaneMethod> methods{{"gramap", 1000000000, ours}};
  for (const auto& more : {cgal_methods(), pcl_methods(), open3d_methods()})
    methods.insert(methods.end(), more.begin(), more.end());
  if (count > 4) std::erase_if(methods, [&](const PlaneMethod& m) { return m.name != arguments[4]; });
  print_head();
  const Scene scene = furnished_room();
  for (const CloudKind& kind : kCloudKinds)
    for (std::size_t points = 100000; points <= most; points *= 10)
      for (const PlaneMethod& method : methods) {
        if (points > method.most_points) continue;
        std::vector<Result> results;
        for (int cloud = 0; cloud < clouds; ++cloud)
          if (const auto result = run(
                  method, scene,
                  sampled(scene, points, kind.noise_m, kind.stray, static_cast<std::uint64_t>(cloud) + 1)))
            results.push_back(*result);
        if (!results.empty()) print_row(method.name, name_of(kind, points), results);
      }
  if (count > 3 && std::string(arguments[3]) != "-") {
    const RegisteredCloud cloud = registered(read_room_scans(arguments[3]));
    std::printf(
        "\n| scans of %zu points | CPU s | planes | points within 5 cm of one | peak MB |\n| --- | ---: | "
        "---: | ---: | ---: |\n",
        cloud.points_m.size());
    for (const PlaneMethod& method : methods)
      if (const auto result = run(method, Scene{}, cloud.points_m);
          result && cloud.points_m.size() <= method.most_points)
        std::printf("| %s | %.3f | %d | %.1f %% | %.0f |\n", method.name.c_str(), result->cpu_s,
                    result->planes, 100 * result->near_share, result->peak_mb);
  }
  return 0;
}

}  // namespace

int main(int count, char** arguments) {
  return test::bench_main("bench_planes", [&] { return run_all(count, arguments); });
}
