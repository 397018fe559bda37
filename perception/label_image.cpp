#include "perception/label_image.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "perception/coverage.h"
#include "perception/occupancy.h"
#include "perception/raster_cv.h"

namespace gramap {
namespace {

constexpr double kRecess_m = 0.22;  // points up to here behind the wall may be a leaf, a frame, a blind
constexpr double kBeside_m =
    0.3;  // what a slanting ray meets at the plane but farther off than this is in its way
constexpr double kDensityCell_m = 0.2;

int cells(double length, double cell) {
  return std::max(1, static_cast<int>(std::lround(length / cell)));
}

WallImage blank(const RoomObservation& room, std::size_t index, const Vec3& origin, double pixel_m) {
  const WallObservation& wall = room.walls[index];
  WallImage image;
  image.a = wall.a - origin.head<2>();
  image.length_m = (wall.b - wall.a).norm();
  image.along = (wall.b - wall.a) / std::max(image.length_m, 1e-9);
  image.outward = {image.along.y(), -image.along.x()};
  image.floor_z_m = room.floor_z_m - origin.z();
  image.height_m = room.ceiling_z_m - room.floor_z_m;
  image.pixel_m = pixel_m;
  const int rows = cells(image.height_m, pixel_m), columns = cells(image.length_m, pixel_m);
  image.label = {columns, rows, kOccluded};
  image.depth = {columns, rows, static_cast<float>(-kDepthLimit_m)};
  image.beyond = image.offset_sum = image.offset_squares = image.offset_count = {columns, rows};
  return image;
}

/// A wall's points: within `band_m` of it, and in its recesses.
struct Splats {
  Raster<std::uint8_t> wall, recess;
  double band_m = 0;
};

Splats splat(WallImage& image, const RegisteredCloud& cloud, std::size_t points, double band_m) {
  const int columns = image.label.columns, rows = image.label.rows;
  Splats splats{{columns, rows}, {columns, rows}, band_m};
  const Eigen::Vector2f a = image.a.cast<float>(), along = image.along.cast<float>(),
                        out = image.outward.cast<float>();
  const auto floor_z = static_cast<float>(image.floor_z_m), per_pixel = static_cast<float>(1 / image.pixel_m);
  for (std::size_t i = 0; i < points; ++i) {
    const Eigen::Vector2f from_a = cloud.points_m[i].head<2>() - a;
    const float across = out.dot(from_a);
    if (across < -band_m || across > kRecess_m) continue;
    const int column = static_cast<int>(std::floor(along.dot(from_a) * per_pixel));
    const int row = static_cast<int>(std::floor((cloud.points_m[i].z() - floor_z) * per_pixel));
    if (column < 0 || row < 0 || column >= columns || row >= rows) continue;
    (across <= band_m ? splats.wall : splats.recess).at(column, row) = 255;
    if (across > band_m) continue;
    image.offset_sum.at(column, row) += across;
    image.offset_squares.at(column, row) += across * across;
    image.offset_count.at(column, row) += 1;
  }
  return splats;
}

/// Points per m² where they are thin: the lower quartile over the patches that hold any. `counts` is per
/// cell.
double density_of(const cv::Mat& counts, double column_m, double row_m) {
  cv::Mat means;
  cv::resize(counts, means,
             {cells(counts.cols * column_m, kDensityCell_m), cells(counts.rows * row_m, kDensityCell_m)}, 0,
             0, cv::INTER_AREA);
  std::vector<float> held;
  for (int row = 0; row < means.rows; ++row)
    for (int column = 0; column < means.cols; ++column)
      if (means.at<float>(row, column) > 0) held.push_back(means.at<float>(row, column));
  if (held.empty()) return 1;
  const auto quartile = held.begin() + static_cast<std::ptrdiff_t>(held.size() / 4);
  std::nth_element(held.begin(), quartile, held.end());
  return *quartile / (column_m * row_m);
}

/// Closes gaps up to two point spacings wide, in which at random hardly ever no point lies.
cv::Mat closed(const cv::Mat& mask, double spacing_m, double pixel_m) {
  const int radius = std::clamp(static_cast<int>(std::ceil(2 * spacing_m / pixel_m)), 1, 12);
  const cv::Mat disk = cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * radius + 1, 2 * radius + 1});
  cv::Mat padded, result;  // the wall goes on beyond the image: borders must not erode
  cv::copyMakeBorder(mask, padded, radius, radius, radius, radius, cv::BORDER_REPLICATE);
  cv::morphologyEx(padded, result, cv::MORPH_CLOSE, disk);
  return result(cv::Rect(radius, radius, mask.cols, mask.rows)).clone();
}

/// Signed distance behind the wall's plane of the first thing that a ray to a patch meets; what is at the
/// plane itself does not count (the splats say what is there).
double depth_behind(const WallImage& image, const BitGrid& grid, const Vec3& scanner, const Vec3& patch,
                    double at_plane_m) {
  const Vec3 offset = patch - scanner;
  const double distance = offset.norm();
  const Vec3 direction = offset / distance;
  const double approach = image.outward.dot(direction.head<2>());
  if (approach < 0.02) return -kDepthLimit_m;
  double depth = kDepthLimit_m;
  walk_ray(grid, scanner, direction, distance + kDepthLimit_m / approach, [&](double entered) {
    const double across = (entered + 0.5 * grid.voxel_m() - distance) * approach;
    const bool beside = (distance - entered) * std::sqrt(1 - approach * approach) <= kBeside_m;
    if (std::abs(across) <= at_plane_m && beside) return false;
    if (entered < 0.3) return false;  // the person and the sensor itself
    depth = std::clamp(across, -kDepthLimit_m, kDepthLimit_m);
    return true;
  });
  return depth;
}

/// How many points are seen towards each patch, and how many of them well behind the wall.
struct Returns {
  cv::Mat all, beyond;
  explicit Returns(const cv::Size& size)
      : all(cv::Mat::zeros(size, CV_32F)), beyond(cv::Mat::zeros(size, CV_32F)) {}
};

/// Patches that one position measured something in front of: its points that stand off the wall, seen in the
/// wall's plane from the scanner. Tells where a thin cloud would let rays leak through what stands there.
/// Adds the position's points to `returns`.
cv::Mat hidden_patches(const WallImage& image, std::span<const Point> points, const Vec3& scanner,
                       double at_plane_m, Returns& returns) {
  const cv::Size size = returns.all.size();
  cv::Mat counts = cv::Mat::zeros(size, CV_32F), front = cv::Mat::zeros(size, CV_8U);
  const double scanner_across =
      image.outward.dot(scanner.head<2>() - image.a);  // negative: inside of the room
  const double column_m = image.length_m / size.width, row_m = image.height_m / size.height;
  for (const Point& point : points) {
    const Vec3 ray = point.cast<double>() - scanner;
    const double approach = image.outward.dot(ray.head<2>());
    if (approach <= 0.02 * ray.norm()) continue;
    const Vec3 crossing = scanner - scanner_across / approach * ray;
    const int column = static_cast<int>(std::floor(image.along.dot(crossing.head<2>() - image.a) / column_m));
    const int row = static_cast<int>(std::floor((crossing.z() - image.floor_z_m) / row_m));
    if (column < 0 || row < 0 || column >= size.width || row >= size.height) continue;
    counts.at<float>(row, column) += 1;
    const double across = scanner_across + approach;
    if (across > kDepthLimit_m) returns.beyond.at<float>(row, column) += 1;
    const bool beside = (crossing - point.cast<double>()).head<2>().norm() <= kBeside_m;
    if (across < (beside ? -at_plane_m : -0.5 * at_plane_m)) front.at<std::uint8_t>(row, column) = 255;
  }
  returns.all += counts;
  const double spacing_m = 1 / std::sqrt(density_of(counts, column_m, row_m));
  return closed(front, spacing_m, std::min(column_m, row_m));
}

/// The greatest depth that any position sees at each patch; fills the image's `beyond`.
cv::Mat traced_depth(WallImage& image, const BitGrid& grid, const RegisteredCloud& cloud,
                     const std::vector<ScannerCoverage>& coverages, double at_plane_m,
                     const LabelOptions& options) {
  cv::Mat depth(cells(image.height_m, options.trace_m), cells(image.length_m, options.trace_m), CV_32F,
                cv::Scalar(-kDepthLimit_m));
  const double across_m = image.length_m / depth.cols, up_m = image.height_m / depth.rows;
  Returns returns(depth.size());
  for (std::size_t i = 0; i < coverages.size(); ++i) {
    const RegisteredCloud::Part& part = cloud.parts[i];
    const auto points = std::span(cloud.points_m).subspan(part.begin, part.end - part.begin);
    const cv::Mat hidden = hidden_patches(image, points, part.scanner_m, at_plane_m, returns);
    for (int row = 0; row < depth.rows; ++row)
      for (int column = 0; column < depth.cols; ++column) {
        auto& best = depth.at<float>(row, column);
        if (best >= kDepthLimit_m || hidden.at<std::uint8_t>(row, column) != 0) continue;
        const Vec2 plan = image.a + (column + 0.5) * across_m * image.along;
        const Vec3 patch(plan.x(), plan.y(), image.floor_z_m + (row + 0.5) * up_m);
        if (coverages[i].covers(patch - part.scanner_m))
          best = std::max(best,
                          static_cast<float>(depth_behind(image, grid, part.scanner_m, patch, at_plane_m)));
      }
  }
  const double mean = std::max(cv::mean(returns.all)[0], 1e-9);
  cv::Mat beyond = matrix(image.beyond);
  cv::resize(returns.beyond / mean, beyond, beyond.size(), 0, 0, cv::INTER_NEAREST);
  return depth;
}

/// Mean offset of the wall's points, smoothed over a few point spacings.
cv::Mat mean_offset(const WallImage& image, double spacing_m) {
  const int side = 2 * std::clamp(static_cast<int>(std::ceil(2 * spacing_m / image.pixel_m)), 1, 12) + 1;
  cv::Mat sum, count;
  cv::boxFilter(matrix(image.offset_sum), sum, CV_32F, {side, side}, {-1, -1}, false);
  cv::boxFilter(matrix(image.offset_count), count, CV_32F, {side, side}, {-1, -1}, false);
  return sum / cv::max(count, 1);
}

void label(WallImage& image, const Splats& splats, const cv::Mat& traced, double spacing_m, double beyond_m) {
  const cv::Mat wall = closed(matrix(splats.wall), spacing_m, image.pixel_m);
  const cv::Mat recess = closed(matrix(splats.recess), spacing_m, image.pixel_m);
  const cv::Mat offset = mean_offset(image, spacing_m);
  cv::Mat depth;
  cv::medianBlur(traced, depth, 3);
  cv::resize(depth, depth, {image.label.columns, image.label.rows}, 0, 0, cv::INTER_NEAREST);
  for (int row = 0; row < image.label.rows; ++row)
    for (int column = 0; column < image.label.columns; ++column) {
      auto& at = image.label.at(column, row);
      auto& behind = image.depth.at(column, row);
      behind = depth.at<float>(row, column);
      if (wall.at<std::uint8_t>(row, column) != 0) {
        at = kOccupied;
        behind = offset.at<float>(row, column);
      } else if (recess.at<std::uint8_t>(row, column) != 0) {
        at = kOccluded;
        behind = std::min(behind, static_cast<float>(0.5 * kRecess_m));
      } else if (behind > beyond_m) {
        at = kEmpty;
      }
    }
}

/// Every so-manieth point: of a room's walls more than this shows no more openings.
constexpr std::size_t kEnoughPoints = 400000;

RegisteredCloud thinned(const RegisteredCloud& cloud) {
  const std::size_t step = cloud.points_m.size() / kEnoughPoints + 1;
  RegisteredCloud thin;
  thin.origin_m = cloud.origin_m;
  for (RegisteredCloud::Part part : cloud.parts) {
    const std::size_t begin = thin.points_m.size();
    for (std::size_t i = part.begin; i < part.end; i += step) thin.points_m.push_back(cloud.points_m[i]);
    part.begin = begin, part.end = thin.points_m.size();
    thin.parts.push_back(part);
  }
  return thin;
}

}  // namespace

std::vector<WallImage> label_images(const RegisteredCloud& cloud, const RoomObservation& room,
                                    const LabelOptions& options) {
  if (cloud.points_m.size() > kEnoughPoints && !cloud.parts.empty())
    return label_images(thinned(cloud), room, options);
  std::vector<ScannerCoverage> coverages;
  std::size_t points = 0;
  for (const RegisteredCloud::Part& part : cloud.parts) {
    if (options.positions > 0 && static_cast<int>(coverages.size()) == options.positions) break;
    coverages.emplace_back(part.scanner_m,
                           std::span(cloud.points_m).subspan(part.begin, part.end - part.begin));
    points = std::max(points, part.end);
  }
  std::vector<WallImage> images;
  std::vector<Splats> splats;
  std::vector<double> spacings;
  double widest_m = 0;
  Vec3 low = Vec3::Constant(1e9), high = Vec3::Constant(-1e9);
  for (std::size_t i = 0; i < room.walls.size(); ++i) {
    images.push_back(blank(room, i, cloud.origin_m, options.pixel_m));
    WallImage& image = images.back();
    splats.push_back(splat(image, cloud, points, std::clamp(3 * room.walls[i].plane_rms_m, 0.04, 0.08)));
    spacings.push_back(1 /
                       std::sqrt(density_of(matrix(image.offset_count), options.pixel_m, options.pixel_m)));
    widest_m = std::max(widest_m, spacings.back());
    low = low.cwiseMin(Vec3(image.a.x(), image.a.y(), image.floor_z_m));
    high = high.cwiseMax(Vec3(image.a.x(), image.a.y(), image.floor_z_m + image.height_m));
  }
  if (images.empty()) return images;
  // Voxels hold about four points of a surface, so that rays do not leak through it.
  const double voxel_m = std::clamp(2 * widest_m, options.least_voxel_m, options.most_voxel_m);
  const Vec3 margin(kDepthLimit_m + 0.1, kDepthLimit_m + 0.1, 0.1);
  const BitGrid grid =
      occupied_voxels(std::span(cloud.points_m).first(points), low - margin, high + margin, voxel_m);
  for (std::size_t i = 0; i < images.size(); ++i) {
    const double at_plane_m = splats[i].band_m + 0.6 * voxel_m;
    const cv::Mat traced = traced_depth(images[i], grid, cloud, coverages, at_plane_m, options);
    label(images[i], splats[i], traced, spacings[i], std::max(options.beyond_m, at_plane_m + 0.05));
  }
  return images;
}

}  // namespace gramap
