// GeoJSON as plain structs, for the readers of floor files: features with flat properties and projected plan
// coordinates. The JSON library stays behind this header. Geometry is checked for what is wrong in any floor
// file: numbers that are not finite, metres that look like degrees and degrees that look like metres, rings
// that are no rings.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "floor/projection.h"
#include "geometry/types.h"

namespace gramap {

/// Members by name; those of nested objects are named "outer.inner". Null members are left out, arrays too.
using GeoProperties = std::map<std::string, std::variant<std::string, double, bool>>;

struct GeoFeature {
  int index = 0;  ///< position in the file, from 0
  GeoProperties properties;
  std::string geometry;  ///< "Polygon", "LineString", "Point", "Multi…", or empty for none
  /// Polygons or lines or points; a polygon's rings with the outer one first, as they stand in the file but
  /// for the closing point. A line or a point is the only ring of its part.
  std::vector<std::vector<Polygon>> parts;
  std::string fault;  ///< what is wrong with its geometry, which is left out then; see GeoFaults::keep
};

struct GeoFile {
  std::string path;
  GeoProperties members;  ///< of the collection itself
  std::optional<GeoOrigin>
      origin;  ///< where plan coordinates (0, 0) are on the ellipsoid, when that is known
  std::vector<GeoFeature> features;
};

/// What to do about a feature whose geometry cannot be read, or that lies far from all others.
enum class GeoFaults {
  refuse,  ///< throw InputError: the files that are drawn for gramap
  keep,    ///< note it in the feature: plans that others have drawn, where one room must not cost the floor
};

/// Reads a FeatureCollection. With `coordinate_units` "m" the coordinates are local metres; without it they
/// are WGS84 longitude and latitude and are projected about `about`, about the file's own `origin` member, or
/// about the centre of all its coordinates; a floor may lie across the 180th meridian, not at a pole. Throws
/// InputError.
GeoFile read_geojson(const std::filesystem::path& path, const std::optional<GeoOrigin>& about = std::nullopt,
                     GeoFaults faults = GeoFaults::refuse);
/// The same of bytes that are at hand; `name` is what messages call the file.
GeoFile parse_geojson(const std::string& text, const std::string& name,
                      const std::optional<GeoOrigin>& about = std::nullopt,
                      GeoFaults faults = GeoFaults::refuse);

/// Property access; numbers given as text ("0.9") count as numbers and numbers serve as names.
std::string text_of(const GeoProperties& properties, const std::string& key);
std::optional<double> number_of(const GeoFile& file, const GeoFeature& feature, const std::string& key);
std::optional<double> member_number(const GeoFile& file, const std::string& key);

/// "feature 7 (space 'south')".
std::string describe(const GeoFeature& feature);

/// Throws InputError about one feature of the file.
[[noreturn]] void fail(const GeoFile& file, const GeoFeature& feature, const std::string& message,
                       const std::string& advice);

/// The feature's only polygon as a simple counter-clockwise ring without repeated points. A MultiPolygon of
/// one polygon counts. Throws InputError for another geometry, holes (unless `holes_allowed`), a ring of no
/// area, or one that crosses or touches itself.
Polygon ring_of(const GeoFile& file, const GeoFeature& feature, bool holes_allowed = false);

/// The holes of a polygon that ring_of accepted: simple rings inside of it, apart from it and from each
/// other. Throws InputError.
std::vector<Polygon> holes_of(const GeoFile& file, const GeoFeature& feature);

/// The two ends of the feature's LineString; points between them must lie on the straight line (5 cm).
std::pair<Vec2, Vec2> segment_of(const GeoFile& file, const GeoFeature& feature);

Vec2 point_of(const GeoFile& file, const GeoFeature& feature);

}  // namespace gramap
