#include "perception/free_space.h"

#include <algorithm>
#include <cmath>

namespace gramap {
namespace {

constexpr std::size_t kRays = 60000;

/// The share of the way from `a` to `b` up to the first wall.
double way_to_wall(const Vec2& a, const Vec2& b, const std::vector<WallLine>& lines) {
  double share = 1;
  for (const WallLine& line : lines) {
    const double from = line.distance(a), to = line.distance(b);
    if ((from > 0) == (to > 0)) continue;
    const double t = from / (from - to);
    if (t < share && line.is_wall_at(line.direction().dot(a + t * (b - a)))) share = t;
  }
  return share;
}

/// Far from the scanner rays run apart: gaps between them of up to four pixels are closed (dilation, then
/// erosion).
void close_gaps(FreeSpace& space) {
  constexpr int kReach = 2;
  const auto spread = [&](std::uint8_t value) {
    for (const bool across : {false, true}) {
      const int length = across ? space.columns : space.rows, lanes = across ? space.rows : space.columns;
      const int step = across ? 1 : space.columns, lane_step = across ? space.columns : 1;
      for (int lane = 0; lane < lanes; ++lane) {
        std::uint8_t* const at = space.seen.data() + static_cast<std::ptrdiff_t>(lane) * lane_step;
        int last = -kReach - 1;  // the last pixel that had the value before this pass
        for (int i = 0; i < length; ++i) {
          std::uint8_t& pixel = at[static_cast<std::ptrdiff_t>(i) * step];
          if (pixel == value) {
            for (int back = std::max(0, i - kReach); back < i; ++back)
              at[static_cast<std::ptrdiff_t>(back) * step] = value;
            last = i;
          } else if (i - last <= kReach) {
            pixel = value;
          }
        }
      }
    }
  };
  spread(1);
  spread(0);
}

}  // namespace

FreeSpace free_space(const RegisteredCloud& cloud, const std::vector<WallLine>& lines, const Storey& storey) {
  std::vector<std::pair<Vec2, Vec2>> rays;
  const std::size_t step = std::max<std::size_t>(1, cloud.points_m.size() / kRays);
  FreeSpace space;
  if (cloud.parts.empty()) return space;
  Vec2 low = cloud.parts.front().scanner_m.head<2>(), high = low;
  for (const RegisteredCloud::Part& part : cloud.parts) {
    const Vec2 from = part.scanner_m.head<2>();
    low = low.cwiseMin(from);
    high = high.cwiseMax(from);
    for (std::size_t i = part.begin; i < part.end; i += step) {
      const Point& p = cloud.points_m[i];
      if (p.z() < storey.floor_z_m - 0.2 || p.z() > storey.ceiling_z_m + 0.2) continue;
      const Vec2 to(p.x(), p.y());
      const Vec2 end = from + way_to_wall(from, to, lines) * (to - from);
      rays.emplace_back(from, end);
      low = low.cwiseMin(end);
      high = high.cwiseMax(end);
    }
  }
  space.pixel_m = std::max(0.06, (high - low).maxCoeff() / 3000);
  space.corner_m = low - Vec2::Constant(5 * space.pixel_m);
  space.columns = static_cast<int>((high.x() - low.x()) / space.pixel_m) + 11;
  space.rows = static_cast<int>((high.y() - low.y()) / space.pixel_m) + 11;
  space.seen.assign(static_cast<std::size_t>(space.columns) * static_cast<std::size_t>(space.rows), 0);
  for (const auto& [from, to] : rays) {
    const Vec2 a = (from - space.corner_m) / space.pixel_m, way = (to - from) / space.pixel_m;
    const int steps = static_cast<int>(way.norm() / 0.7) + 1;
    for (int s = 0; s < steps; ++s) {
      const Vec2 p = a + way * (static_cast<double>(s) / steps);
      space.seen[static_cast<std::size_t>(p.y()) * static_cast<std::size_t>(space.columns) +
                 static_cast<std::size_t>(p.x())] = 1;
    }
  }
  close_gaps(space);
  return space;
}

}  // namespace gramap
