#include "floor/geojson_plan.h"

#include <algorithm>
#include <cmath>

#include "geometry/error.h"

namespace gramap {
namespace {

[[noreturn]] void fail(const GeoFile& file, const std::string& message, const std::string& advice) {
  throw InputError({file.path}, message, advice);
}

struct Extent {
  Vec2 least = Vec2::Constant(1e300), most = Vec2::Constant(-1e300);
  bool empty() const { return least.x() > most.x(); }
};

Extent extent_of(const GeoFile& file) {
  Extent extent;
  for (const GeoFeature& feature : file.features)
    for (const auto& part : feature.parts)
      for (const Polygon& ring : part)
        for (const Vec2& point : ring)
          extent.least = extent.least.cwiseMin(point), extent.most = extent.most.cwiseMax(point);
  return extent;
}

constexpr double kFarthest_m = 1e8;  ///< from the origin: no map projection of the Earth goes farther
constexpr double kWidest_m = 5000;   ///< a floor of a building
constexpr double kWidest_deg = 0.2;  ///< the same, with room to spare towards the poles
constexpr double kNearPole_deg = 89;

void check_metres(const GeoFile& file, const Extent& extent) {
  if (extent.empty()) return;
  const Vec2 size = extent.most - extent.least,
             far = extent.least.cwiseAbs().cwiseMax(extent.most.cwiseAbs());
  const bool in_range = far.x() <= 180 && far.y() <= 90;
  // A single pin has no size and may stand anywhere.
  if (in_range && size.maxCoeff() > 0 && size.maxCoeff() < 0.5)
    fail(file, "the file says metres, but all of it lies within half a metre: these look like degrees",
         "leave \"coordinate_units\" out when the coordinates are WGS84 longitude and latitude");
  if (far.maxCoeff() > kFarthest_m)
    fail(file, "a coordinate is more than 100,000 km from the origin, farther than any map reaches",
         "give coordinates in metres about an origin near the building, or WGS84 without "
         "\"coordinate_units\"");
  if (size.maxCoeff() > kWidest_m)
    fail(file, "the floor is more than 5 km wide: these do not look like metres",
         "give coordinates in metres, or WGS84 without \"coordinate_units\"");
}

void check_degrees(const GeoFile& file, const Extent& extent) {
  if (extent.empty()) return;
  const Vec2 size = extent.most - extent.least,
             far = extent.least.cwiseAbs().cwiseMax(extent.most.cwiseAbs());
  if (far.y() > kNearPole_deg && far.y() <= 90 && size.y() < kWidest_deg)
    fail(file, "the floor lies within a degree of a pole, where longitudes make no plan",
         "give the coordinates in local metres, with \"coordinate_units\": \"m\"");
  // Beyond the 180th meridian longitudes are counted on, see across_180th_meridian.
  if (far.x() > 180 + kWidest_deg || far.y() > 90 || size.maxCoeff() > kWidest_deg)
    fail(file,
         "these do not look like longitude and latitude, which a file without \"coordinate_units\" holds",
         "add \"coordinate_units\": \"m\" to the collection when the coordinates are metres");
}

template <class Change>
void each_point(GeoFile& file, Change change) {
  for (GeoFeature& feature : file.features)
    for (auto& part : feature.parts)
      for (Polygon& ring : part)
        for (Vec2& point : ring) change(point);
}

/// A floor that lies across the 180th meridian has longitudes near 180 and near -180: these count on from
/// 180, so that the floor is in one piece.
void across_180th_meridian(GeoFile& file) {
  const Extent extent = extent_of(file);
  if (extent.empty() || extent.least.x() < -180 || extent.most.x() > 180 ||
      extent.most.x() - extent.least.x() <= 180)
    return;
  each_point(file, [](Vec2& point) { point.x() += point.x() < 0 ? 360 : 0; });
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Features farther from the median of all than half a floor's greatest width lose their geometry: a slip of
/// the hand, a point at (0, 0). When most are so far apart, the file is at fault and not they.
void leave_out_far_features(GeoFile& file, double farthest) {
  std::vector<double> x, y;
  for (const GeoFeature& feature : file.features)
    if (!feature.parts.empty() && !feature.parts[0].empty() && !feature.parts[0][0].empty()) {
      x.push_back(feature.parts[0][0][0].x());
      y.push_back(feature.parts[0][0][0].y());
    }
  if (x.empty()) return;
  const Vec2 middle(median(x), median(y));
  std::vector<GeoFeature*> far;
  for (GeoFeature& feature : file.features) {
    bool apart = false;
    for (const auto& part : feature.parts)
      for (const Polygon& ring : part)
        for (const Vec2& point : ring) apart = apart || (point - middle).cwiseAbs().maxCoeff() > farthest;
    if (apart) far.push_back(&feature);
  }
  if (2 * far.size() >= x.size()) return;
  for (GeoFeature* feature : far) {
    feature->parts.clear();
    feature->fault = "it lies far away from the rest of the plan";
  }
}

}  // namespace

void place_on_plan(GeoFile& file, const std::optional<GeoOrigin>& about, GeoFaults faults) {
  const std::string units = text_of(file.members, "coordinate_units");
  if (units.empty()) across_180th_meridian(file);
  if (faults == GeoFaults::keep) leave_out_far_features(file, (units == "m" ? kWidest_m : kWidest_deg) / 2);
  const Extent extent = extent_of(file);
  if (units == "m") {
    check_metres(file, extent);
    return;
  }
  if (!units.empty())
    fail(file, "the coordinate_units '" + units + "' are not known",
         "use \"m\" for metres, or leave it out for WGS84 longitude and latitude");
  check_degrees(file, extent);
  if (extent.empty()) return;
  const Vec2 centre = (extent.least + extent.most) / 2;
  if (about) file.origin = about;
  if (!file.origin) file.origin = GeoOrigin{centre.x() > 180 ? centre.x() - 360 : centre.x(), centre.y()};
  each_point(file, [&](Vec2& point) { point = plan_from_wgs84(*file.origin, point.x(), point.y()); });
}

}  // namespace gramap
