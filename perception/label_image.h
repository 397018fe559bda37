// What every patch of a wall looks like from all scanner positions: a label image and a depth image.
//
// After Adan and Huber, "3D reconstruction of interior wall surfaces under occlusion and clutter", 3DIMPVT
// 2011.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "perception/observation.h"
#include "perception/raster.h"
#include "perception/scan.h"

namespace gramap {

enum Label : std::uint8_t {
  kOccluded,  ///< no position saw the patch, or something stands at it that is not the wall
  kOccupied,  ///< points were measured on the wall here
  kEmpty,     ///< a ray passed through the wall's plane here and well beyond
};

/// Rasters over a wall: columns from the wall's corner `a` to `b`, rows from the floor up. `label` holds
/// Label values, `depth` the signed distance in metres behind the wall's plane of what is seen there,
/// negative in front, cut off at ± kDepthLimit_m. `beyond`: points seen through the wall at least that far
/// behind it, as a multiple of what is seen per patch over the whole wall: other rooms return rays, the
/// outdoors hardly any. The last three are sums over the points near the wall of their distances from its
/// plane.
struct WallImage {
  Vec2 a = Vec2::Zero();         ///< corner in the cloud's frame (relative to its origin)
  Vec2 along = Vec2::UnitX();    ///< unit vector
  Vec2 outward = Vec2::UnitY();  ///< unit vector, out of the room
  double floor_z_m = 0;
  double length_m = 0, height_m = 0;
  double pixel_m = 0.02;
  Raster<std::uint8_t> label;
  Raster<float> depth, beyond, offset_sum, offset_squares, offset_count;
};

inline constexpr double kDepthLimit_m = 0.6;

struct LabelOptions {
  double pixel_m = 0.02;
  double trace_m = 0.04;  ///< rays go to every patch of this size
  double least_voxel_m = 0.02;
  double most_voxel_m = 0.12;
  double beyond_m = 0.22;  ///< d + d′: what passes this far behind the wall has passed through an opening
  int positions = 0;       ///< use only the first so many scanner positions; 0: all
};

/// One image for each wall of the observation.
std::vector<WallImage> label_images(const RegisteredCloud& cloud, const RoomObservation& room,
                                    const LabelOptions& options = {});

/// The two images one above the other as RGB pixels, top row first: labels (occupied grey, empty white,
/// occluded red) above depth (near dark, far bright).
struct Picture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
};
Picture wall_picture(const WallImage& wall);

/// Draws the border of an opening over both images of its wall's picture.
void frame_opening(Picture& picture, const WallImage& wall, const OpeningObservation& opening,
                   const std::array<std::uint8_t, 3>& rgb);

}  // namespace gramap
