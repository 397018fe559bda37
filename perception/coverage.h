// Which directions a scan looked in at all, so that no return there means that nothing was in reach.
#pragma once

#include <span>
#include <vector>

#include "geometry/types.h"

namespace gramap {

/// For each few degrees of azimuth, the elevations between the lowest and the highest return, and the reach:
/// hardly any return was farther.
class ScannerCoverage {
 public:
  ScannerCoverage(const Vec3& scanner, std::span<const Eigen::Vector3f> points);
  bool covers(const Vec3& offset) const;  ///< of a place, from the scanner

 private:
  static constexpr int kBins = 72;
  struct Bin {
    float low = 2, high = -2;  // tangents of elevation are unbounded; sines are kept
  };
  static int bin_of(const Vec3& offset);
  std::vector<Bin> bins_;
  double reach_m_ = 0;
};

}  // namespace gramap
