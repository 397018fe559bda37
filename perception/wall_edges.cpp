#include "perception/wall_edges.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core/utility.hpp>
#include <opencv2/imgproc.hpp>

#include "perception/raster_cv.h"

namespace gramap {
namespace {

constexpr double kStraight_rad = 0.2;  // how far from upright or level an edge may lean
constexpr int kSobelStep = 60;         // of 255 grey values over the depth range

/// Where the depth jumps: Canny's edges, and Sobel's strong ones in the two directions that count.
cv::Mat edge_mask(const WallImage& wall) {
  cv::Mat grey, edges, across, up;
  matrix(wall.depth).convertTo(grey, CV_8U, 127 / kDepthLimit_m, 128);
  cv::medianBlur(grey, grey, 5);
  cv::Canny(grey, edges, 40, 120, 3);
  cv::Sobel(grey, across, CV_16S, 1, 0, 3, 0.25);
  cv::Sobel(grey, up, CV_16S, 0, 1, 3, 0.25);
  cv::Mat strong = (cv::abs(across) > kSobelStep) | (cv::abs(up) > kSobelStep);
  return edges | strong;
}

/// Edges at nearly the same place become one at their mean place, weighted by length, over all their extent.
std::vector<EdgeLine> merged(std::vector<EdgeLine> lines, double merge_px, int most) {
  std::sort(lines.begin(), lines.end(), [](const EdgeLine& a, const EdgeLine& b) {
    return std::tie(a.at, a.low, a.high) < std::tie(b.at, b.low, b.high);
  });
  struct Group {
    double weighted = 0, weight = 0;
    int first, low, high;
  };
  std::vector<Group> groups;
  for (const EdgeLine& line : lines) {
    const double length = line.high - line.low;
    if (groups.empty() || line.at - groups.back().first > merge_px)
      groups.push_back({0, 0, line.at, line.low, line.high});
    Group& group = groups.back();
    group.weighted += length * line.at, group.weight += length;
    group.low = std::min(group.low, line.low), group.high = std::max(group.high, line.high);
  }
  std::stable_sort(groups.begin(), groups.end(),
                   [](const Group& a, const Group& b) { return a.weight > b.weight; });
  if (static_cast<int>(groups.size()) > most) groups.resize(static_cast<std::size_t>(most));
  std::vector<EdgeLine> result;
  for (const Group& group : groups)
    result.push_back({static_cast<int>(std::lround(group.weighted / group.weight)), group.low, group.high});
  std::sort(result.begin(), result.end(), [](const EdgeLine& a, const EdgeLine& b) { return a.at < b.at; });
  return result;
}

void add_borders(std::vector<EdgeLine>& lines, int size, int extent, double merge_px) {
  std::erase_if(lines, [&](const EdgeLine& line) { return line.at < merge_px || line.at > size - merge_px; });
  lines.insert(lines.begin(), {0, 0, extent});
  lines.push_back({size, 0, extent});
}

}  // namespace

WallEdges wall_edges(const WallImage& wall, double merge_m, int most) {
  std::vector<cv::Vec4i> segments;
  const double least_px = 0.3 / wall.pixel_m;
  cv::theRNG().state = 1;  // the transform draws its points from the thread's generator
  cv::HoughLinesP(edge_mask(wall), segments, 1, 3.141592653589793 / 180, static_cast<int>(0.8 * least_px),
                  least_px, 0.15 / wall.pixel_m);
  WallEdges edges;
  for (const cv::Vec4i& s : segments) {
    const int across = std::abs(s[2] - s[0]), up = std::abs(s[3] - s[1]);
    if (across <= std::tan(kStraight_rad) * up)
      edges.upright.push_back({(s[0] + s[2] + 1) / 2, std::min(s[1], s[3]), std::max(s[1], s[3])});
    else if (up <= std::tan(kStraight_rad) * across)
      edges.level.push_back({(s[1] + s[3] + 1) / 2, std::min(s[0], s[2]), std::max(s[0], s[2])});
  }
  const double merge_px = merge_m / wall.pixel_m;
  edges.upright = merged(edges.upright, merge_px, most);
  edges.level = merged(edges.level, merge_px, most);
  add_borders(edges.upright, wall.label.columns, wall.label.rows, merge_px);
  add_borders(edges.level, wall.label.rows, wall.label.columns, merge_px);
  return edges;
}

}  // namespace gramap
