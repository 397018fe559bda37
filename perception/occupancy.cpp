#include "perception/occupancy.h"

#include <octomap/OcTree.h>

#include <algorithm>
#include <cmath>

namespace gramap {
namespace {

/// Leaf by leaf: a leaf of a higher level stands for a cube of voxels.
void fill(BitGrid& grid, const octomap::OcTree& tree) {
  for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf) {
    const double half = 0.5 * leaf.getSize();
    const Vec3 centre(leaf.getX(), leaf.getY(), leaf.getZ());
    const double inset = 0.25 * grid.voxel_m();
    const Eigen::Vector3i first = grid.index_of(grid.low() + centre - Vec3::Constant(half - inset));
    const Eigen::Vector3i last = grid.index_of(grid.low() + centre + Vec3::Constant(half - inset));
    Eigen::Vector3i i;
    for (i.z() = first.z(); i.z() <= last.z(); ++i.z())
      for (i.y() = first.y(); i.y() <= last.y(); ++i.y())
        for (i.x() = first.x(); i.x() <= last.x(); ++i.x())
          if (grid.inside(i)) grid.set(i);
  }
}

}  // namespace

BitGrid::BitGrid(const Vec3& low, const Vec3& high, double voxel_m)
    : low_(low), voxel_m_(voxel_m), size_(((high - low) / voxel_m).array().ceil().cast<int>().cwiseMax(1)) {
  const auto count = static_cast<std::size_t>(size_.x()) * static_cast<std::size_t>(size_.y()) *
                     static_cast<std::size_t>(size_.z());
  words_.resize(count / 64 + 1);
}

BitGrid occupied_voxels(std::span<const Eigen::Vector3f> points, const Vec3& low, const Vec3& high,
                        double voxel_m) {
  // The tree's origin is the box's corner, so that its voxels are the grid's.
  octomap::OcTree tree(voxel_m);
  std::vector<std::uint64_t> keys;
  keys.reserve(points.size());
  for (const Eigen::Vector3f& point : points) {
    const Vec3 p = point.cast<double>();
    if ((p.array() < low.array()).any() || (p.array() >= high.array()).any()) continue;
    const octomap::OcTreeKey key = tree.coordToKey(p.x() - low.x(), p.y() - low.y(), p.z() - low.z());
    keys.push_back((std::uint64_t{key[2]} << 32) | (std::uint64_t{key[1]} << 16) | key[0]);
  }
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  for (const std::uint64_t key : keys)
    tree.setNodeValue(
        octomap::OcTreeKey(static_cast<octomap::key_type>(key), static_cast<octomap::key_type>(key >> 16),
                           static_cast<octomap::key_type>(key >> 32)),
        tree.getClampingThresMaxLog(), true);
  tree.updateInnerOccupancy();
  BitGrid grid(low, high, voxel_m);
  fill(grid, tree);
  return grid;
}

}  // namespace gramap
