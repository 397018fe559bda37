// Points by voxel, to draw one's neighbours at random without searching.
#pragma once

#include <cstdint>
#include <vector>

#include "perception/random.h"
#include "perception/scan.h"

namespace gramap {

/// Keeps its points ordered by cubic voxel. A point's neighbours are those of its own voxel and the 26 around
/// it.
class Neighbourhood {
 public:
  Neighbourhood(std::vector<Point> points, double edge_m);

  const std::vector<Point>& points() const { return points_; }
  /// A point at random from the neighbourhood of point `i`, itself included.
  std::uint32_t draw(std::uint32_t i, Random& random) const;
  /// A point at random, every voxel that has points being as likely as any other: sparse places, far from the
  /// scanner, get their turn like dense ones.
  std::uint32_t draw_by_place(Random& random) const;
  /// Takes out the points whose flag is set; flags are in the order of points().
  void remove(const std::vector<std::uint8_t>& flagged);

 private:
  struct Voxel {
    std::uint32_t begin = 0, end = 0;
    std::uint32_t around = 0;           ///< points of the neighbourhood
    std::uint32_t first_neighbour = 0;  ///< into neighbours_
    std::uint32_t neighbour_count = 0;
  };
  void count_around();

  std::vector<Point> points_;
  std::vector<std::uint32_t> voxel_of_;  ///< of each point
  std::vector<Voxel> voxels_;
  std::vector<std::uint32_t> neighbours_;
  std::vector<std::uint32_t> up_to_;   ///< points of a voxel's neighbours up to and with this one
  std::vector<std::uint32_t> filled_;  ///< voxels that still have points
};

}  // namespace gramap
