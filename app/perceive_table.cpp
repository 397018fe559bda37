#include "app/perceive_table.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "app/score_table.h"
#include "floor/building.h"
#include "geometry/polygon.h"
#include "perception/truth_match.h"

namespace gramap {
namespace {

/// The perceived ring turned and shifted onto the true one. Scans know neither the building's frame (rooms of
/// their own frame) nor their drift in it, so only shape and size are judged. Every start of the ring is
/// tried, as rings of boxes with sides of different lengths tell apart.
Polygon laid_on(const Polygon& ring, const Polygon& truth) {
  const Vec2 from = centroid(ring), to = centroid(truth);
  Polygon best;
  double least = 1e300;
  const auto try_turn = [&](double turn) {
    Eigen::Matrix2d rotation;
    rotation << std::cos(turn), -std::sin(turn), std::sin(turn), std::cos(turn);
    Polygon moved;
    for (const Vec2& corner : ring) moved.push_back(rotation * (corner - from) + to);
    double squares = 0;
    for (const Vec2& corner : truth) squares += std::pow(distance_to_border(moved, corner), 2);
    for (const Vec2& corner : moved) squares += std::pow(distance_to_border(truth, corner), 2);
    if (squares < least) {
      least = squares;
      best = moved;
    }
  };
  for (std::size_t i = 0; i < truth.size(); ++i)
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Vec2 a = truth[(i + 1) % truth.size()] - truth[i], b = ring[(k + 1) % ring.size()] - ring[k];
      try_turn(std::atan2(a.y(), a.x()) - std::atan2(b.y(), b.x()));
    }
  return best;
}

/// Share of the ring's length that lies within 5 cm of the other ring.
double near_share(const Polygon& ring, const Polygon& other) {
  double near = 0, all = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 way = ring[(i + 1) % ring.size()] - ring[i];
    constexpr int kSamples = 50;
    for (int k = 0; k < kSamples; ++k) {
      const double t = (k + 0.5) / kSamples;
      all += way.norm();
      near += distance_to_border(other, ring[i] + t * way) <= 0.05 ? way.norm() : 0;
    }
  }
  return all > 0 ? near / all : 0;
}

}  // namespace

std::string accuracy_table(const std::vector<RoomObservation>& rooms, const FloorTruth& truth) {
  std::string text =
      "room      type       width m  error  sigma   depth m  error  sigma  height m  error  walls found  "
      "false walls\n";
  char line[200];
  std::vector<double> errors, heights;
  int inside = 0, false_walls = 0, seen = 0;
  double least_found = 1;
  for (const TrueRoom& room : truth.rooms) {
    const auto found =
        std::find_if(rooms.begin(), rooms.end(), [&](const RoomObservation& o) { return o.room == room.id; });
    if (found == rooms.end()) {
      std::snprintf(line, sizeof line, "%-9s %-10s not perceived\n", room.id.c_str(), room.type.c_str());
      text += line;
      continue;
    }
    ++seen;
    // True extents along the room's own main direction, as the observation measures them.
    Vec2 axis = Vec2::UnitX();
    double longest = 0;
    for (std::size_t i = 0; i < room.outline.size(); ++i) {
      const Vec2 way = room.outline[(i + 1) % room.outline.size()] - room.outline[i];
      if (way.norm() > longest + 1e-9) {
        longest = way.norm();
        axis = way.normalized();
      }
    }
    if (std::abs(axis.y()) > std::abs(axis.x())) axis = Vec2(axis.y(), -axis.x());
    const auto extent = [&](const Vec2& along) {
      double low = 1e300, high = -1e300;
      for (const Vec2& corner : room.outline) {
        low = std::min(low, along.dot(corner));
        high = std::max(high, along.dot(corner));
      }
      return high - low;
    };
    const double width = extent(axis), depth = extent(Vec2(-axis.y(), axis.x())),
                 height = room.ceiling_m - room.floor_m;
    Measured w = found->width, d = found->depth;
    if (std::abs(w.value_m - depth) + std::abs(d.value_m - width) <
        std::abs(w.value_m - width) + std::abs(d.value_m - depth))
      std::swap(w, d);  // a frame of its own: which side is the width is not known
    const Polygon laid = laid_on(found->outline, room.outline);
    const double walls = near_share(room.outline, laid);
    int wrong = 0;
    for (std::size_t i = 0; i < laid.size(); ++i) {
      const Vec2 middle = (laid[i] + laid[(i + 1) % laid.size()]) / 2;
      wrong += distance_to_border(room.outline, middle) > 0.05;
    }
    const double errors_here[] = {w.value_m - width, d.value_m - depth};
    std::snprintf(line, sizeof line,
                  "%-9s %-10s %7.3f %6.1f %6.1f   %7.3f %6.1f %6.1f   %7.3f %6.1f  %9.1f %%  %11d\n",
                  room.id.c_str(), room.type.c_str(), width, 1e3 * errors_here[0], 1e3 * w.sigma_m, depth,
                  1e3 * errors_here[1], 1e3 * d.sigma_m, height, 1e3 * (found->height.value_m - height),
                  100 * walls, wrong);
    text += line;
    inside += std::abs(errors_here[0]) <= 2 * w.sigma_m;
    inside += std::abs(errors_here[1]) <= 2 * d.sigma_m;
    errors.push_back(std::abs(errors_here[0]));
    errors.push_back(std::abs(errors_here[1]));
    heights.push_back(std::abs(found->height.value_m - height));
    false_walls += wrong;
    least_found = std::min(least_found, walls);
  }
  if (errors.empty()) return text;
  const auto mean = [](const std::vector<double>& list) {
    double sum = 0;
    for (const double value : list) sum += value;
    return sum / static_cast<double>(list.size());
  };
  const auto within = std::count_if(errors.begin(), errors.end(), [](double error) { return error <= 0.02; });
  std::snprintf(line, sizeof line,
                "%d of %zu rooms; width and depth: mean error %.1f mm, largest %.1f mm, %.1f %% within 20 "
                "mm, %.1f %% within 2 sigma; "
                "height: mean error %.1f mm\n",
                seen, truth.rooms.size(), 1e3 * mean(errors),
                1e3 * *std::max_element(errors.begin(), errors.end()),
                100.0 * static_cast<double>(within) / static_cast<double>(errors.size()),
                100.0 * inside / static_cast<double>(errors.size()), 1e3 * mean(heights));
  text += line;
  std::snprintf(line, sizeof line, "walls found: at least %.1f %% of every room's; false walls: %d\n",
                100 * least_found, false_walls);
  return text + line;
}

std::string things_table(const std::vector<std::string>& scanned, const std::vector<RoomObservation>& rooms,
                         const FloorTruth& truth, bool mistakes) {
  Scores scores;
  for (const BuildingRoom& room : building_of(truth).rooms) {
    if (std::find(scanned.begin(), scanned.end(), room.id) == scanned.end()) continue;
    const auto found =
        std::find_if(rooms.begin(), rooms.end(), [&](const RoomObservation& o) { return o.room == room.id; });
    const RoomObservation seen = found == rooms.end() ? RoomObservation{} : *found;
    const BuildingRoom there = found == rooms.end() ? room : aligned_truth(room, seen);
    Scores here = score_furniture(seen.furniture, there);
    for (const char* kind : {"door", "window"})
      here[kind] = score_openings(seen.openings, true_openings(there, seen), kind);
    for (auto& [kind, score] : here) {
      for (std::string& mistake : score.mistakes) mistake.insert(0, "room " + room.id + ": ");
      scores[kind].add(score);
    }
  }
  return score_table("doors and windows (IoU on the wall at least 0.5), furniture (in the plan)", scores,
                     mistakes);
}

}  // namespace gramap
