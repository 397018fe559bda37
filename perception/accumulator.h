// The ball accumulator, sparse: a hash of the cells that got votes.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "perception/scan.h"

namespace gramap {

/// The angle of (x, y) from the x axis, y ≥ 0, in radians, 0 to π; off by at most 1e-5 (Abramowitz and
/// Stegun, Handbook of Mathematical Functions, 4.4.49). The library's functions took a sixth of the voting.
inline float fast_angle(float x, float y) {
  const float a = std::abs(x), least = std::min(a, y), most = std::max(a, y);
  const float t = most > 0 ? least / most : 0, s = t * t;
  float angle = t * (0.9998660f + s * (-0.3302995f + s * (0.1801410f + s * (-0.0851330f + s * 0.0208351f))));
  if (y > a) angle = std::numbers::pi_v<float> / 2 - angle;
  return x < 0 ? std::numbers::pi_v<float> - angle : angle;
}

class BallAccumulator {
 public:
  struct alignas(32) Cell {  // two to a cache line
    std::uint64_t key = 0;   ///< 0: free
    std::uint32_t round = 0;
    std::uint32_t votes : 31 = 0;
    bool refused : 1 = false;
    Eigen::Vector3f normal_sum = Eigen::Vector3f::Zero();
    float rho_sum = 0;
  };

  BallAccumulator(double angle_cell_rad, double rho_cell_m)
      : angle_cell_(static_cast<float>(angle_cell_rad)),
        rho_cell_(static_cast<float>(rho_cell_m)),
        cells_(kCells) {
    for (float latitude = 0; latitude * angle_cell_ < std::numbers::pi_v<float> + angle_cell_; ++latitude)
      around_.push_back(std::max(
          1.0f, std::round(2 * std::numbers::pi_v<float> * std::sin(latitude * angle_cell_) / angle_cell_)));
  }

  /// Votes for the plane normal · p = rho, rho ≥ 0; the cell that got the vote.
  Cell& vote(const Eigen::Vector3f& normal, float rho) {
    const auto latitude = static_cast<std::uint64_t>(
        fast_angle(normal.z(), std::sqrt(normal.x() * normal.x() + normal.y() * normal.y())) / angle_cell_ +
        0.5f);
    const float around = around_[latitude];
    const float half = fast_angle(normal.x(), std::abs(normal.y())) / (2 * std::numbers::pi_v<float>);
    const float turn = normal.y() < 0 ? 1 - half : half;
    const std::uint64_t longitude =
        std::min(static_cast<std::uint64_t>(turn * around), static_cast<std::uint64_t>(around) - 1);
    const auto distance = static_cast<std::uint64_t>(rho / rho_cell_);
    const std::uint64_t key = 1 + latitude + (longitude << 12) + (distance << 24);
    std::size_t at = (key * 0x9e3779b97f4a7c15u) >> (64 - kBits);
    while (cells_[at].round == round_ && cells_[at].key != key) at = (at + 1) & (kCells - 1);
    Cell& cell = cells_[at];
    if (cell.round != round_) {
      cell = Cell{.key = key, .round = round_};
      if (++used_ > kCells / 2) {  // votes all over the place: forget them, keep this one
        clear();
        return vote(normal, rho);
      }
    }
    ++cell.votes;
    cell.normal_sum += normal;
    cell.rho_sum += rho;
    return cell;
  }

  void clear() {
    ++round_;
    used_ = 0;
  }

 private:
  static constexpr int kBits = 16;
  static constexpr std::size_t kCells = std::size_t{1} << kBits;
  float angle_cell_, rho_cell_;
  std::vector<float> around_;  ///< cells of each latitude
  std::vector<Cell> cells_;
  std::uint32_t round_ = 1;
  std::size_t used_ = 0;
};

}  // namespace gramap
