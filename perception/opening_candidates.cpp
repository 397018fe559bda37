#include "perception/opening_candidates.h"

#include <algorithm>
#include <cmath>

#include "perception/wall_edges.h"

namespace gramap {
namespace {

constexpr double kMargin_m = 0.1;  // of the wall around a candidate
constexpr double kStrip_m = 0.06;  // narrower piers do not part openings

/// Sums over rectangles of a raster in constant time.
class Integral {
 public:
  template <typename Value>
  Integral(int columns, int rows, Value value)
      : columns_(columns + 1), sums_(static_cast<std::size_t>((columns + 1) * (rows + 1))) {
    for (int row = 0; row < rows; ++row)
      for (int column = 0; column < columns; ++column)
        sums_[at(column + 1, row + 1)] = value(column, row) + sums_[at(column, row + 1)] +
                                         sums_[at(column + 1, row)] - sums_[at(column, row)];
  }
  double over(const PixelBox& b) const {
    return sums_[at(b.right, b.top)] - sums_[at(b.left, b.top)] - sums_[at(b.right, b.bottom)] +
           sums_[at(b.left, b.bottom)];
  }

 private:
  std::size_t at(int column, int row) const { return static_cast<std::size_t>(row * columns_ + column); }
  int columns_;
  std::vector<double> sums_;
};

struct WallSums {
  Integral occupied, empty, openness, beyond, offset_squares, offset_count;
};

WallSums sums_of(const WallImage& wall) {
  const int columns = wall.label.columns, rows = wall.label.rows;
  return {{columns, rows, [&](int c, int r) { return wall.label.at(c, r) == kOccupied ? 1.0 : 0.0; }},
          {columns, rows, [&](int c, int r) { return wall.label.at(c, r) == kEmpty ? 1.0 : 0.0; }},
          {columns, rows,
           [&](int c, int r) {
             const auto label = wall.label.at(c, r);
             return label == kEmpty ? 1.0 : label == kOccupied ? -1.0 : -0.5;
           }},
          {columns, rows, [&](int c, int r) { return static_cast<double>(wall.beyond.at(c, r)); }},
          {columns, rows, [&](int c, int r) { return static_cast<double>(wall.offset_squares.at(c, r)); }},
          {columns, rows, [&](int c, int r) { return static_cast<double>(wall.offset_count.at(c, r)); }}};
}

/// Moves each side by a few pixels to where the box holds most of what is not wall and least wall.
PixelBox fitted(PixelBox box, const WallImage& wall, const WallSums& sums, int reach) {
  const auto gain = [&](const PixelBox& b) { return b.area() - 2 * sums.occupied.over(b); };
  const auto move = [&](int PixelBox::*side, int low, int high) {
    PixelBox best = box;
    for (int at = std::max(low, box.*side - reach); at <= std::min(high, box.*side + reach); ++at) {
      PixelBox moved = box;
      moved.*side = at;
      if (gain(moved) > gain(best)) best = moved;
    }
    box = best;
  };
  for (int round = 0; round < 2; ++round) {
    move(&PixelBox::left, 0, box.right - 1);
    move(&PixelBox::right, box.left + 1, wall.label.columns);
    move(&PixelBox::bottom, 0, box.top - 1);
    move(&PixelBox::top, box.bottom + 1, wall.label.rows);
  }
  return box;
}

/// Two upright edges whose upper ends a level edge joins: the shape of a door.
std::vector<PixelBox> inverted_us(const WallEdges& edges, double tolerance_px) {
  std::vector<PixelBox> shapes;
  for (std::size_t i = 0; i < edges.upright.size(); ++i)
    for (std::size_t j = i + 1; j < edges.upright.size(); ++j)
      for (const EdgeLine& level : edges.level) {
        const EdgeLine &a = edges.upright[i], &b = edges.upright[j];
        if (std::abs(a.high - level.at) > tolerance_px || std::abs(b.high - level.at) > tolerance_px)
          continue;
        if (level.low > a.at + tolerance_px || level.high < b.at - tolerance_px) continue;
        shapes.push_back({a.at, std::max(a.low, b.low), b.at, level.at});
      }
  return shapes;
}

bool within(const PixelBox& inner, const PixelBox& outer, int slack) {
  return inner.left >= outer.left - slack && inner.right <= outer.right + slack &&
         inner.bottom >= outer.bottom - slack && inner.top <= outer.top + slack;
}

/// The share of a strip that is wall; the floor, the ceiling and other walls are where the image ends.
double wall_in(PixelBox strip, const WallImage& wall, const WallSums& sums) {
  const double all = strip.area();
  strip = {std::max(strip.left, 0), std::max(strip.bottom, 0), std::min(strip.right, wall.label.columns),
           std::min(strip.top, wall.label.rows)};
  if (strip.width() <= 0 || strip.height() <= 0) return 1;
  return (sums.occupied.over(strip) + all - strip.area()) / all;
}

/// Most of what was measured in the wall's direction lies behind it, and little of it is there: a beam, or
/// the frame of a wide passage. What is open below it is neither door nor window.
bool is_beam(const WallImage& wall, const WallSums& sums) {
  const PixelBox all{0, 0, wall.label.columns, wall.label.rows};
  return sums.beyond.over(all) > 0.5 * all.area() && sums.occupied.over(all) < 0.35 * all.area();
}

double wall_across(const PixelBox& box, const WallImage& wall, const WallSums& sums) {
  const int strip = std::max(1, static_cast<int>(kStrip_m / wall.pixel_m)), edge = 2 * strip;
  double most = 0;
  for (int at = box.left + edge; at + strip <= box.right - edge; ++at)
    most = std::max(most, wall_in({at, box.bottom, at + strip, box.top}, wall, sums));
  return most;
}

}  // namespace

const std::vector<std::string>& opening_feature_names() {
  static const std::vector<std::string> names = {"area",
                                                 "width/height",
                                                 "width/wall",
                                                 "height/wall",
                                                 "to top",
                                                 "to bottom",
                                                 "to left",
                                                 "to right",
                                                 "plane rms",
                                                 "empty share",
                                                 "occupied share",
                                                 "occluded share",
                                                 "interior boxes",
                                                 "inverted Us",
                                                 "seen beyond",
                                                 "wall beside",
                                                 "wall over and under",
                                                 "wall across"};
  return names;
}

double overlap(const PixelBox& a, const PixelBox& b) {
  const int width = std::min(a.right, b.right) - std::max(a.left, b.left);
  const int height = std::min(a.top, b.top) - std::max(a.bottom, b.bottom);
  if (width <= 0 || height <= 0) return 0;
  const double both = static_cast<double>(width) * height;
  return both / (a.area() + b.area() - both);
}

std::vector<OpeningCandidate> opening_candidates(const WallImage& wall, const CandidateOptions& options) {
  const WallEdges edges = wall_edges(wall, options.merge_m, options.most_lines);
  const WallSums sums = sums_of(wall);
  const double pixel = wall.pixel_m;
  std::vector<OpeningCandidate> candidates;
  if (is_beam(wall, sums)) return candidates;
  for (std::size_t i = 0; i < edges.upright.size(); ++i)
    for (std::size_t j = i + 1; j < edges.upright.size(); ++j) {
      const int width = edges.upright[j].at - edges.upright[i].at;
      if (width * pixel < options.least_side_m || width * pixel > options.most_width_m) continue;
      for (std::size_t k = 0; k < edges.level.size(); ++k)
        for (std::size_t l = k + 1; l < edges.level.size(); ++l) {
          PixelBox box{edges.upright[i].at, edges.level[k].at, edges.upright[j].at, edges.level[l].at};
          if (box.height() * pixel < options.least_side_m ||
              box.area() * pixel * pixel < options.least_area_m2)
            continue;
          if (sums.occupied.over(box) > (1 - options.not_wall_share) * box.area()) continue;
          if (sums.empty.over(box) < options.empty_share * box.area()) continue;
          box = fitted(box, wall, sums, static_cast<int>(options.merge_m / pixel) + 1);
          const bool known =
              std::any_of(candidates.begin(), candidates.end(),
                          [&](const OpeningCandidate& c) { return overlap(c.box, box) > 0.97; });
          if (!known) candidates.push_back({box, {}, sums.openness.over(box)});
        }
    }
  const std::vector<PixelBox> us = inverted_us(edges, 0.15 / pixel);
  const int margin = static_cast<int>(kMargin_m / pixel);
  for (OpeningCandidate& candidate : candidates) {
    const PixelBox& b = candidate.box;
    const double width = b.width() * pixel, height = b.height() * pixel;
    const double empty = sums.empty.over(b) / b.area(), occupied = sums.occupied.over(b) / b.area();
    const double near_points = sums.offset_count.over(b);
    const auto inside = [&](const PixelBox& other) { return within(other, b, 2); };
    const auto boxes = std::count_if(candidates.begin(), candidates.end(),
                                     [&](const OpeningCandidate& c) { return inside(c.box); }) -
                       1;
    const double features[kOpeningFeatures] = {
        width * height,
        width / height,
        width / wall.length_m,
        height / wall.height_m,
        (wall.label.rows - b.top) * pixel,
        b.bottom * pixel,
        b.left * pixel,
        (wall.label.columns - b.right) * pixel,
        near_points > 0 ? std::sqrt(sums.offset_squares.over(b) / near_points) : 0.0,
        empty,
        occupied,
        1 - empty - occupied,
        static_cast<double>(boxes),
        static_cast<double>(std::count_if(us.begin(), us.end(), inside)),
        std::min(sums.beyond.over(b) / b.area(), 2.0),
        std::min(wall_in({b.left - margin, b.bottom, b.left, b.top}, wall, sums),
                 wall_in({b.right, b.bottom, b.right + margin, b.top}, wall, sums)),
        std::min(wall_in({b.left, b.bottom - margin, b.right, b.bottom}, wall, sums),
                 wall_in({b.left, b.top, b.right, b.top + margin}, wall, sums)),
        wall_across(b, wall, sums)};
    std::transform(std::begin(features), std::end(features), candidate.features.begin(),
                   [](double value) { return static_cast<float>(value); });
  }
  return candidates;
}

}  // namespace gramap
