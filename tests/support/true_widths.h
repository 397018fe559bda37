// The rooms that are really in a space, as the fit has to find them.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "floor/ground_truth.h"
#include "geometry/polygon.h"

namespace gramap::test {

struct TrueWidth {
  std::string id;
  double start_m = 0;  ///< along the reference line
  double width_m = 0;
};

/// From the start of the space's line to its end.
inline std::vector<TrueWidth> true_widths(const Space& space, const FloorTruth& truth) {
  const Vec2 along = (space.end - space.start).normalized();
  std::vector<TrueWidth> widths;
  for (const TrueRoom& room : truth.rooms) {
    if (!contains(space.outline, centroid(room.outline))) continue;
    double low = 1e9, high = -1e9;
    for (const Vec2& point : room.outline) {
      low = std::min(low, (point - space.start).dot(along));
      high = std::max(high, (point - space.start).dot(along));
    }
    widths.push_back({room.id, low, high - low});
  }
  std::sort(widths.begin(), widths.end(),
            [](const TrueWidth& a, const TrueWidth& b) { return a.start_m < b.start_m; });
  return widths;
}

}  // namespace gramap::test
