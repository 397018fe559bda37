// Planes of a point cloud by the 3D Randomized Hough Transform.
//
// A plane in Hesse normal form, n·p = ρ, is a cell of an accumulator over the normal's direction and ρ. The
// ball accumulator gives every latitude as many cells as keeps them nearly equal in area (Borrmann, Elseberg,
// Lingemann, Nüchter: The 3D Hough Transform for plane detection in point clouds, 3D Research 2(2), 2011).
// Random triples of neighbouring points vote for one cell each; a cell that gets enough votes is a plane to
// try: points near it are gathered and fitted by trimmed least squares, split into connected patches, and the
// largest patch is a plane if it stands out from its surroundings. Its points are taken out, the votes
// cleared, and the drawing goes on.
//
// All of that happens on a sample of at most `sample` points, so its cost does not grow with the cloud; one
// last pass over all points gives each plane its exact fit and support.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "perception/scan.h"

namespace gramap {

struct HoughOptions {
  int sample = 20000;  ///< points that take part in the voting
  double min_pair_m =
      0.15;  ///< the second and third point of a triple lie at least this far from the first …
  double max_pair_m = 1.0;       ///< … and at most this far
  double angle_cell_rad = 0.05;  ///< the accumulator's step in the normal's direction
  double rho_cell_m = 0.06;      ///< the accumulator's step in the distance from the origin
  int votes = 12;                ///< votes that make a cell a candidate
  double max_distance_m = 0.07;  ///< points farther from a plane are never its own
  double patch_cell_m = 0.2;     ///< cell of the raster on the plane whose connected parts are the patches
  double min_area_m2 = 0.15;     ///< smaller patches are no planes
  int min_support = 25;          ///< sample points a plane has at least
  int max_planes = 80;
  int max_trials = 20000;  ///< triples drawn since the last plane before giving up
  int max_refusals = 40;   ///< candidates refused since the last plane before giving up
  std::uint64_t seed = 1;
};

/// A connected planar piece of the cloud: all p with normal · p = rho_m whose place on the raster is
/// occupied.
struct PlanePatch {
  Vec3 normal = Vec3::UnitZ();  ///< unit vector
  double rho_m = 0;
  double rms_m = 0;            ///< of the points' distances from the plane
  double band_m = 0;           ///< points up to this far from it were taken as its own
  std::size_t support = 0;     ///< points of the whole cloud on the patch
  double area_m2 = 0;          ///< of the occupied cells
  Vec3 corner = Vec3::Zero();  ///< the raster's corner, on the plane
  Vec3 u = Vec3::UnitX();      ///< unit vectors along the raster's columns and rows
  Vec3 v = Vec3::UnitY();
  double cell_m = 0;
  int columns = 0, rows = 0;
  std::vector<std::uint8_t> occupied;  ///< columns × rows, row by row

  double distance(const Vec3& point) const { return normal.dot(point) - rho_m; }
  /// True when the point's foot lies on an occupied cell.
  bool covers(const Vec3& point) const;
};

/// The planes, in the order of their support. Same points, options and seed: same planes.
std::vector<PlanePatch> detect_planes(std::span<const Point> points, const HoughOptions& options = {});

}  // namespace gramap
