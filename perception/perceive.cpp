#include "perception/perceive.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "geometry/error.h"
#include "geometry/polygon.h"
#include "geometry/say.h"
#include "perception/door_gaps.h"
#include "perception/hidden_walls.h"
#include "perception/level.h"
#include "perception/measure.h"
#include "perception/models.h"
#include "perception/narrow_faces.h"
#include "perception/shape_remarks.h"
#include "perception/storey.h"

namespace gramap {
namespace {

/// Reports each stage when it ends.
class Stages {
 public:
  explicit Stages(const PerceptionOptions& options) : options_(options) {}
  void end(const char* stage) {
    const auto now = std::chrono::steady_clock::now();
    if (options_.on_stage) options_.on_stage(stage, std::chrono::duration<double>(now - start_).count());
    start_ = now;
  }

 private:
  const PerceptionOptions& options_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

void run_stages(Perception& found, const std::string& room, const PerceptionOptions& options) {
  Stages stages(options);
  found.observation.remarks = found.cloud.remarks;
  found.planes = detect_planes(found.cloud.points_m, options.hough);
  stages.end("planes");
  const double lean_rad = level(found.cloud, found.planes);
  if (lean_rad > 0.005) {
    char text[100];
    std::snprintf(text, sizeof text, "the scans lean by %.1f degrees; the room is measured upright",
                  lean_rad * 180 / std::numbers::pi);
    found.observation.remarks.push_back(text);
  }
  found.storey = find_storey(found.planes, found.cloud, room, options.walls, found.observation.remarks);
  for (PlanePatch& plane :
       find_hidden_walls(found.planes, found.cloud, found.storey, options.walls, options.hough))
    found.planes.push_back(std::move(plane));
  const RangeNoise noise = learned_noise(found.planes, found.cloud);
  for (PlanePatch& plane : find_narrow_faces(found.planes, found.cloud, found.storey, options.walls, noise))
    found.planes.push_back(std::move(plane));
  found.walls = wall_lines(found.planes, found.cloud, found.storey, options.walls);
  stages.end("walls");
  found.free = free_space(found.cloud, found.walls, found.storey);
  stages.end("free space");
  found.outline = room_outline(found.walls, found.free, found.cloud, options.outline);
  stages.end("outline");
  if (found.outline.ring.size() < 3) {
    char text[200];
    std::snprintf(text, sizeof text,
                  "no room was found around the scanners: of %s, %zu reach the ceiling as walls",
                  said_count(found.planes.size(), "plane").c_str(), found.walls.size());
    throw InputError({room}, text, "scan every wall of the room, up to the ceiling");
  }
  const MeasuredRoom measured =
      measure_room(found.outline, found.walls, found.storey, found.cloud, options.outline.min_edge_m);

  RoomObservation& seen = found.observation;
  const Vec3& origin = found.cloud.origin_m;
  seen.room = room;
  seen.points = found.cloud.points_m.size();
  for (const RegisteredCloud::Part& part : found.cloud.parts)
    seen.scanner_positions.push_back(part.scanner_m + origin);
  for (const Vec2& corner : found.outline.ring) seen.outline.push_back(corner + origin.head<2>());
  for (std::size_t i = 0; i < seen.outline.size(); ++i) {
    WallObservation wall;
    wall.a = seen.outline[i];
    wall.b = seen.outline[(i + 1) % seen.outline.size()];
    const int plane = measured.plane_of_edge[i];
    wall.sigma_m = std::sqrt(measured.adjustment.covariance(plane, plane));
    wall.plane_rms_m = measured.planes[static_cast<std::size_t>(plane)].rms_m;
    wall.support = static_cast<int>(
        std::min<std::size_t>(measured.planes[static_cast<std::size_t>(plane)].support, 2000000000));
    wall.seen_share = found.walls[static_cast<std::size_t>(found.outline.lines[i])].wall_share(
        found.outline.ring[i], found.outline.ring[(i + 1) % found.outline.ring.size()]);
    seen.walls.push_back(wall);
  }
  seen.floor_z_m = found.storey.floor_z_m + origin.z();
  seen.ceiling_z_m = found.storey.ceiling_z_m + origin.z();
  measure_extent(seen, measured);
  // Between its lowest and highest place a sloped ceiling is anywhere (a uniform distribution).
  if (found.storey.ceiling_rise_m > 0) seen.height.sigma_m = found.storey.ceiling_rise_m / std::sqrt(12.0);
  for (std::string& remark : remarks_on_shape(found.outline, found.walls))
    seen.remarks.push_back(std::move(remark));
  seen.remarks.insert(seen.remarks.end(), found.outline.remarks.begin(), found.outline.remarks.end());
  stages.end("measures");
}

}  // namespace

Perception perceive_structure(RegisteredCloud cloud, const std::string& room,
                              const PerceptionOptions& options) {
  Perception found;
  found.cloud = std::move(cloud);
  try {
    run_stages(found, room, options);
  } catch (const InputError&) {
    if (options.on_found) options.on_found(found);
    throw;
  }
  if (options.on_found) options.on_found(found);
  return found;
}

Perception perceive(RegisteredCloud cloud, const std::string& room, const PerceptionOptions& options) {
  Perception found = perceive_structure(std::move(cloud), room, options);
  Stages stages(options);
  if (options.find_openings) {
    found.observation.openings =
        find_openings(found.cloud, found.observation, shipped_openings_forest(), options.openings);
    // A hallway's walls are mostly doors: where the forest knows none of them, gaps still say where rooms are
    // entered.
    if (found.observation.openings.empty())
      found.observation.openings = find_door_gaps(found.cloud, found.observation);
    stages.end("openings");
  }
  if (options.find_furniture) {
    found.observation.furniture =
        find_furniture(found.cloud, found.observation, shipped_furniture_forest(), options.furniture);
    stages.end("furniture");
  }
  if (options.on_found) options.on_found(found);
  return found;
}

RoomObservation perceive_room(const RoomScans& scans, const PerceptionOptions& options) {
  return perceive(registered(scans), scans.room, options).observation;
}

WallFrame wall_frame(const RoomObservation& observation, std::size_t index) {
  const WallObservation& wall = observation.walls.at(index);
  const Vec2 along = (wall.b - wall.a).normalized();
  WallFrame frame;
  frame.length_m = (wall.b - wall.a).norm();
  frame.height_m = observation.ceiling_z_m - observation.floor_z_m;
  frame.room_from_wall.linear().col(0) << along, 0;
  frame.room_from_wall.linear().col(1) = Vec3::UnitZ();
  frame.room_from_wall.linear().col(2) << along.y(), -along.x(), 0;
  frame.room_from_wall.translation() << wall.a, observation.floor_z_m;
  return frame;
}

}  // namespace gramap
