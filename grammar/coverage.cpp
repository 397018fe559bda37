#include "grammar/coverage.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "grammar/explanation.h"
#include "grammar/placed_rooms.h"

namespace gramap {
namespace {

/// Cells that a room of an element covers, relative to the element's first: begin inclusive, end exclusive.
struct CellRange {
  int begin;
  int end;
};

CellRange covered(const ElementRoom& room, const Grid& grid, int width) {
  const double clear_m = grid.width_m(width);
  const double start = room.start.at(clear_m);
  const double end = start + room.width.at(clear_m) + grid.wall_m;
  return {std::clamp(static_cast<int>(std::lround(start / grid.step_m)), 0, width),
          std::clamp(static_cast<int>(std::lround(end / grid.step_m)), 0, width)};
}

CoverageChannel channel_of(const ElementRoom& room) {
  return {room.type, room.depth_start_m, room.depth_m};
}

bool covers_depth(const CoverageChannel& channel, double depth_m) {
  if (channel.depth_m < 0 || depth_m < 0) return true;
  return channel.depth_start_m <= depth_m && depth_m < channel.depth_start_m + channel.depth_m;
}

}  // namespace

Coverage cover(const Lattice& lattice, const NodeTable& forward, const NodeTable& backward,
               const std::vector<double>& posteriors) {
  const Grid& grid = lattice.grid();
  const auto cells = static_cast<std::size_t>(grid.cells) + 1;
  Coverage changes;  // first of the probability from cell to cell, then summed up
  std::vector<std::vector<std::vector<double>*>> of_rooms;  // [element][room]: its channel's changes
  for (const Element& element : lattice.row().elements) {
    of_rooms.emplace_back();
    for (const ElementRoom& room : element.rooms) {
      std::vector<double>& change = changes[channel_of(room)];
      change.resize(cells, 0);
      of_rooms.back().push_back(&change);
    }
  }

  const double total = log_total(lattice, forward);
  Edges edges(lattice);
  Departures departures(lattice);
  std::vector<double> probabilities;
  for (int cell = 0; cell < grid.cells; ++cell) {
    for_each_evidence_state(lattice, cell, [&](int e) {
      for (int state = 0; state < lattice.states(); ++state) {
        const std::size_t node = lattice.node(cell, state, e);
        if (posteriors[node] < kDeadPosterior) continue;
        for (const Arc& arc : lattice.arcs(state, cell)) departures.add(arc, forward.value[node]);
      }
      departures.take([&](int id, double departing) {
        const Emission& emission = lattice.row().emissions[static_cast<std::size_t>(id)];
        const auto which = static_cast<std::size_t>(emission.element);
        const Element& element = lattice.row().elements[which];
        for (const Move& move : edges.moves(cell, emission.element, e)) {
          const double* target =
              &backward.value[lattice.node(move.first_cell, emission.target, move.target_evidence)];
          double scale_of = std::numeric_limits<double>::quiet_NaN();
          double factor = 0;
          double all = 0;
          probabilities.assign(static_cast<std::size_t>(move.count), 0);
          for (int i = 0; i < move.count; ++i) {
            const double weight = move.sum[i] * target[i * move.stride];
            if (weight <= 0) continue;
            const double scale =
                backward.log_scale[static_cast<std::size_t>(move.first_cell + i * move.stride)];
            if (scale != scale_of) {
              scale_of = scale;
              factor =
                  departing * std::exp(forward.log_scale[static_cast<std::size_t>(cell)] + scale - total);
            }
            probabilities[static_cast<std::size_t>(i)] = factor * weight;
            all += factor * weight;
          }
          if (all < kDeadPosterior) continue;
          for (std::size_t r = 0; r < element.rooms.size(); ++r) {
            std::vector<double>& change = *of_rooms[which][r];
            const bool whole = is_whole(element.rooms[r]);
            if (whole) change[static_cast<std::size_t>(cell)] += all;
            for (int i = 0; i < move.count; ++i) {
              const double p = probabilities[static_cast<std::size_t>(i)];
              const int to = move.first_cell + i * move.stride;
              if (whole) {
                change[static_cast<std::size_t>(to)] -= p;
                continue;
              }
              const CellRange range = covered(element.rooms[r], grid, to - cell);
              change[static_cast<std::size_t>(cell + range.begin)] += p;
              change[static_cast<std::size_t>(cell + range.end)] -= p;
            }
          }
        }
      });
    });
  }
  for (auto& [channel, change] : changes)
    for (std::size_t i = 1; i < cells; ++i) change[i] += change[i - 1];

  return changes;
}

std::vector<double> type_probabilities(const Lattice& lattice, const Coverage& coverage,
                                       const std::vector<PathStep>& path) {
  std::vector<double> probabilities;
  for (const PathStep& step : path) {
    for (const ElementRoom& room : placed_element(lattice, step).rooms) {
      const CellRange range = covered(room, lattice.grid(), step.width);
      const int middle = step.cell + (range.begin + range.end) / 2;
      const double depth = room.depth_m < 0 ? -1 : room.depth_start_m + 0.5 * room.depth_m;
      double probability = 0;
      for (const auto& [channel, covering] : coverage)
        if (channel.type == room.type && covers_depth(channel, depth))
          probability += covering[static_cast<std::size_t>(middle)];
      probabilities.push_back(std::clamp(probability, 0.0, 1.0));
    }
  }
  return probabilities;
}

}  // namespace gramap
