// How far points lie from the surface that they were measured on, by their distance from the scanner.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "perception/hough.h"
#include "perception/scan.h"

namespace gramap {

/// The noise of points by range, learned from residuals: a depth camera's grows with the square of the range,
/// a laser's hardly at all.
class RangeNoise {
 public:
  /// Standard deviation in metres.
  double at(double range_m) const { return sigma_m_[bin(range_m)]; }

  /// Takes a residual into account when `learn` is called next. Metres.
  void add(double range_m, double residual_m) {
    residuals_[bin(range_m)].push_back(static_cast<float>(residual_m < 0 ? -residual_m : residual_m));
  }

  /// Learns from the residuals added since the last time, robustly: from each bin's median. Bins with few
  /// take over the next nearer one's noise, or the next farther one's.
  void learn() {
    double last = 0;
    for (std::size_t b = 0; b < kBins; ++b) {
      std::vector<float>& list = residuals_[b];
      if (list.size() >= 50) {
        const auto middle = list.begin() + static_cast<std::ptrdiff_t>(list.size() / 2);
        std::nth_element(list.begin(), middle, list.end());
        const bool first = last == 0;
        last = std::clamp(1.4826 * static_cast<double>(*middle), 0.001, largest_m_);
        if (first) std::fill_n(sigma_m_.begin(), b, last);
      }
      if (last > 0) sigma_m_[b] = last;
      list.clear();
    }
  }

  explicit RangeNoise(double largest_m) : largest_m_(largest_m), sigma_m_(kBins, 0.02), residuals_(kBins) {}

 private:
  static constexpr std::size_t kBins = 40;
  static std::size_t bin(double range_m) {
    return std::min(kBins - 1, static_cast<std::size_t>(range_m / 0.5));
  }
  double largest_m_;
  std::vector<double> sigma_m_;
  std::vector<std::vector<float>> residuals_;
};

/// The noise of points across the plane that they lie on, by range and by how steeply the ray meets the
/// plane: of noise along the ray, a grazing ray shows little.
class FaceNoise {
 public:
  FaceNoise() : by_slope_(kSlopes, RangeNoise(kLargest_m)) {}
  /// Standard deviation in metres; `slope` is the cosine between the ray and the plane's normal.
  double at(double range_m, double slope) const { return by_slope_[bin(slope)].at(range_m); }
  void add(double range_m, double slope, double residual_m) {
    by_slope_[bin(slope)].add(range_m, residual_m);
  }
  void learn() {
    for (RangeNoise& noise : by_slope_) noise.learn();
  }
  static constexpr double kLargest_m = 0.1;

 private:
  static constexpr std::size_t kSlopes = 5;
  static std::size_t bin(double slope) {
    return std::min(kSlopes - 1, static_cast<std::size_t>(std::abs(slope) * kSlopes));
  }
  std::vector<RangeNoise> by_slope_;
};

/// The noise along the ray, in metres, of a room's points: from those on planes that the scanner saw steeply
/// enough.
RangeNoise learned_noise(const std::vector<PlanePatch>& planes, const RegisteredCloud& cloud);

}  // namespace gramap
