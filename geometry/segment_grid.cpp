#include "geometry/segment_grid.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace gramap {

template <typename Visit>
void SegmentGrid::visit_cells(const Vec2& a, const Vec2& b, double margin_m, Visit visit) const {
  const Vec2 low = a.cwiseMin(b).array() - margin_m, high = a.cwiseMax(b).array() + margin_m;
  const auto cell = [this](double x) { return static_cast<long long>(std::floor(x / cell_m_)); };
  for (long long y = cell(low.y()); y <= cell(high.y()); ++y)
    for (long long x = cell(low.x()); x <= cell(high.x()); ++x) visit((y << 32) ^ (x & 0xffffffff));
}

void SegmentGrid::add(const Vec2& a, const Vec2& b) {
  visit_cells(a, b, 0, [this](long long key) { cells_[key].push_back(size_); });
  ++size_;
}

std::vector<int> SegmentGrid::near(const Vec2& a, const Vec2& b, double margin_m) const {
  std::vector<int> found;
  const Vec2 cells = ((a - b).cwiseAbs().array() + 2 * margin_m) / cell_m_;
  if (!(cells.x() * cells.y() < 1e6)) {  // a box that large is not worth walking through
    found.resize(static_cast<std::size_t>(size_));
    std::iota(found.begin(), found.end(), 0);
    return found;
  }
  visit_cells(a, b, margin_m, [&](long long key) {
    if (const auto cell = cells_.find(key); cell != cells_.end())
      found.insert(found.end(), cell->second.begin(), cell->second.end());
  });
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace gramap
