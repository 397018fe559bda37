#include "perception/scan.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <numbers>
#include <tuple>

#include "geometry/error.h"
#include "geometry/file.h"
#include "perception/point_reader.h"

namespace gramap {
namespace {

namespace fs = std::filesystem;

/// 3DTK's left-handed axes from the right-handed ones: p_l = 100 · kLeftFromRight · p.
const Eigen::Matrix3d kLeftFromRight = (Eigen::Matrix3d() << 0, -1, 0, 0, 0, 1, 1, 0, 0).finished();

/// The name of a scan without its folder and its kind; empty for other files.
std::string stem_of(const fs::path& file) {
  fs::path name = file.filename();
  if (name.extension() == ".gz") name = name.stem();
  const std::string kind = name.extension().string();
  for (const char* known : {".xyz", ".asc", ".ply", ".pcd", ".3d", ".gpc"})
    if (kind == known) return name.stem().string();
  return "";
}

/// Median distance of the points from the scanner, from a sample.
double median_range(const std::vector<Point>& points) {
  std::vector<float> ranges;
  const std::size_t step = std::max<std::size_t>(1, points.size() / 10000);
  for (std::size_t i = 0; i < points.size(); i += step) ranges.push_back(points[i].norm());
  std::nth_element(ranges.begin(), ranges.begin() + static_cast<std::ptrdiff_t>(ranges.size() / 2),
                   ranges.end());
  return ranges[ranges.size() / 2];
}

/// Refuses a cloud that is not in metres: half of a room's points lie within 80 m of its scanner, and no room
/// is so small that, measured in centimetres, it would.
void check_unit(const Scan& scan) {
  const double range = median_range(scan.points_m);
  if (range < 80) return;
  const bool millimetres = range > 800;
  char text[160];
  std::snprintf(text, sizeof text,
                "half of the points are more than %.0f m from the scanner: this looks like %s", range,
                millimetres ? "millimetres" : "centimetres");
  throw InputError({scan.file.string()}, text,
                   std::string("convert the scan to metres, or say --unit ") + (millimetres ? "mm" : "cm"));
}

/// Leaves one file of each scan, in the order of their names; what is left out is said in `remarks`.
void drop_other_formats(std::vector<fs::path>& files, std::vector<std::string>& remarks) {
  const auto order = [](const fs::path& file) {
    const bool compressed = file.extension() == ".gpc" || file.stem().extension() == ".gpc";
    return std::tuple(stem_of(file), compressed, file.filename().string());
  };
  std::sort(files.begin(), files.end(),
            [&](const fs::path& a, const fs::path& b) { return order(a) < order(b); });
  std::vector<fs::path> kept;
  for (fs::path& file : files) {
    if (kept.empty() || stem_of(kept.back()) != stem_of(file))
      kept.push_back(std::move(file));
    else
      remarks.push_back(file.filename().string() + " was not read: " + kept.back().filename().string() +
                        " is the same scan");
  }
  files = std::move(kept);
}

Scan read_scan(const fs::path& file, const ReadOptions& options) {
  Scan scan;
  scan.file = file;
  scan.points_m = read_points(file);
  if (scan.points_m.empty())
    throw InputError({file.string()}, "the scan has no points", "remove the file, or export the scan again");
  if (options.unit_m > 0)
    for (Point& point : scan.points_m) point *= static_cast<float>(options.unit_m);
  else
    check_unit(scan);
  if (options.up == 'y')
    for (Point& point : scan.points_m) point = Point(point.x(), -point.z(), point.y());
  const fs::path pose = file.parent_path() / (stem_of(file) + ".pose");
  if (fs::exists(fs::symlink_status(pose))) scan.room_from_scanner = pose_from_text(read_file(pose), pose);
  return scan;
}

}  // namespace

Eigen::Isometry3d pose_from_text(std::string_view text, const fs::path& name) {
  double numbers[6];
  int count = 0, line = 1;
  const char* at = text.data();
  const char* const end = at + text.size();
  while (true) {
    while (at != end && (*at == ' ' || *at == '\t' || *at == '\n' || *at == '\r' || *at == ','))
      line += *at++ == '\n';
    if (at == end) break;
    double value = 0;
    if (!parse_number(at, end, value) || !std::isfinite(value))
      throw InputError({name.string(), line}, "expected a number in the pose",
                       "a pose is six numbers: x y z in centimetres, then three angles in degrees");
    if (count < 6) numbers[count] = value;
    ++count;
  }
  if (count != 6)
    throw InputError({name.string(), line},
                     "expected six numbers in the pose, found " + std::to_string(count),
                     "a pose is x y z in centimetres, then three angles in degrees");
  const auto turn = [&](int i, const Vec3& axis) {
    return Eigen::AngleAxisd(numbers[i] * std::numbers::pi / 180, axis).toRotationMatrix();
  };
  const Eigen::Matrix3d left = turn(3, Vec3::UnitX()) * turn(4, Vec3::UnitY()) * turn(5, Vec3::UnitZ());
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = kLeftFromRight.transpose() * left * kLeftFromRight;
  pose.translation() = kLeftFromRight.transpose() * Vec3(numbers[0], numbers[1], numbers[2]) / 100;
  return pose;
}

std::string pose_to_text(const Eigen::Isometry3d& room_from_scanner) {
  const Vec3 t = 100 * (kLeftFromRight * room_from_scanner.translation());
  const Eigen::Matrix3d r = kLeftFromRight * room_from_scanner.linear() * kLeftFromRight.transpose();
  // R = Rx·Ry·Rz: r02 = sin y, r12 = −sin x cos y, r22 = cos x cos y, r01 = −cos y sin z, r00 = cos y cos z.
  const double y = std::asin(std::clamp(r(0, 2), -1.0, 1.0));
  const double x = std::atan2(-r(1, 2), r(2, 2)), z = std::atan2(-r(0, 1), r(0, 0));
  const double degrees = 180 / std::numbers::pi;
  char text[200];
  std::snprintf(text, sizeof text, "%.4f %.4f %.4f\n%.6f %.6f %.6f\n", t.x(), t.y(), t.z(), x * degrees,
                y * degrees, z * degrees);
  return text;
}

RoomScans read_room_scans(const fs::path& folder, const ReadOptions& options) {
  std::vector<fs::path> files;
  std::error_code error, ignored;
  if (fs::is_regular_file(folder, ignored)) {
    files.push_back(folder);
  } else {
    for (fs::directory_iterator it(folder, error), last; !error && it != last; it.increment(error))
      if (!it->is_directory(ignored) && !stem_of(it->path()).empty()) files.push_back(it->path());
    if (error) throw InputError({folder.string()}, "cannot be read: " + error.message());
  }
  if (files.empty())
    throw InputError(
        {folder.string()}, "there are no scans here",
        "a room's folder holds scan000.xyz, scan000.pose, scan001.xyz, … (or .ply, .pcd, .3d, .gpc, "
        "each also .gz)");
  RoomScans room;
  drop_other_formats(files, room.remarks);
  const fs::path named = folder.has_filename() ? folder : folder.parent_path();
  room.room = fs::is_regular_file(named, error) ? named.stem().string()
                                                : fs::absolute(named).lexically_normal().filename().string();
  room.scans.resize(files.size());
  std::vector<std::exception_ptr> faults(files.size());
  tbb::parallel_for(std::size_t{0}, files.size(), [&](std::size_t i) {
    try {
      room.scans[i] = read_scan(files[i], options);
    } catch (...) {
      faults[i] = std::current_exception();
    }
  });
  for (const std::exception_ptr& fault : faults)
    if (fault) std::rethrow_exception(fault);  // the first file's, whichever thread was first
  return room;
}

RegisteredCloud registered(const RoomScans& scans) {
  RegisteredCloud cloud;
  cloud.remarks = scans.remarks;
  std::size_t total = 0;
  for (const Scan& scan : scans.scans) {
    cloud.origin_m += scan.room_from_scanner.translation() / static_cast<double>(scans.scans.size());
    total += scan.points_m.size();
  }
  for (double& coordinate : cloud.origin_m) coordinate = std::round(coordinate);
  cloud.points_m.resize(total);
  std::size_t begin = 0;
  for (const Scan& scan : scans.scans) {
    Eigen::Isometry3d pose = scan.room_from_scanner;
    pose.translation() -= cloud.origin_m;
    const Eigen::Isometry3f transform = pose.cast<float>();
    for (std::size_t i = 0; i < scan.points_m.size(); ++i)
      cloud.points_m[begin + i] = transform * scan.points_m[i];
    cloud.parts.push_back({pose.translation(), begin, begin + scan.points_m.size()});
    begin += scan.points_m.size();
  }
  return cloud;
}

}  // namespace gramap
