// Rectangles on a wall that may be doors or windows, and the features that a forest judges them by.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "perception/label_image.h"

namespace gramap {

inline constexpr std::size_t kOpeningFeatures = 18;

/// The features' names in their order, for tables and model files: the 14 of Adan and Huber (2011); how much
/// is measured behind the opening, by which doors to other rooms differ from windows down to the floor; what
/// share of the strips beside the box is wall (the lesser one: a part of an opening has more of it on one
/// side), and of those above and below; and the most that any upright strip inside the box is wall: the pier
/// between two windows.
const std::vector<std::string>& opening_feature_names();

/// A rectangle in pixels of its wall's image; `right` and `top` are one past the last.
struct PixelBox {
  int left = 0, bottom = 0, right = 0, top = 0;
  int width() const { return right - left; }
  int height() const { return top - bottom; }
  double area() const { return static_cast<double>(width()) * height(); }
};

/// Intersection over union of two boxes.
double overlap(const PixelBox& a, const PixelBox& b);

struct OpeningCandidate {
  PixelBox box;
  std::array<float, kOpeningFeatures> features{};
  /// Empty patches less the occupied and, at half weight, the occluded ones, in pixels: what the best of a
  /// cluster has most of.
  double openness = 0;
};

struct CandidateOptions {
  double least_side_m = 0.35;
  double most_width_m = 4.5;
  double least_area_m2 = 0.2;
  double not_wall_share = 0.67;  ///< of a candidate's patches at least so many are not wall
  double empty_share = 0.35;     ///< and at least so many were seen through
  double merge_m = 0.06;         ///< nearer lines are one
  int most_lines = 60;           ///< of each direction on a wall; the longest are kept
};

/// All rectangles of two vertical and two horizontal lines of the wall's image (its borders count) that are
/// not mostly wall, fitted to the labels; none on what is a beam rather than a wall. Lines: Canny and Sobel
/// on the depth image, probabilistic Hough transform.
std::vector<OpeningCandidate> opening_candidates(const WallImage& wall, const CandidateOptions& options = {});

}  // namespace gramap
