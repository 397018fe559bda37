// Minimum cut of a small graph (Dinic's algorithm), for two-way labellings.
#pragma once

#include <cstddef>
#include <vector>

namespace gramap {

class MinCut {
 public:
  explicit MinCut(std::size_t nodes) : arcs_of_(nodes) {}
  /// Joins two nodes by arcs of the given capacities, both ways.
  void connect(std::size_t a, std::size_t b, double there, double back);
  /// For every node, whether it is on the source's side of the minimum cut.
  std::vector<bool> source_side(std::size_t source, std::size_t sink);

 private:
  struct Arc {
    std::size_t to;
    double left;  ///< capacity not yet used; the reverse of arc i is arc i ^ 1
  };
  bool layer(std::size_t source, std::size_t sink);
  double push(std::size_t node, std::size_t sink, double limit);

  std::vector<Arc> arcs_;
  std::vector<std::vector<std::size_t>> arcs_of_;
  std::vector<int> depth_;
  std::vector<std::size_t> next_;
};

}  // namespace gramap
