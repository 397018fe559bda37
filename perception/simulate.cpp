#include "perception/simulate.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "geometry/error.h"
#include "geometry/polygon.h"
#include "perception/random.h"
#include "perception/simulate_scene.h"

namespace gramap {
namespace {

constexpr double kRadiansPerDegree = 3.141592653589793 / 180;
constexpr double kElbowRoom_m = 0.45;  // a person keeps this far from walls and furniture

Eigen::Isometry3d turned(const Vec3& position, double heading_rad) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translate(position);
  pose.rotate(Eigen::AngleAxisd(heading_rad, Vec3::UnitZ()));
  return pose;
}

/// How far a standing place is from what one bumps into; negative inside furniture.
double clearance(const BuildingRoom& room, const Vec2& place) {
  double free = distance_to_border(room.outline, place);
  for (const BuildingFurniture& piece : room.furniture) {
    const double distance = distance_to_border(piece.outline, place);
    free = std::min(free, contains(piece.outline, place) ? -distance : distance);
  }
  return free;
}

/// Places spread over the room (each the farthest of many free ones from those before), in walking order.
std::vector<Vec2> walk(const BuildingRoom& room, int count, Random& random) {
  Vec2 low = room.outline[0], high = low;
  for (const Vec2& p : room.outline) low = low.cwiseMin(p), high = high.cwiseMax(p);
  std::vector<Vec2> free;
  for (double elbow = kElbowRoom_m; free.empty() && elbow > 0.05; elbow /= 2)
    for (int i = 0; i < 2000; ++i) {
      const double x = random.uniform(low.x(), high.x()), y = random.uniform(low.y(), high.y());
      if (contains(room.outline, {x, y}) && clearance(room, {x, y}) > elbow) free.emplace_back(x, y);
    }
  if (free.empty())
    throw InputError({}, "room " + room.id + " has no place to stand in for a scan",
                     "check its outline and its furniture");
  std::vector<Vec2> chosen = {free.front()};
  std::vector<double> distance(free.size(), std::numeric_limits<double>::infinity());
  while (static_cast<int>(chosen.size()) < count) {
    std::size_t farthest = 0;
    for (std::size_t i = 0; i < free.size(); ++i) {
      distance[i] = std::min(distance[i], (free[i] - chosen.back()).norm());
      // People do not stand in corners: up to a third of the spread is left to chance.
      if (distance[i] * random.uniform(0.67, 1.0) > distance[farthest]) farthest = i;
    }
    chosen.push_back(free[farthest]);
  }
  for (std::size_t i = 1; i < chosen.size(); ++i)
    std::iter_swap(chosen.begin() + i,
                   std::min_element(chosen.begin() + i, chosen.end(), [&](const Vec2& p, const Vec2& q) {
                     return (p - chosen[i - 1]).norm() < (q - chosen[i - 1]).norm();
                   }));
  return chosen;
}

int positions_for(const BuildingRoom& room, const SimulateOptions& options) {
  if (options.positions > 0) return options.positions;
  return std::clamp(static_cast<int>(std::lround(signed_area(room.outline) / 3.5)), 4, 12);
}

/// What the sensor measures from one position, in its own frame.
std::vector<Vec3> measure(const FaceSet& faces, const Eigen::Isometry3d& building_from_scanner, int count,
                          const SimulateOptions& options, Random& random) {
  const FaceSet near = faces.within(building_from_scanner.translation(), options.range_m);
  const double half_horizontal = 0.5 * options.fov_horizontal_deg * kRadiansPerDegree;
  const double half_vertical = 0.5 * options.fov_vertical_deg * kRadiansPerDegree;
  std::vector<Vec3> points;
  points.reserve(static_cast<std::size_t>(count));
  // Rays into open windows and beyond the range return nothing; after four times the points the place is
  // simply too open for its count.
  for (int ray = 0; ray < 4 * count && static_cast<int>(points.size()) < count; ++ray) {
    const double azimuth = random.uniform(-half_horizontal, half_horizontal);
    const double elevation = random.uniform(-half_vertical, half_vertical);
    const Vec3 direction(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                         std::sin(elevation));
    double distance =
        near.distance(building_from_scanner.translation(), building_from_scanner.linear() * direction);
    const double error = random.normal(), astray = random.uniform(), where = random.uniform();
    if (distance > options.range_m) continue;
    distance += error * (options.noise_m + options.noise_growth_per_m * distance * distance);
    if (astray < options.stray_share) distance = 0.3 + where * (options.range_m - 0.3);
    points.push_back(distance * direction);
  }
  return points;
}

SimulatedRoom simulate_room(const BuildingRoom& room, const FaceSet& faces, const SimulateOptions& options) {
  Random random(seed_for(options.seed, room.id));
  const std::vector<Vec2> places = walk(room, positions_for(room, options), random);

  // The poses' frame: the building's but for the drift, or one that the device made up when it was switched
  // on.
  const Vec3 middle(centroid(room.outline).x(), centroid(room.outline).y(), 0);
  const Vec3 drift(options.drift_sd_m * random.normal(), options.drift_sd_m * random.normal(), 0);
  const double drift_rad = options.drift_sd_deg * kRadiansPerDegree * random.normal();
  const double own_heading = random.uniform(0, 360) * kRadiansPerDegree;
  Eigen::Isometry3d frame_from_building = turned(middle + drift, drift_rad) * turned(-middle, 0);

  SimulatedRoom simulated;
  for (const Vec2& place : places) {
    const double eye =
        room.floor_m + std::clamp(options.eye_height_m + options.eye_height_sd_m * random.normal(), 0.3,
                                  room.ceiling_m - room.floor_m - 0.1);
    const Eigen::Isometry3d building_from_scanner =
        turned({place.x(), place.y(), eye}, random.uniform(0, 360) * kRadiansPerDegree);
    if (options.room_frame && simulated.scans.empty())
      frame_from_building =
          turned(Vec3::Zero(), own_heading) * turned(-building_from_scanner.translation(), 0);
    const Vec3 slip = options.registration_sd_m * Vec3(random.normal(), random.normal(), random.normal());
    const double slip_rad = options.registration_sd_deg * kRadiansPerDegree * random.normal();
    const int count =
        (options.points_per_room + static_cast<int>(places.size()) - 1) / static_cast<int>(places.size());
    SimulatedScan scan;
    scan.points = measure(faces, building_from_scanner, count, options, random);
    scan.frame_from_scanner =
        frame_from_building * turned(slip, 0) * building_from_scanner * turned(Vec3::Zero(), slip_rad);
    simulated.mean_position += place / static_cast<double>(places.size());
    simulated.scans.push_back(std::move(scan));
  }
  simulated.frame_from_building = frame_from_building;
  return simulated;
}

}  // namespace

std::vector<SimulatedRoom> simulate_rooms(const Building& building, const std::vector<std::size_t>& rooms,
                                          const SimulateOptions& options) {
  const FaceSet faces(building_faces(building, options));
  std::vector<SimulatedRoom> simulated(rooms.size());
  tbb::parallel_for(std::size_t{0}, rooms.size(), [&](std::size_t i) {
    simulated[i] = simulate_room(building.rooms[rooms[i]], faces, options);
  });
  return simulated;
}

std::string xyz_text(const std::vector<Vec3>& points, int decimals) {
  std::string text;
  text.reserve(points.size() * 24);
  char digits[64];
  for (const Vec3& p : points)
    for (int axis = 0; axis < 3; ++axis) {
      const auto end =
          std::to_chars(digits, digits + sizeof digits, p[axis], std::chars_format::fixed, decimals);
      text.append(digits, end.ptr);
      text.push_back(axis < 2 ? ' ' : '\n');
    }
  return text;
}

}  // namespace gramap
