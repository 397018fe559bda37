#include "floor/projection.h"

#include <cmath>
#include <numbers>

namespace gramap {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

/// Metres per degree of longitude and of latitude: N·cos φ and M, the radii of curvature in the prime
/// vertical and in the meridian (Snyder, Map Projections: A Working Manual, eq. 4-18 to 4-20).
Vec2 metres_per_degree(double latitude_deg) {
  constexpr double a = 6378137.0, f = 1 / 298.257223563, e2 = f * (2 - f);  // WGS84
  const double sine = std::sin(latitude_deg * kDegree), w = 1 - e2 * sine * sine;
  const double prime_vertical = a / std::sqrt(w), meridian = a * (1 - e2) / (w * std::sqrt(w));
  return Vec2(prime_vertical * std::cos(latitude_deg * kDegree), meridian) * kDegree;
}

}  // namespace

Vec2 plan_from_wgs84(const GeoOrigin& origin, double longitude_deg, double latitude_deg) {
  // The short way round, also across the 180th meridian.
  return Vec2(std::remainder(longitude_deg - origin.longitude_deg, 360), latitude_deg - origin.latitude_deg)
      .cwiseProduct(metres_per_degree(origin.latitude_deg));
}

Vec2 wgs84_from_plan(const GeoOrigin& origin, const Vec2& plan) {
  Vec2 degrees = Vec2(origin.longitude_deg, origin.latitude_deg) +
                 plan.cwiseQuotient(metres_per_degree(origin.latitude_deg));
  if (std::abs(degrees.x()) > 180) degrees.x() = std::remainder(degrees.x(), 360);
  return degrees;
}

}  // namespace gramap
