// The vertical planes of a room as lines in the plan, and along each what says "wall": that it reaches the
// ceiling.
#pragma once

#include <cstdint>
#include <vector>

#include "perception/hough.h"

namespace gramap {

/// The room's level planes: heights of floor and ceiling in the cloud's frame.
struct Storey {
  double floor_z_m = 0, ceiling_z_m = 0;
  double floor_band_m = 0.03, ceiling_band_m = 0.03;  ///< points up to this far off are their own
  /// How much higher a sloped ceiling gets than ceiling_z_m, its lowest place; 0 for a level one.
  double ceiling_rise_m = 0;
  double height_m() const { return ceiling_z_m - floor_z_m; }
  double middle_z_m() const { return (floor_z_m + ceiling_z_m) / 2; }
};

/// All p with normal · p = rho_m in the plan. Along it, `direction` is the normal turned left. A leaning wall
/// is the line that it cuts at the storey's mid-height.
struct WallLine {
  Vec2 normal = Vec2::UnitX();
  double rho_m = 0;
  double lean =
      0;  ///< tangent of the angle to upright: at height z it lies at rho_m − lean · (z − mid-height)
  double rms_m = 0;
  double band_m = 0;  ///< points up to this far from the line are the wall's
  std::size_t support = 0;
  // Evidence along the line, a value per column of `column_m`, from `start_m` on.
  double start_m = 0;
  double column_m = 0.1;
  std::vector<std::uint8_t> wall;  ///< 1 where the plane was measured right under the ceiling

  Vec2 direction() const { return Vec2(-normal.y(), normal.x()); }
  double distance(const Vec2& p) const { return normal.dot(p) - rho_m; }
  /// Distance of a point from the wall, across the line and level.
  double distance(const Vec3& p, const Storey& storey) const {
    return distance(Vec2(p.head<2>())) + lean * (p.z() - storey.middle_z_m());
  }
  bool is_wall_at(double along_m) const {
    const double column = (along_m - start_m) / column_m;
    return column >= 0 && column < static_cast<double>(wall.size()) && wall[static_cast<std::size_t>(column)];
  }
  /// Share of the stretch between two points on the line that is wall.
  double wall_share(const Vec2& a, const Vec2& b) const;
};

struct WallOptions {
  double vertical_epsilon = 0.06;  ///< a plane is vertical when |n_z| is below this, level when 1 − |n_z| is
  double most_lean = 0.5;          ///< a large plane up to this |n_z| that spans the storey is a leaning wall
  double merge_distance_m = 0.06;  ///< a plane that nowhere leaves another by more is the same wall
  double top_band_m = 0.35;        ///< a wall shows up in this band under the ceiling
  double min_length_m = 0.3;       ///< shorter pieces are no walls
};

/// Lines of the planes that reach the ceiling, in the order of support; beams, which the scanners look
/// through under, are none.
std::vector<WallLine> wall_lines(const std::vector<PlanePatch>& planes, const RegisteredCloud& cloud,
                                 const Storey& storey, const WallOptions& options);

}  // namespace gramap
