#include "perception/wall_lines.h"

#include <algorithm>
#include <cmath>

namespace gramap {
namespace {

constexpr std::size_t kEvidencePoints = 200000;

/// A plane too oblique for an upright wall that yet spans most of the storey, as no piece of furniture does.
bool leans(const PlanePatch& plane, const Storey& storey, const WallOptions& options) {
  constexpr double kLeastArea_m2 = 1, kLeastShare = 0.6;
  const double slope = std::abs(plane.normal.z());
  if (slope <= options.vertical_epsilon || slope > options.most_lean || plane.area_m2 < kLeastArea_m2)
    return false;
  return (plane.rows - 2) * plane.cell_m * std::abs(plane.v.z()) >= kLeastShare * storey.height_m();
}

/// Vertical planes as lines; those of the same wall merged. The strongest plane gives the line: a weaker one
/// whose whole length lies along it is a piece of the same wall, or the rim of its noise.
std::vector<WallLine> merged(const std::vector<PlanePatch>& planes, const Storey& storey,
                             const WallOptions& options) {
  std::vector<WallLine> lines;
  for (const PlanePatch& plane : planes) {
    const bool leaning = leans(plane, storey, options);
    if (std::abs(plane.normal.z()) > options.vertical_epsilon && !leaning) continue;
    const Vec3 middle = plane.corner + plane.v * (plane.rows * plane.cell_m / 2);
    const Vec2 begin = (middle + plane.u * plane.cell_m).head<2>();
    const Vec2 end = (middle + plane.u * ((plane.columns - 1) * plane.cell_m)).head<2>();
    WallLine line;
    line.normal = plane.normal.head<2>().normalized();
    line.rho_m = line.normal.dot((begin + end) / 2);
    if (leaning) {
      const double level = plane.normal.head<2>().norm();
      line.lean = plane.normal.z() / level;
      line.rho_m = (plane.rho_m - plane.normal.z() * storey.middle_z_m()) / level;
    }
    line.rms_m = plane.rms_m;
    line.band_m = std::max(plane.band_m, 0.03);
    line.support = plane.support;
    const auto same = [&](const WallLine& stronger) {
      const double limit = std::max(options.merge_distance_m, stronger.band_m + plane.band_m);
      return std::max(std::abs(stronger.distance(begin)), std::abs(stronger.distance(end))) <= limit;
    };
    const auto known = std::find_if(lines.begin(), lines.end(), same);
    if (known == lines.end())
      lines.push_back(line);
    else
      known->support += plane.support;
  }
  return lines;
}

/// How steeply up each scan looks: tangent of the elevation that few of its points exceed.
std::vector<double> views_up(const RegisteredCloud& cloud) {
  std::vector<double> tangents;
  for (const RegisteredCloud::Part& part : cloud.parts) {
    std::vector<double> list;
    const std::size_t step = std::max<std::size_t>(1, (part.end - part.begin) / 2000);
    for (std::size_t i = part.begin; i < part.end; i += step) {
      const Vec3 ray = cloud.points_m[i].cast<double>() - part.scanner_m;
      list.push_back(ray.z() / std::max(1e-6, ray.head<2>().norm()));
    }
    if (list.empty()) list.push_back(0);
    const auto high = list.begin() + static_cast<std::ptrdiff_t>(list.size() * 49 / 50);
    std::nth_element(list.begin(), high, list.end());
    tangents.push_back(*high);
  }
  return tangents;
}

void gather_evidence(WallLine& line, const RegisteredCloud& cloud, const std::vector<double>& up,
                     const Storey& storey, const WallOptions& options) {
  const std::size_t step = std::max<std::size_t>(1, cloud.points_m.size() / kEvidencePoints);
  const Vec2 direction = line.direction();
  const double low = storey.ceiling_z_m - options.top_band_m, high = storey.ceiling_z_m - 0.04;
  const double bottom = storey.floor_z_m + 0.1;
  // Along the line: points under the ceiling, and all below them of scans that could see up there. One that
  // stands close to a column has most of its points, and none near the ceiling.
  std::vector<double> places, under;
  for (std::size_t k = 0; k < cloud.parts.size(); ++k) {
    const RegisteredCloud::Part& part = cloud.parts[k];
    for (std::size_t i = part.begin; i < part.end; i += step) {
      const Point& p = cloud.points_m[i];
      if (p.z() < bottom || p.z() > high) continue;
      const Vec2 plan(p.x(), p.y());
      if (std::abs(line.distance(p.cast<double>(), storey)) > line.band_m) continue;
      if (p.z() >= low)
        places.push_back(direction.dot(plan));
      else if (part.scanner_m.z() + up[k] * (plan - part.scanner_m.head<2>()).norm() >= high)
        under.push_back(direction.dot(plan));
    }
  }
  line.wall.clear();
  if (places.empty()) return;
  const auto [first, last] = std::minmax_element(places.begin(), places.end());
  line.start_m = *first;
  const auto columns = static_cast<std::size_t>((*last - *first) / line.column_m) + 1;
  if (columns > 100000) return;
  std::vector<int> count(columns);
  for (const double place : places) ++count[static_cast<std::size_t>((place - line.start_m) / line.column_m)];
  std::vector<int> count_under(columns);
  for (const double place : under) {
    const double column = (place - line.start_m) / line.column_m;
    if (column >= 0 && column < static_cast<double>(columns)) ++count_under[static_cast<std::size_t>(column)];
  }
  // A column counts when points under the ceiling are nearly as dense as below: the few over a cupboard's
  // front are its noise. And it counts with others near it: single points there are strays.
  const double expected_share = 0.1 * (high - low) / (low - bottom);
  line.wall.assign(columns, 0);
  for (std::size_t c = 0; c < columns; ++c) {
    int near = 0, near_under = 0;
    for (std::size_t other = c < 2 ? 0 : c - 2; other < std::min(columns, c + 3); ++other) {
      near += count[other];
      near_under += count_under[other];
    }
    line.wall[c] = count[c] > 0 && near >= 3 && near >= expected_share * near_under;
  }
  // Gaps of up to half a metre in the points are gaps of the scan, not of the wall.
  const std::size_t longest_gap = 5;
  for (std::size_t c = 0, last_wall = columns; c < columns; ++c)
    if (line.wall[c]) {
      if (last_wall < c && c - last_wall <= longest_gap + 1)
        std::fill(line.wall.begin() + static_cast<std::ptrdiff_t>(last_wall),
                  line.wall.begin() + static_cast<std::ptrdiff_t>(c), std::uint8_t{1});
      last_wall = c;
    }
}

/// Takes away what the scanners look through: single columns at all heights, and all of a line most of which
/// blocks the view under the ceiling only, a beam. Lintels are like that, too, but only where there are
/// doors.
void clear_seen_through(WallLine& line, const RegisteredCloud& cloud, const Storey& storey,
                        const WallOptions& options) {
  constexpr double kMargin_m = 0.3;  // behind the line; and off the floor, where feet of furniture hide walls
  constexpr double kShare = 0.7;     // of the columns
  constexpr std::size_t kMostSeen = 3;  // times as many points behind as on a column
  const double low = storey.floor_z_m + kMargin_m, middle = storey.ceiling_z_m - options.top_band_m,
               high = storey.ceiling_z_m - 0.04;
  struct Column {
    std::size_t on = 0, behind = 0;
  };
  std::vector<Column> top(line.wall.size()), beneath(line.wall.size());
  const auto column_of = [&](const Vec3& p) -> Column* {
    const double column = (line.direction().dot(p.head<2>()) - line.start_m) / line.column_m;
    if (column < 0 || column >= static_cast<double>(top.size()) || p.z() < low || p.z() > high)
      return nullptr;
    return &(p.z() > middle ? top : beneath)[static_cast<std::size_t>(column)];
  };
  const std::size_t step = std::max<std::size_t>(1, cloud.points_m.size() / kEvidencePoints);
  for (const RegisteredCloud::Part& part : cloud.parts) {
    const double from = line.distance(part.scanner_m, storey);
    for (std::size_t i = part.begin; i < part.end; i += step) {
      const Vec3 p = cloud.points_m[i].cast<double>();
      const double to = line.distance(p, storey);
      if (std::abs(to) <= line.band_m) {
        if (Column* column = column_of(p)) ++column->on;
      } else if ((from > 0) != (to > 0) && std::abs(to) > kMargin_m) {
        if (Column* column = column_of(part.scanner_m + from / (from - to) * (p - part.scanner_m)))
          ++column->behind;
      }
    }
  }
  const auto near = [&](const std::vector<Column>& columns, std::size_t c) {
    Column sum;
    for (std::size_t other = c < 2 ? 0 : c - 2; other < std::min(columns.size(), c + 3); ++other) {
      sum.on += columns[other].on;
      sum.behind += columns[other].behind;
    }
    return sum;
  };
  std::size_t walls = 0, beams = 0;
  for (std::size_t c = 0; c < line.wall.size(); ++c) {
    if (!line.wall[c]) continue;
    const Column above = near(top, c), below = near(beneath, c);
    const bool open = below.behind > kMostSeen * below.on;
    if (open && above.behind > kMostSeen * above.on) {
      line.wall[c] = 0;
      continue;
    }
    ++walls;
    beams += open && above.on >= above.behind;
  }
  if (static_cast<double>(beams) > kShare * static_cast<double>(walls)) line.wall.clear();
}

}  // namespace

double WallLine::wall_share(const Vec2& a, const Vec2& b) const {
  const double along_a = direction().dot(a), along_b = direction().dot(b);
  const double from_m = std::min(along_a, along_b), to_m = std::max(along_a, along_b);
  const int samples = std::max(1, static_cast<int>((to_m - from_m) / column_m + 0.5));
  int hits = 0;
  for (int i = 0; i < samples; ++i) hits += is_wall_at(from_m + (to_m - from_m) * (i + 0.5) / samples);
  return static_cast<double>(hits) / samples;
}

std::vector<WallLine> wall_lines(const std::vector<PlanePatch>& planes, const RegisteredCloud& cloud,
                                 const Storey& storey, const WallOptions& options) {
  std::vector<WallLine> lines = merged(planes, storey, options);
  const std::vector<double> up = views_up(cloud);
  for (WallLine& line : lines) {
    gather_evidence(line, cloud, up, storey, options);
    clear_seen_through(line, cloud, storey, options);
  }
  std::erase_if(lines, [&](const WallLine& line) {
    const auto columns = std::count(line.wall.begin(), line.wall.end(), 1);
    return static_cast<double>(columns) * line.column_m < options.min_length_m;
  });
  std::stable_sort(lines.begin(), lines.end(),
                   [](const WallLine& a, const WallLine& b) { return a.support > b.support; });
  return lines;
}

}  // namespace gramap
