// A local projection for floors given in WGS84: equirectangular about the floor's centre, with the
// ellipsoid's two radii of curvature there. Over a building of 500 m its error stays below a centimetre.
#pragma once

#include "geometry/types.h"

namespace gramap {

/// The point of the ellipsoid that plan coordinates count from, degrees.
struct GeoOrigin {
  double longitude_deg = 0;
  double latitude_deg = 0;
};

/// Plan metres east and north of the origin.
Vec2 plan_from_wgs84(const GeoOrigin& origin, double longitude_deg, double latitude_deg);

/// The inverse: (longitude, latitude) in degrees.
Vec2 wgs84_from_plan(const GeoOrigin& origin, const Vec2& plan);

}  // namespace gramap
