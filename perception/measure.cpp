#include "perception/measure.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "geometry/polygon.h"
#include "perception/plane_points.h"

namespace gramap {
namespace {

constexpr std::size_t kMeasuredPoints = 60000;  // enough: what is left of the error is not the points' noise

}  // namespace

double MeasuredRoom::distance_sigma_m(int a, int b) const {
  const Eigen::MatrixXd& c = adjustment.covariance;
  const double sign =
      planes[static_cast<std::size_t>(a)].normal.dot(planes[static_cast<std::size_t>(b)].normal) > 0 ? 1 : -1;
  return std::sqrt(std::max(0.0, c(a, a) + c(b, b) - 2 * sign * c(a, b)));
}

MeasuredRoom measure_room(RoomOutline& outline, std::vector<WallLine>& lines, Storey& storey,
                          RegisteredCloud& cloud, double min_edge_m) {
  MeasuredRoom room;
  const Vec2 centre = centroid(outline.ring);
  for (const double z : {storey.floor_z_m, storey.ceiling_z_m}) {
    AdjustedPlane level;
    level.middle << centre, z;
    level.u_slope_sigma = level.v_slope_sigma = 0.003;
    room.planes.push_back(level);
  }
  std::vector<int> plane_of_line(lines.size(), -1);
  for (std::size_t i = 0; i < outline.lines.size(); ++i) {
    const auto l = static_cast<std::size_t>(outline.lines[i]);
    if (plane_of_line[l] < 0) {
      plane_of_line[l] = static_cast<int>(room.planes.size());
      const WallLine& line = lines[l];
      AdjustedPlane wall;
      const Vec2 middle = (outline.ring[i] + outline.ring[(i + 1) % outline.ring.size()]) / 2;
      wall.normal = Vec3(line.normal.x(), line.normal.y(), line.lean).normalized();
      wall.u << line.direction(), 0;
      wall.v = wall.u.cross(wall.normal);
      if (wall.v.z() < 0) wall.v = -wall.v;
      wall.middle << Vec2(middle - line.distance(middle) * line.normal), storey.middle_z_m();
      room.planes.push_back(wall);
    }
  }
  std::vector<Vec3> scanners;
  for (const RegisteredCloud::Part& part : cloud.parts) scanners.push_back(part.scanner_m);

  FaceNoise noise;
  AdjustOptions expected;  // its variances go on converging from round to round
  // Every round starts from the scans as they came: what is known of their errors beforehand is used once.
  std::vector<Eigen::Isometry3d> corrections(scanners.size(), Eigen::Isometry3d::Identity());
  double moved_m = 1;
  for (int round = 0; round < 8 && moved_m > 1e-4; ++round) {
    tidy(outline, lines, min_edge_m);
    const std::size_t edges = outline.ring.size();
    room.plane_of_edge.clear();
    for (const int line : outline.lines)
      room.plane_of_edge.push_back(plane_of_line[static_cast<std::size_t>(line)]);
    RoomFaces faces{room.planes, outline.ring, std::vector<std::vector<FaceStretch>>(room.planes.size())};
    for (std::size_t i = 0; i < edges; ++i) {
      const AdjustedPlane& plane = room.planes[static_cast<std::size_t>(room.plane_of_edge[i])];
      const double a = plane.u.head<2>().dot(outline.ring[i] - plane.middle.head<2>());
      const double b = plane.u.head<2>().dot(outline.ring[(i + 1) % edges] - plane.middle.head<2>());
      const double shrink = std::min(0.06, std::abs(a - b) / 4);
      faces.stretches[static_cast<std::size_t>(room.plane_of_edge[i])].push_back(
          {std::min(a, b) + shrink, std::max(a, b) - shrink});
    }
    faces.level_ceiling = storey.ceiling_rise_m <= 0;
    const std::vector<PlanePoint> points = points_on(faces, noise, cloud, corrections, kMeasuredPoints);
    const std::vector<AdjustedPlane> before = room.planes;
    room.adjustment = adjust(room.planes, points, scanners, expected);
    expected.start_shift_m = room.adjustment.shift_sigma_m;
    expected.start_turn_rad = room.adjustment.turn_sigma_rad;
    expected.start_systematic_m = room.adjustment.systematic_m;
    moved_m = 0;
    for (std::size_t p = 0; p < before.size(); ++p)
      moved_m = std::max(moved_m, (room.planes[p].middle - before[p].middle).norm());
    corrections = room.adjustment.corrected_from_registered;
    for (const PlanePoint& point : points)
      if (const auto met = meeting(room.planes[point.plane], corrections[point.part] * scanners[point.part],
                                   corrections[point.part] * point.point_m))
        noise.add(met->range_m, met->slope, residual_m(point, room.planes, corrections));
    noise.learn();
    for (std::size_t l = 0; l < lines.size(); ++l) {
      if (plane_of_line[l] < 0) continue;
      const AdjustedPlane& plane = room.planes[static_cast<std::size_t>(plane_of_line[l])];
      lines[l].normal = plane.normal.head<2>().normalized();
      lines[l].rho_m = lines[l].normal.dot(plane.middle.head<2>());
      lines[l].rms_m = plane.rms_m;
    }
    for (std::size_t i = 0; i < edges; ++i)
      outline.ring[i] = crossing_of(lines[static_cast<std::size_t>(outline.lines[(i + edges - 1) % edges])],
                                    lines[static_cast<std::size_t>(outline.lines[i])]);
  }
  for (std::size_t k = 0; k < cloud.parts.size(); ++k) {
    const Eigen::Isometry3f move = corrections[k].cast<float>();
    for (std::size_t i = cloud.parts[k].begin; i < cloud.parts[k].end; ++i)
      cloud.points_m[i] = move * cloud.points_m[i];
    cloud.parts[k].scanner_m = corrections[k] * scanners[k];
  }
  storey.floor_z_m = room.planes[0].middle.z();
  storey.ceiling_z_m = room.planes[1].middle.z();
  return room;
}

void measure_extent(RoomObservation& room, const MeasuredRoom& measured) {
  // The main direction: the one that most wall length runs along or across, modulo a quarter turn.
  double sine = 0, cosine = 0;
  for (const WallObservation& wall : room.walls) {
    const Vec2 way = wall.b - wall.a;
    const double angle = 4 * std::atan2(way.y(), way.x());
    sine += way.norm() * std::sin(angle);
    cosine += way.norm() * std::cos(angle);
  }
  const double turn = std::atan2(sine, cosine) / 4;  // within an eighth turn of the frame's x axis
  room.axis = Vec2(std::cos(turn), std::sin(turn));
  const auto extent = [&](const Vec2& axis) {
    // From the outermost face at one end to that at the other, each at the middle of its wall; where no wall
    // stands across the axis at an end, the outermost corner.
    struct End {
      double place = -1e300;
      int plane = -1;
    } ends[2];
    for (std::size_t i = 0; i < room.walls.size(); ++i) {
      const Vec2 way = (room.walls[i].b - room.walls[i].a).normalized();
      if (std::abs(way.dot(axis)) > 0.1) continue;
      const int high = Vec2(way.y(), -way.x()).dot(axis) > 0;  // the room lies left of its walls
      const double place = (high ? 1 : -1) * axis.dot((room.walls[i].a + room.walls[i].b) / 2);
      if (place > ends[high].place) ends[high] = {place, measured.plane_of_edge[i]};
    }
    for (const int high : {0, 1})
      if (ends[high].plane < 0)
        for (const Vec2& corner : room.outline)
          ends[high].place = std::max(ends[high].place, (high ? 1 : -1) * axis.dot(corner));
    const double sigma = ends[0].plane >= 0 && ends[1].plane >= 0
                             ? measured.distance_sigma_m(ends[0].plane, ends[1].plane)
                             : 0.05;
    return Measured{ends[0].place + ends[1].place, sigma};
  };
  room.width = extent(room.axis);
  room.depth = extent(Vec2(-room.axis.y(), room.axis.x()));
  room.height = {room.ceiling_z_m - room.floor_z_m, measured.distance_sigma_m(0, 1)};
}

}  // namespace gramap
