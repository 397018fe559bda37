#include "grammar/least_error.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

namespace gramap {
namespace {

/// The edges that leave one node, each with the sum of the weights up to it.
struct Choices {
  struct Edge {
    int cell = 0, state = 0, evidence_state = 0, element = 0;
  };
  std::vector<double> cumulative;
  std::vector<Edge> edges;
};

Choices choices_at(const Lattice& lattice, Edges& edges, const NodeTable& backward, const Choices::Edge& at) {
  Choices choices;
  double sum = 0;
  const double here = backward.log_scale[static_cast<std::size_t>(at.cell)];
  for (const Arc& arc : lattice.arcs(at.state, at.cell)) {
    for (const Move& move : edges.moves(at.cell, arc.element, at.evidence_state)) {
      const double* target = &backward.value[lattice.node(move.first_cell, arc.target, move.target_evidence)];
      for (int i = 0; i < move.count; ++i) {
        const int cell = move.first_cell + i * move.stride;
        const double weight = arc.probability * move.sum[i] * target[i * move.stride] *
                              std::exp(backward.log_scale[static_cast<std::size_t>(cell)] - here);
        if (!(weight > 0)) continue;
        choices.cumulative.push_back(sum += weight);
        choices.edges.push_back({cell, arc.target, move.target_evidence, arc.element});
      }
    }
  }
  return choices;
}

void add_rooms(const Element& element, double start_m, double width_m, Stretches& rooms) {
  for (const ElementRoom& room : element.rooms) {
    if (!room.at_hallway) continue;
    const double start = start_m + room.start.at(width_m);
    rooms.push_back({start, start + room.width.at(width_m)});
  }
}

}  // namespace

std::vector<DrawnLayout> draw_layouts(const Lattice& lattice, const NodeTable& backward, int count,
                                      std::uint64_t seed) {
  std::mt19937_64 generator(seed);
  std::vector<DrawnLayout> drawn(static_cast<std::size_t>(count));
  std::map<std::size_t, Choices> known;  // by node: layouts have their first rooms in common
  Edges edges(lattice);
  const Grid& grid = lattice.grid();
  for (DrawnLayout& layout : drawn) {
    Choices::Edge at;
    at.evidence_state = lattice.start().first;
    while (at.cell < grid.cells) {
      const auto [found, unknown] = known.try_emplace(lattice.node(at.cell, at.state, at.evidence_state));
      if (unknown) found->second = choices_at(lattice, edges, backward, at);
      const Choices& choices = found->second;
      if (choices.edges.empty()) break;  // rounding led where nothing can follow: the rest stays open
      const double u = static_cast<double>(generator() >> 11) * 0x1p-53 * choices.cumulative.back();
      const auto place = std::upper_bound(choices.cumulative.begin(), choices.cumulative.end() - 1, u);
      const Choices::Edge next = choices.edges[static_cast<std::size_t>(place - choices.cumulative.begin())];
      add_rooms(lattice.row().elements[static_cast<std::size_t>(next.element)], grid.position_m(at.cell),
                grid.width_m(next.cell - at.cell), layout.rooms);
      layout.elements.push_back(next.element);
      at = next;
    }
  }
  return drawn;
}

Stretches stretches_of(const Lattice& lattice, const std::vector<PathStep>& path,
                       const std::vector<double>& starts_m, double end_m) {
  Stretches rooms;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const Arc& arc = lattice.arcs(path[i].state, path[i].cell)[static_cast<std::size_t>(path[i].arc)];
    const double end = i + 1 < path.size() ? starts_m[i + 1] - lattice.grid().wall_m : end_m;
    add_rooms(lattice.row().elements[static_cast<std::size_t>(arc.element)], starts_m[i], end - starts_m[i],
              rooms);
  }
  return rooms;
}

double width_error_m(const Stretches& truth, const Stretches& found) {
  double sum = 0;
  std::size_t first = 0;
  for (const Stretch& room : truth) {
    while (first < found.size() && found[first].end_m <= room.start_m) ++first;
    const double width = room.end_m - room.start_m;
    double best = 0, error = width;
    for (std::size_t i = first; i < found.size() && found[i].start_m < room.end_m; ++i) {
      const double other = found[i].end_m - found[i].start_m;
      const double shared = std::min(found[i].end_m, room.end_m) - std::max(found[i].start_m, room.start_m);
      const double iou = shared / (width + other - shared);
      if (iou > best) best = iou, error = std::abs(other - width);
    }
    sum += error;
  }
  return sum;
}

std::size_t least_error(const std::vector<Stretches>& candidates, const std::vector<DrawnLayout>& drawn) {
  std::size_t best = 0;
  double least = INFINITY;
  for (std::size_t c = 0; c < candidates.size(); ++c) {
    double error = 0;
    for (const DrawnLayout& layout : drawn) error += width_error_m(layout.rooms, candidates[c]);
    if (error < least) least = error, best = c;
  }
  return best;
}

}  // namespace gramap
