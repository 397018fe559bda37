#include "grammar/coverage.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "grammar/explanation.h"
#include "grammar/placed_rooms.h"

namespace gramap {
namespace {

constexpr double kNegligible = 1e-15;  // probability of a node or of a move that is left out

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

/// The edges of a move with their posterior probabilities, and sums over those that are at least as wide:
/// of the probability, of it times the width in cells, of it times the width squared.
struct WeighedMove {
  const Move* move = nullptr;
  int cell = 0;
  std::vector<double> probabilities;
  std::vector<std::array<double, 3>> wider;  // [index], to one beyond the last

  int width(int i) const { return move->first_cell + i * move->stride - cell; }

  /// The first index whose edge is at least this wide.
  std::size_t from_width(int least) const {
    const int missing = least - width(0);
    return static_cast<std::size_t>(std::clamp((missing + move->stride - 1) / move->stride, 0, move->count));
  }

  void sum_up() {
    wider.resize(probabilities.size() + 1);
    wider.back() = {0, 0, 0};
    for (std::size_t i = probabilities.size(); i-- > 0;) {
      const double p = probabilities[i];
      const double w = width(static_cast<int>(i));
      wider[i] = {wider[i + 1][0] + p, wider[i + 1][1] + p * w, wider[i + 1][2] + p * w * w};
    }
  }

  double probability(std::size_t from, std::size_t to) const { return wider[from][0] - wider[to][0]; }
  /// Of the width less `about`, in cells.
  double mean_square(std::size_t from, std::size_t to, double about) const {
    return (wider[from][2] - wider[to][2]) - 2 * about * (wider[from][1] - wider[to][1]) +
           about * about * (wider[from][0] - wider[to][0]);
  }
};

/// Rooms whose like is looked for, by their middles, and walls, in order.
class Wanted {
 public:
  Wanted(const Grid& grid, std::span<SameRoom> rooms, std::span<SameWall> walls)
      : grid_(grid), tolerance_(static_cast<int>(std::lround(kSameWidth_m / grid.step_m))), walls_(walls) {
    for (SameRoom& room : rooms) rooms_.push_back(&room);
    std::stable_sort(rooms_.begin(), rooms_.end(),
                     [](const SameRoom* a, const SameRoom* b) { return a->middle < b->middle; });
  }

  /// Takes note of a room of the elements that the edges place.
  void add(const ElementRoom& room, const WeighedMove& edges) {
    const CoverageChannel channel = channel_of(room);
    const bool whole = is_whole(room);
    const int cell = edges.cell;
    const auto first = std::lower_bound(rooms_.begin(), rooms_.end(), cell,
                                        [](const SameRoom* wanted, int at) { return wanted->middle < at; });
    for (auto at = first; at != rooms_.end() && (*at)->middle < edges.move->last_cell(); ++at) {
      SameRoom& wanted = **at;
      if (!covers_depth(channel, middle_depth_m(wanted.channel))) continue;
      if (whole) {
        const std::size_t from = edges.from_width(wanted.middle - cell + 1);
        const std::size_t all = edges.probabilities.size();
        wanted.width_deviation_m += edges.mean_square(from, all, wanted.width);
        if (wanted.channel == channel) {
          const std::size_t narrowest = std::max(from, edges.from_width(wanted.width - tolerance_));
          const std::size_t widest = std::max(from, edges.from_width(wanted.width + tolerance_ + 1));
          wanted.probability += edges.probability(narrowest, widest);
        }
        continue;
      }
      for (int i = 0; i < edges.move->count; ++i) {
        const CellRange range = covered(room, grid_, edges.width(i));
        if (cell + range.begin > wanted.middle || wanted.middle >= cell + range.end) continue;
        const double p = edges.probabilities[static_cast<std::size_t>(i)];
        const int off = range.end - range.begin - wanted.width;
        if (wanted.channel == channel && std::abs(off) <= tolerance_) wanted.probability += p;
        wanted.width_deviation_m += p * off * off;  // squares, in cells, until `finish`
      }
    }
  }

  /// Takes note of the walls that the edges pass over: the nearest is where they begin or where they end.
  void add_walls(const WeighedMove& edges) {
    const int cell = edges.cell;
    const auto first = std::lower_bound(walls_.begin(), walls_.end(), cell,
                                        [](const SameWall& wanted, int at) { return wanted.cell < at; });
    for (auto wanted = first; wanted != walls_.end() && wanted->cell < edges.move->last_cell(); ++wanted) {
      const int behind = wanted->cell - cell;
      const std::size_t all = edges.probabilities.size();
      const std::size_t nearer_end = edges.from_width(behind + 1);
      const std::size_t nearer_start = std::max(nearer_end, edges.from_width(2 * behind));
      wanted->deviation_m += edges.mean_square(nearer_end, nearer_start, behind) +
                             1.0 * behind * behind * edges.probability(nearer_start, all);
    }
  }

  void finish() {
    const auto metres = [&](double square_cells) {
      return std::sqrt(std::max(0.0, square_cells)) * grid_.step_m;
    };
    for (SameRoom* room : rooms_) room->width_deviation_m = metres(room->width_deviation_m);
    for (SameWall& wall : walls_) wall.deviation_m = metres(wall.deviation_m);
  }

 private:
  const Grid& grid_;
  int tolerance_;
  std::vector<SameRoom*> rooms_;
  std::span<SameWall> walls_;
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

std::vector<SameWall> walls_of(const std::vector<PathStep>& path) {
  std::vector<SameWall> walls;
  for (std::size_t i = 1; i < path.size(); ++i) walls.push_back({path[i].cell, 0});
  return walls;
}

Coverage cover(const Lattice& lattice, const NodeTable& forward, const NodeTable& backward,
               const std::vector<double>& posteriors, std::span<SameRoom> rooms, std::span<SameWall> walls) {
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
  Wanted wanted(grid, rooms, walls);
  WeighedMove weighed;
  for (int cell = 0; cell < grid.cells; ++cell) {
    weighed.cell = cell;
    for_each_evidence_state(lattice, cell, [&](int e) {
      for (int state = 0; state < lattice.states(); ++state) {
        const std::size_t node = lattice.node(cell, state, e);
        if (posteriors[node] < kNegligible) continue;
        for (const Arc& arc : lattice.arcs(state, cell)) departures.add(arc, forward.value[node]);
      }
      departures.take([&](int id, double departing) {
        const Emission& emission = lattice.row().emissions[static_cast<std::size_t>(id)];
        const auto which = static_cast<std::size_t>(emission.element);
        const Element& element = lattice.row().elements[which];
        const double reference = forward.log_scale[static_cast<std::size_t>(cell)] - total;
        for (const Move& move : edges.moves(cell, emission.element, e)) {
          const double* target =
              &backward.value[lattice.node(move.first_cell, emission.target, move.target_evidence)];
          double scale_of = backward.log_scale[static_cast<std::size_t>(move.first_cell)];
          double factor = departing * std::exp(reference + scale_of);
          if (has_one_scale(backward, move, scale_of) &&
              factor * dot(move.sum, target, move.stride, move.count) < kNegligible)
            continue;
          double all = 0;
          weighed.move = &move;
          weighed.probabilities.assign(static_cast<std::size_t>(move.count), 0);
          for (int i = 0; i < move.count; ++i) {
            const double weight = move.sum[i] * target[i * move.stride];
            if (weight <= 0) continue;
            const double scale =
                backward.log_scale[static_cast<std::size_t>(move.first_cell + i * move.stride)];
            if (scale != scale_of) {
              scale_of = scale;
              factor = departing * std::exp(reference + scale);
            }
            weighed.probabilities[static_cast<std::size_t>(i)] = factor * weight;
            all += factor * weight;
          }
          if (all < kNegligible) continue;
          weighed.sum_up();
          wanted.add_walls(weighed);
          for (std::size_t r = 0; r < element.rooms.size(); ++r) {
            std::vector<double>& change = *of_rooms[which][r];
            wanted.add(element.rooms[r], weighed);
            const bool whole = is_whole(element.rooms[r]);
            if (whole) change[static_cast<std::size_t>(cell)] += all;
            for (int i = 0; i < move.count; ++i) {
              const double p = weighed.probabilities[static_cast<std::size_t>(i)];
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
