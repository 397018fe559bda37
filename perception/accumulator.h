// The ball accumulator, sparse: a hash of the cells that got votes.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "perception/scan.h"

namespace gramap {

class BallAccumulator {
 public:
  struct Cell {
    std::uint64_t key = 0;  ///< 0: free
    std::uint32_t round = 0;
    int votes = 0;
    Eigen::Vector3f normal_sum = Eigen::Vector3f::Zero();
    float rho_sum = 0;
    bool refused = false;
  };

  BallAccumulator(double angle_cell_rad, double rho_cell_m)
      : angle_cell_(static_cast<float>(angle_cell_rad)),
        rho_cell_(static_cast<float>(rho_cell_m)),
        cells_(kCells) {}

  /// Votes for the plane normal · p = rho, rho ≥ 0; the cell that got the vote.
  Cell& vote(const Eigen::Vector3f& normal, float rho) {
    constexpr float pi = std::numbers::pi_v<float>;
    const auto latitude =
        static_cast<std::uint64_t>(std::acos(std::clamp(normal.z(), -1.0f, 1.0f)) / angle_cell_ + 0.5f);
    const float around = std::max(
        1.0f, std::round(2 * pi * std::sin(static_cast<float>(latitude) * angle_cell_) / angle_cell_));
    const float turn = std::atan2(normal.y(), normal.x()) / (2 * pi) + 0.5f;
    const std::uint64_t longitude =
        static_cast<std::uint64_t>(turn * around) % static_cast<std::uint64_t>(around);
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
  std::vector<Cell> cells_;
  std::uint32_t round_ = 1;
  std::size_t used_ = 0;
};

}  // namespace gramap
