// Upright and level edges in a wall's depth image.
#pragma once

#include <vector>

#include "perception/label_image.h"

namespace gramap {

/// An edge in pixels: an upright one stands at column `at` and runs over rows from `low` to `high`; a level
/// one lies at row `at` and runs over columns.
struct EdgeLine {
  int at = 0, low = 0, high = 0;
};

struct WallEdges {
  std::vector<EdgeLine> upright, level;  ///< ordered by `at`; the wall's borders are the first and the last
};

/// Canny and Sobel on the depth image, then the probabilistic Hough transform (Matas, Galambos, Kittler
/// 2000); edges nearer than `merge_m` become one, of each direction the `most` longest are kept.
WallEdges wall_edges(const WallImage& wall, double merge_m, int most);

}  // namespace gramap
