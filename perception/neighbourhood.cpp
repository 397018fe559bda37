#include "perception/neighbourhood.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace gramap {
namespace {

constexpr std::uint64_t kAxisBits = 21, kAxisMask = (std::uint64_t{1} << kAxisBits) - 1;

std::uint64_t key_of(std::int64_t x, std::int64_t y, std::int64_t z) {
  return (static_cast<std::uint64_t>(x) & kAxisMask) << (2 * kAxisBits) |
         (static_cast<std::uint64_t>(y) & kAxisMask) << kAxisBits |
         (static_cast<std::uint64_t>(z) & kAxisMask);
}

}  // namespace

Neighbourhood::Neighbourhood(std::vector<Point> points, double edge_m) {
  // Voxels in the order of their keys, points in the order they came: keys are sorted, points only counted.
  std::unordered_map<std::uint64_t, std::uint32_t> at;
  std::vector<std::uint64_t> keys;
  std::vector<std::uint32_t> found_as(points.size());
  const double scale = 1 / edge_m;
  const auto index = [&](float coordinate) {
    return static_cast<std::int64_t>(std::floor(static_cast<double>(coordinate) * scale));
  };
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const std::uint64_t key = key_of(index(points[i].x()), index(points[i].y()), index(points[i].z()));
    const auto [found, is_new] = at.try_emplace(key, static_cast<std::uint32_t>(keys.size()));
    if (is_new) keys.push_back(key);
    found_as[i] = found->second;
  }
  std::vector<std::uint32_t> place(keys.size());  // in order, of each as it was found
  std::sort(keys.begin(), keys.end());
  for (std::uint32_t i = 0; i < keys.size(); ++i) {
    std::uint32_t& known = at.find(keys[i])->second;
    place[known] = i;
    known = i;
  }
  voxels_.resize(keys.size());
  for (const std::uint32_t found : found_as) ++voxels_[place[found]].end;
  std::uint32_t begin = 0;
  for (Voxel& voxel : voxels_) {
    voxel.begin = begin;
    begin += voxel.end;
    voxel.end = voxel.begin;
  }
  points_.resize(points.size());
  voxel_of_.resize(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const std::uint32_t voxel = place[found_as[i]];
    points_[voxels_[voxel].end] = points[i];
    voxel_of_[voxels_[voxel].end++] = voxel;
  }
  for (std::uint32_t i = 0; i < keys.size(); ++i) {
    voxels_[i].first_neighbour = static_cast<std::uint32_t>(neighbours_.size());
    const std::uint64_t x = keys[i] >> (2 * kAxisBits), y = (keys[i] >> kAxisBits) & kAxisMask,
                        z = keys[i] & kAxisMask;
    for (int dx = -1; dx <= 1; ++dx)
      for (int dy = -1; dy <= 1; ++dy)
        for (int dz = -1; dz <= 1; ++dz) {
          const auto found =
              at.find(key_of(static_cast<std::int64_t>(x) + dx, static_cast<std::int64_t>(y) + dy,
                             static_cast<std::int64_t>(z) + dz));
          if (found != at.end()) neighbours_.push_back(found->second);
        }
    voxels_[i].neighbour_count = static_cast<std::uint32_t>(neighbours_.size()) - voxels_[i].first_neighbour;
  }
  up_to_.resize(neighbours_.size());
  count_around();
}

void Neighbourhood::count_around() {
  filled_.clear();
  for (std::uint32_t i = 0; i < voxels_.size(); ++i)
    if (voxels_[i].end > voxels_[i].begin) filled_.push_back(i);
  for (Voxel& voxel : voxels_) {
    voxel.around = 0;
    for (std::uint32_t n = 0; n < voxel.neighbour_count; ++n) {
      const Voxel& neighbour = voxels_[neighbours_[voxel.first_neighbour + n]];
      voxel.around += neighbour.end - neighbour.begin;
      up_to_[voxel.first_neighbour + n] = voxel.around;
    }
  }
}

std::uint32_t Neighbourhood::draw(std::uint32_t i, Random& random) const {
  const Voxel& voxel = voxels_[voxel_of_[i]];
  const auto skip = static_cast<std::uint32_t>(random.below(static_cast<int>(voxel.around)));
  std::uint32_t n = voxel.first_neighbour;
  while (up_to_[n] <= skip) ++n;
  return voxels_[neighbours_[n]].end - (up_to_[n] - skip);
}

std::uint32_t Neighbourhood::draw_by_place(Random& random) const {
  const Voxel& voxel =
      voxels_[filled_[static_cast<std::size_t>(random.below(static_cast<int>(filled_.size())))]];
  return voxel.begin + static_cast<std::uint32_t>(random.below(static_cast<int>(voxel.end - voxel.begin)));
}

void Neighbourhood::remove(const std::vector<std::uint8_t>& flagged) {
  std::uint32_t kept = 0;
  for (Voxel& voxel : voxels_) {
    const std::uint32_t begin = kept;
    for (std::uint32_t i = voxel.begin; i < voxel.end; ++i)
      if (!flagged[i]) {
        points_[kept] = points_[i];
        voxel_of_[kept++] = voxel_of_[i];
      }
    voxel.begin = begin;
    voxel.end = kept;
  }
  points_.resize(kept);
  voxel_of_.resize(kept);
  count_around();
}

}  // namespace gramap
