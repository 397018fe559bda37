#include "perception/coverage.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace gramap {

ScannerCoverage::ScannerCoverage(const Vec3& scanner, std::span<const Eigen::Vector3f> points)
    : bins_(kBins) {
  std::vector<Bin> seen(kBins);
  std::vector<float> distances;
  distances.reserve(points.size());
  for (const Eigen::Vector3f& point : points) {
    const Vec3 offset = point.cast<double>() - scanner;
    const double distance = offset.norm();
    if (distance < 0.05) continue;
    distances.push_back(static_cast<float>(distance));
    Bin& bin = seen[static_cast<std::size_t>(bin_of(offset))];
    const auto sine = static_cast<float>(offset.z() / distance);
    bin.low = std::min(bin.low, sine), bin.high = std::max(bin.high, sine);
  }
  // A window from wall to wall leaves bins without a return above or below; their neighbours speak for them.
  for (int i = 0; i < kBins; ++i)
    for (const int j : {i + kBins - 1, i, i + 1}) {
      const Bin& near = seen[static_cast<std::size_t>(j % kBins)];
      Bin& bin = bins_[static_cast<std::size_t>(i)];
      bin.low = std::min(bin.low, near.low), bin.high = std::max(bin.high, near.high);
    }
  if (distances.empty()) return;
  const auto nth =
      distances.begin() + static_cast<std::ptrdiff_t>(0.995 * static_cast<double>(distances.size() - 1));
  std::nth_element(distances.begin(), nth, distances.end());
  reach_m_ = *nth;
}

int ScannerCoverage::bin_of(const Vec3& offset) {
  const double turn = std::atan2(offset.y(), offset.x()) / (2 * std::numbers::pi) + 0.5;
  return std::clamp(static_cast<int>(turn * kBins), 0, kBins - 1);
}

bool ScannerCoverage::covers(const Vec3& offset) const {
  const double distance = offset.norm();
  const Bin& bin = bins_[static_cast<std::size_t>(bin_of(offset))];
  const double sine = offset.z() / distance;
  return distance < reach_m_ && sine >= bin.low && sine <= bin.high;
}

}  // namespace gramap
