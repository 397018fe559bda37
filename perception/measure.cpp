#include "perception/measure.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace gramap {
namespace {

/// Sums for a straight line y = offset + slope · x through points along a wall.
struct LineSums {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;
  void add(double px, double py) {
    n += 1;
    x += px;
    y += py;
    xx += px * px;
    xy += px * py;
    yy += py * py;
  }
};

struct Stretch {
  double from, to;
};

}  // namespace

std::vector<MeasuredWall> measure_walls(RoomOutline& outline, std::vector<WallLine>& lines,
                                        const RegisteredCloud& cloud, const Storey& storey) {
  const std::size_t edges = outline.ring.size();
  std::vector<std::vector<Stretch>> stretches(lines.size());
  for (std::size_t i = 0; i < edges; ++i) {
    const WallLine& line = lines[static_cast<std::size_t>(outline.lines[i])];
    const double a = line.direction().dot(outline.ring[i]),
                 b = line.direction().dot(outline.ring[(i + 1) % edges]);
    const double shrink = std::min(0.05, std::abs(a - b) / 4);  // corners hold points of both walls
    stretches[static_cast<std::size_t>(outline.lines[i])].push_back(
        {std::min(a, b) + shrink, std::max(a, b) - shrink});
  }
  std::vector<MeasuredWall> measured(lines.size());
  const float low = static_cast<float>(storey.floor_z_m + 0.05),
              high = static_cast<float>(storey.ceiling_z_m - 0.05);
  for (std::size_t l = 0; l < lines.size(); ++l) {
    if (stretches[l].empty()) continue;
    WallLine& line = lines[l];
    double band = line.band_m;
    for (int round = 0; round < 3; ++round) {
      const Vec2 direction = line.direction();
      double middle = 0;
      for (const Stretch& s : stretches[l])
        middle += (s.from + s.to) / 2 / static_cast<double>(stretches[l].size());
      std::vector<LineSums> of_scan(cloud.parts.size());
      LineSums all;
      for (std::size_t part = 0; part < cloud.parts.size(); ++part)
        for (std::size_t i = cloud.parts[part].begin; i < cloud.parts[part].end; ++i) {
          const Point& p = cloud.points_m[i];
          if (p.z() < low || p.z() > high) continue;
          const Vec2 plan(p.x(), p.y());
          const double across = line.distance(plan);
          if (std::abs(across) > band) continue;
          const double along = direction.dot(plan);
          for (const Stretch& s : stretches[l])
            if (along >= s.from && along <= s.to) {
              of_scan[part].add(along - middle, across);
              all.add(along - middle, across);
            }
        }
      if (all.n < 10) break;
      const double determinant = all.n * all.xx - all.x * all.x;
      double slope = (all.n * all.xy - all.x * all.y) / determinant, offset = (all.y - slope * all.x) / all.n;
      if (!(determinant > 1e-9 * all.n * all.n) || std::abs(slope) > 0.05) {
        slope = 0;
        offset = all.y / all.n;
      }
      const double variance = std::max(
          0.0, all.yy / all.n - 2 * offset * all.y / all.n - 2 * slope * all.xy / all.n + offset * offset +
                   2 * offset * slope * all.x / all.n + slope * slope * all.xx / all.n);
      // How far the scans disagree about the wall says how well it is known; points alone would be far too
      // sure.
      double spread = 0, scans = 0;
      for (const LineSums& sums : of_scan)
        if (sums.n >= 10) {
          const double residual = (sums.y - slope * sums.x) / sums.n - offset;
          spread += residual * residual;
          scans += 1;
        }
      const double between = scans > 1 ? spread / (scans - 1) / scans : 0.01 * 0.01;
      MeasuredWall& wall = measured[l];
      wall.rms_m = std::sqrt(variance);
      wall.sigma_m = std::sqrt(between + variance / all.n);
      wall.support = static_cast<int>(std::min(all.n, 2e9));
      // The line through (middle, offset), turned by the slope.
      const Vec2 through = line.normal * (line.rho_m + offset) + direction * middle;
      line.normal = (line.normal - slope * direction).normalized();
      line.rho_m = line.normal.dot(through);
      band = std::clamp(2.5 * wall.rms_m, 0.015, line.band_m);
    }
  }
  std::vector<MeasuredWall> result;
  for (std::size_t i = 0; i < edges; ++i) {
    const std::size_t before = static_cast<std::size_t>(outline.lines[(i + edges - 1) % edges]);
    const std::size_t here = static_cast<std::size_t>(outline.lines[i]);
    outline.ring[i] = crossing_of(lines[before], lines[here]);
    result.push_back(measured[here]);
  }
  return result;
}

void measure_extent(RoomObservation& room) {
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
    // The faces at both ends: the outermost walls that stand across the axis; their mean place along it.
    double low = 1e300, high = -1e300, low_sigma = 0, high_sigma = 0;
    bool found_low = false, found_high = false;
    for (const WallObservation& wall : room.walls) {
      const Vec2 way = (wall.b - wall.a).normalized();
      if (std::abs(way.dot(axis)) > 0.1) continue;
      const double place = axis.dot((wall.a + wall.b) / 2);
      const bool at_high = Vec2(way.y(), -way.x()).dot(axis) > 0;  // the room lies left of its walls
      if (at_high && (!found_high || place > high)) {
        high = place;
        high_sigma = wall.sigma_m;
        found_high = true;
      }
      if (!at_high && (!found_low || place < low)) {
        low = place;
        low_sigma = wall.sigma_m;
        found_low = true;
      }
    }
    for (const Vec2& corner : room.outline) {  // no wall across the axis at an end: the outermost corner
      const double place = axis.dot(corner);
      if (!found_low) low = std::min(low, place), low_sigma = 0.03;
      if (!found_high) high = std::max(high, place), high_sigma = 0.03;
    }
    return Measured{high - low, std::hypot(low_sigma, high_sigma)};
  };
  room.width = extent(room.axis);
  room.depth = extent(Vec2(-room.axis.y(), room.axis.x()));
}

}  // namespace gramap
