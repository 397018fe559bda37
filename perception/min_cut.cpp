#include "perception/min_cut.h"

#include <algorithm>

namespace gramap {
namespace {

constexpr double kNothing = 1e-9;

}  // namespace

void MinCut::connect(std::size_t a, std::size_t b, double there, double back) {
  arcs_of_[a].push_back(arcs_.size());
  arcs_.push_back({b, there});
  arcs_of_[b].push_back(arcs_.size());
  arcs_.push_back({a, back});
}

bool MinCut::layer(std::size_t source, std::size_t sink) {
  depth_.assign(arcs_of_.size(), -1);
  std::vector<std::size_t> queue = {source};
  depth_[source] = 0;
  for (std::size_t i = 0; i < queue.size(); ++i)
    for (const std::size_t arc : arcs_of_[queue[i]])
      if (arcs_[arc].left > kNothing && depth_[arcs_[arc].to] < 0) {
        depth_[arcs_[arc].to] = depth_[queue[i]] + 1;
        queue.push_back(arcs_[arc].to);
      }
  return depth_[sink] >= 0;
}

double MinCut::push(std::size_t node, std::size_t sink, double limit) {
  if (node == sink) return limit;
  for (std::size_t& i = next_[node]; i < arcs_of_[node].size(); ++i) {
    const std::size_t arc = arcs_of_[node][i];
    const std::size_t to = arcs_[arc].to;
    if (arcs_[arc].left <= kNothing || depth_[to] != depth_[node] + 1) continue;
    const double pushed = push(to, sink, std::min(limit, arcs_[arc].left));
    if (pushed > 0) {
      arcs_[arc].left -= pushed;
      arcs_[arc ^ 1].left += pushed;
      return pushed;
    }
  }
  return 0;
}

std::vector<bool> MinCut::source_side(std::size_t source, std::size_t sink) {
  while (layer(source, sink)) {
    next_.assign(arcs_of_.size(), 0);
    while (push(source, sink, 1e300) > 0) {
    }
  }
  std::vector<bool> side(arcs_of_.size());
  for (std::size_t i = 0; i < side.size(); ++i) side[i] = depth_[i] >= 0;
  return side;
}

}  // namespace gramap
