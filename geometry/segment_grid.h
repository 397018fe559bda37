// Which segments are near a place: a uniform grid over segments in the plan.
#pragma once

#include <unordered_map>
#include <vector>

#include "geometry/types.h"

namespace gramap {

class SegmentGrid {
 public:
  explicit SegmentGrid(double cell_m = 2) : cell_m_(cell_m) {}

  /// Enters segment number `size()`.
  void add(const Vec2& a, const Vec2& b);
  int size() const { return size_; }

  /// The segments whose bounds may overlap the box around `a` and `b` widened by `margin_m`: ascending, each
  /// once.
  std::vector<int> near(const Vec2& a, const Vec2& b, double margin_m) const;

 private:
  template <typename Visit>
  void visit_cells(const Vec2& a, const Vec2& b, double margin_m, Visit visit) const;

  double cell_m_;
  int size_ = 0;
  std::unordered_map<long long, std::vector<int>> cells_;
};

}  // namespace gramap
