#include <algorithm>
#include <cmath>

#include "perception/label_image.h"

namespace gramap {
namespace {

constexpr int kGap_px = 4;  // between the two images

}  // namespace

Picture wall_picture(const WallImage& wall) {
  const int columns = wall.label.columns, rows = wall.label.rows;
  Picture picture{columns, 2 * rows + kGap_px, {}};
  picture.rgb.assign(static_cast<std::size_t>(3 * picture.width * picture.height), 255);
  const auto paint = [&](int column, int row, int red, int green, int blue) {
    const auto at = static_cast<std::size_t>(3 * (row * columns + column));
    picture.rgb[at] = static_cast<std::uint8_t>(red);
    picture.rgb[at + 1] = static_cast<std::uint8_t>(green);
    picture.rgb[at + 2] = static_cast<std::uint8_t>(blue);
  };
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const std::uint8_t label = wall.label.at(column, row);
      const int top = rows - 1 - row;
      if (label == kOccupied) paint(column, top, 130, 130, 130);
      if (label == kOccluded) paint(column, top, 200, 60, 60);
      const double share = 0.5 + 0.5 * wall.depth.at(column, row) / kDepthLimit_m;
      const int grey = std::clamp(static_cast<int>(std::lround(255 * share)), 0, 255);
      paint(column, rows + kGap_px + top, grey, grey, grey);
    }
  return picture;
}

void frame_opening(Picture& picture, const WallImage& wall, const OpeningObservation& opening,
                   const std::array<std::uint8_t, 3>& rgb) {
  const int columns = wall.label.columns, rows = wall.label.rows;
  const auto px = [&](double m, int last) {
    return std::clamp(static_cast<int>(std::lround(m / wall.pixel_m)), 0, last);
  };
  const int left = px(opening.start_m, columns - 1),
            right = px(opening.start_m + opening.width_m, columns - 1), bottom = px(opening.sill_m, rows - 1),
            top = px(opening.head_m, rows - 1);
  const auto paint = [&](int column, int row) {
    for (const int first : {0, rows + kGap_px}) {
      const auto at = static_cast<std::size_t>(3 * ((first + rows - 1 - row) * picture.width + column));
      std::copy(rgb.begin(), rgb.end(), picture.rgb.begin() + static_cast<std::ptrdiff_t>(at));
    }
  };
  for (int column = left; column <= right; ++column) paint(column, bottom), paint(column, top);
  for (int row = bottom; row <= top; ++row) paint(left, row), paint(right, row);
}

}  // namespace gramap
