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

/// Distance of a channel's middle from the hallway wall; < 0: it has the whole depth.
double middle_depth_m(const CoverageChannel& channel) {
  return channel.depth_m < 0 ? -1 : channel.depth_start_m + 0.5 * channel.depth_m;
}

bool covers_depth(const CoverageChannel& channel, double depth_m) {
  if (channel.depth_m < 0 || depth_m < 0) return true;
  return channel.depth_start_m <= depth_m && depth_m < channel.depth_start_m + channel.depth_m;
}

/// Rooms whose like is looked for, by their middles.
class Wanted {
 public:
  Wanted(const Grid& grid, std::span<SameRoom> rooms)
      : grid_(grid), tolerance_(static_cast<int>(std::lround(kSameWidth_m / grid.step_m))) {
    for (SameRoom& room : rooms) rooms_.push_back(&room);
    std::stable_sort(rooms_.begin(), rooms_.end(),
                     [](const SameRoom* a, const SameRoom* b) { return a->middle < b->middle; });
  }

  /// Takes note of a room of an element that spans from `cell` to the cells of the move, with these
  /// probabilities.
  void add(const ElementRoom& room, int cell, const Move& move, const std::vector<double>& probabilities) {
    const CoverageChannel channel = channel_of(room);
    const bool whole = is_whole(room);
    const auto first = std::lower_bound(rooms_.begin(), rooms_.end(), cell,
                                        [](const SameRoom* wanted, int at) { return wanted->middle < at; });
    for (auto at = first; at != rooms_.end() && (*at)->middle < move.last_cell(); ++at) {
      SameRoom& wanted = **at;
      if (!covers_depth(channel, middle_depth_m(wanted.channel))) continue;
      for (int i = 0; i < move.count; ++i) {
        const int width = move.first_cell + i * move.stride - cell;
        const CellRange range = whole ? CellRange{0, width} : covered(room, grid_, width);
        if (cell + range.begin > wanted.middle || wanted.middle >= cell + range.end) continue;
        const double p = probabilities[static_cast<std::size_t>(i)];
        const int off = range.end - range.begin - wanted.width;
        if (wanted.channel == channel && std::abs(off) <= tolerance_) wanted.probability += p;
        wanted.width_deviation_m += p * off * off;  // squares, in cells, until `finish`
      }
    }
  }

  void finish() {
    for (SameRoom* room : rooms_) room->width_deviation_m = std::sqrt(room->width_deviation_m) * grid_.step_m;
  }

 private:
  const Grid& grid_;
  int tolerance_;
  std::vector<SameRoom*> rooms_;
};

}  // namespace

std::vector<SameRoom> rooms_of(const Lattice& lattice, const std::vector<PathStep>& path) {
  std::vector<SameRoom> rooms;
  for (const PathStep& step : path)
    for (const ElementRoom& room : placed_element(lattice, step).rooms) {
      const CellRange range = covered(room, lattice.grid(), step.width);
      rooms.push_back(
          {channel_of(room), step.cell + (range.begin + range.end) / 2, range.end - range.begin, 0, 0});
    }
  return rooms;
}

Coverage cover(const Lattice& lattice, const NodeTable& forward, const NodeTable& backward,
               const std::vector<double>& posteriors, std::span<SameRoom> rooms) {
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
  Wanted wanted(grid, rooms);
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
            wanted.add(element.rooms[r], cell, move, probabilities);
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
  wanted.finish();
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
      const double depth = middle_depth_m(channel_of(room));
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
