// Where hallways may grow: the inside of an outline, in a frame turned so that the outline's longest edge
// lies along x. All questions are asked along one of four headings (0: +x, 1: +y, 2: -x, 3: -y).
#pragma once

#include <optional>
#include <vector>

#include "floor/ground_truth.h"

namespace gramap {

/// Somewhere on the way of a hallway: `at` in the area's frame, looking along `heading`.
struct Heading {
  Vec2 at = Vec2::Zero();
  int heading = 0;

  /// Forward by `along_m` and to the left by `left_m`.
  Vec2 point(double along_m, double left_m) const;
  /// The inverse: (along, left) of a point.
  Vec2 local(const Vec2& point) const;
};

/// The longest free strip of an area: a rectangle along a heading.
struct Strip {
  Heading begin;  ///< the middle of the short side at which it begins
  double length_m = 0;
  double breadth_m = 0;
};

/// A free rectangle beside a hallway: `from_m` to `to_m` along it, `length_m` away from it.
struct Bay {
  double from_m = 0;
  double to_m = 0;
  double length_m = 0;
};

class ClearArea {
 public:
  /// The inner faces of the outer walls bound it, also around courtyards; fixed rooms stand in it with the
  /// inner walls around them.
  ClearArea(const FloorGroundTruth& floor, double inner_wall_m, double outer_wall_m);

  /// How far one can go straight on before anything of an outer wall is less than `right_m` to the right or
  /// `left_m` to the left.
  double free_of_walls(const Heading& from, double right_m, double left_m) const;
  /// The same of fixed rooms.
  double free_of_fixed(const Heading& from, double right_m, double left_m) const;

  /// The free strip with the greatest product of length and weight; of equals the broadest.
  /// `weight(breadth_m)` is zero where a strip is too narrow.
  template <class Weight>
  std::optional<Strip> best_strip(Weight weight) const {
    std::optional<Strip> best;
    double best_value = 0;
    for (const Strip& strip : strips()) {
      const double value = strip.length_m * weight(strip.breadth_m);
      const bool longer = value > best_value * (1 + 1e-3);
      const bool broader = best && value > best_value * (1 - 1e-3) && strip.breadth_m > best->breadth_m;
      if (value > 0 && (longer || broader)) best = strip, best_value = value;
    }
    return best;
  }

  /// All maximal free rectangles that begin on the line through `from` and hold the place `at_m` along it;
  /// each lies to the left of the line.
  std::vector<Bay> bays(const Heading& from, double at_m) const;

  /// Places across the heading, relative to `from`, at which a hallway of this width would stand beside a
  /// fixed room.
  std::vector<double> beside_fixed(const Heading& from, double width_m) const;

  Vec2 to_plan(const Vec2& point) const;

 private:
  struct Edge {
    Vec2 a, b;
  };
  void add(const Polygon& ring, std::vector<Edge>& edges) const;
  double first_hit(const std::vector<Edge>& edges, const Heading& from, double right_m, double left_m) const;
  std::vector<Strip> strips() const;
  bool is_inside(const Vec2& point) const;

  Vec2 axis_ = Vec2::UnitX();
  std::vector<Edge> walls_;
  std::vector<Edge> fixed_;
};

}  // namespace gramap
