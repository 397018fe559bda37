#include "floor/geojson.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "floor/geojson_plan.h"
#include "floor/ring_check.h"
#include "floor/zip.h"
#include "geometry/error.h"
#include "geometry/file.h"
#include "geometry/polygon.h"

namespace gramap {
namespace {

using nlohmann::json;

[[noreturn]] void fail_file(const std::string& path, const std::string& message, const std::string& advice) {
  throw InputError({path}, message, advice);
}

json parse(const std::string& text, const std::string& path) {
  if (is_zip(text))
    fail_file(
        path, "this is a zip archive",
        "of archives only IMDF's are read, which hold a unit.geojson; unpack it, and give the floor in it");
  try {
    return json::parse(text);
  } catch (const json::parse_error& error) {
    const std::size_t byte = std::min(error.byte == 0 ? 0 : error.byte - 1, text.size());
    const auto line = std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(byte), '\n');
    const std::size_t start = byte == 0 ? std::string::npos : text.rfind('\n', byte - 1);
    const std::size_t column = start == std::string::npos ? byte + 1 : byte - start;
    throw InputError({path, static_cast<int>(line) + 1, static_cast<int>(column)},
                     byte >= text.size() ? "the JSON ends too early" : "this is not valid JSON here",
                     "a floor file is a GeoJSON FeatureCollection; check it with any JSON viewer");
  } catch (const json::out_of_range&) {
    throw InputError({path}, "a number in the file is too large for any computer",
                     "write coordinates in plain metres, or in degrees");
  }
}

void flatten(const json& object, const std::string& prefix, GeoProperties& into, int depth = 0) {
  for (const auto& [key, value] : object.items()) {
    const std::string name = prefix + key;
    if (value.is_string()) into[name] = value.get<std::string>();
    if (value.is_number()) into[name] = value.get<double>();
    if (value.is_boolean()) into[name] = value.get<bool>();
    if (value.is_object() && depth < 3) flatten(value, name + ".", into, depth + 1);
  }
}

/// What is wrong with a geometry, and what to do.
struct GeometryFault {
  std::string message, advice;
};

Vec2 read_position(const json& value) {
  if (!value.is_array() || value.size() < 2 || !value[0].is_number() || !value[1].is_number())
    throw GeometryFault{"a position is not a pair of numbers", "write each position as [x, y]"};
  const Vec2 position(value[0].get<double>(), value[1].get<double>());
  if (!position.allFinite())
    throw GeometryFault{"a coordinate is not a finite number",
                        "write each position as [x, y] in plain numbers"};
  return position;
}

Polygon read_positions(const json& value) {
  if (!value.is_array())
    throw GeometryFault{"its coordinates are not a list of positions",
                        "write a ring or a line as [[x, y], [x, y], …]"};
  Polygon points;
  for (const json& position : value) points.push_back(read_position(position));
  return points;
}

std::vector<Polygon> read_rings(const json& value) {
  if (!value.is_array() || value.empty())
    throw GeometryFault{"its coordinates are not a list of rings",
                        "a Polygon's coordinates are [[[x, y], …]]"};
  std::vector<Polygon> rings;
  for (const json& ring : value) rings.push_back(read_positions(ring));
  return rings;
}

void read_geometry(const json& value, GeoFeature& feature) {
  if (value.is_null()) return;
  if (!value.is_object() || !value.contains("type") || !value["type"].is_string())
    throw GeometryFault{"its geometry has no type", "see RFC 7946, section 3.1"};
  feature.geometry = value["type"].get<std::string>();
  if (feature.geometry == "GeometryCollection") return;
  if (!value.contains("coordinates") || !value["coordinates"].is_array())
    throw GeometryFault{"its geometry has no coordinates", "see RFC 7946, section 3.1"};
  const json& coordinates = value["coordinates"];
  const bool many = feature.geometry.starts_with("Multi");
  const std::string type = many ? feature.geometry.substr(5) : feature.geometry;
  const json one = json::array({coordinates});
  for (const json& part : many ? coordinates : one) {
    if (type == "Polygon")
      feature.parts.push_back(read_rings(part));
    else if (type == "LineString")
      feature.parts.push_back({read_positions(part)});
    else if (type == "Point")
      feature.parts.push_back({{read_position(part)}});
    else
      throw GeometryFault{"its geometry type '" + feature.geometry + "' is unknown",
                          "use Polygon, LineString or Point"};
  }
}

void read_feature(const json& value, const GeoFile& file, GeoFeature& feature, GeoFaults faults) {
  try {
    if (!value.is_object()) throw GeometryFault{"it is not an object", "see RFC 7946, section 3.2"};
    // IMDF keeps type and id beside the properties.
    for (const char* key : {"id", "feature_type"})
      if (value.contains(key)) flatten(json{{key, value[key]}}, "", feature.properties);
    if (value.contains("properties") && value["properties"].is_object())
      flatten(value["properties"], "", feature.properties);
    if (value.contains("geometry")) read_geometry(value["geometry"], feature);
  } catch (const GeometryFault& fault) {
    if (faults == GeoFaults::refuse) fail(file, feature, fault.message, fault.advice);
    feature.parts.clear();
    feature.fault = fault.message;
  }
}

void read_origin(const json& root, GeoFile& file) {
  if (!root.contains("origin")) return;
  const json& origin = root["origin"];
  if (!origin.is_array() || origin.size() != 2 || !origin[0].is_number() || !origin[1].is_number() ||
      std::abs(origin[0].get<double>()) > 180 || std::abs(origin[1].get<double>()) > 89)
    fail_file(file.path, "\"origin\" is not [longitude, latitude] in degrees",
              "write \"origin\": [13.7, 51.0]");
  file.origin = GeoOrigin{origin[0].get<double>(), origin[1].get<double>()};
}

/// The number that a property holds, as a number or as text; nothing when it holds something else.
std::optional<double> as_number(const std::variant<std::string, double, bool>& value) {
  if (const double* number = std::get_if<double>(&value)) return *number;
  const std::string* text = std::get_if<std::string>(&value);
  if (!text) return std::nullopt;
  double number = 0;
  const auto [end, error] = std::from_chars(text->data(), text->data() + text->size(), number);
  if (error != std::errc() || end != text->data() + text->size() || !std::isfinite(number))
    return std::nullopt;
  return number;
}

/// A simple ring without repeated points, or InputError; `which` is "its polygon" or one of its holes.
Polygon simple_ring(const GeoFile& file, const GeoFeature& feature, const Polygon& given,
                    const std::string& which) {
  Polygon ring = without_repeats(given);
  if (const auto fault = area_fault(ring))
    fail(file, feature, which + " " + *fault,
         *fault == "encloses no area" ? "give at least three corners that are not on one line"
                                      : "draw it so that its edges meet only at their common corners");
  return ring;
}

}  // namespace

GeoFile read_geojson(const std::filesystem::path& path, const std::optional<GeoOrigin>& about,
                     GeoFaults faults) {
  return parse_geojson(read_file(path), path.string(), about, faults);
}

GeoFile parse_geojson(const std::string& text, const std::string& name, const std::optional<GeoOrigin>& about,
                      GeoFaults faults) {
  GeoFile file;
  file.path = name;
  const json root = parse(text, name);
  if (!root.is_object() || root.value("type", json()) != "FeatureCollection" || !root.contains("features") ||
      !root["features"].is_array())
    fail_file(file.path, "this is not a GeoJSON FeatureCollection",
              "the file's outermost object needs \"type\": \"FeatureCollection\" and \"features\": [ … ]");
  json members = root;
  members.erase("features");
  flatten(members, "", file.members);
  for (const json& value : root["features"]) {
    GeoFeature feature;
    feature.index = static_cast<int>(file.features.size());
    read_feature(value, file, feature, faults);
    file.features.push_back(std::move(feature));
  }
  read_origin(root, file);
  place_on_plan(file, about, faults);
  return file;
}

std::string text_of(const GeoProperties& properties, const std::string& key) {
  const auto found = properties.find(key);
  if (found == properties.end()) return "";
  if (const std::string* text = std::get_if<std::string>(&found->second)) return *text;
  if (const bool* truth = std::get_if<bool>(&found->second)) return *truth ? "yes" : "no";
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, std::get<double>(found->second)).ptr;
  return std::string(buffer, end);
}

std::optional<double> number_of(const GeoFile& file, const GeoFeature& feature, const std::string& key) {
  const auto found = feature.properties.find(key);
  if (found == feature.properties.end()) return std::nullopt;
  const std::optional<double> number = as_number(found->second);
  if (!number) fail(file, feature, "its '" + key + "' is not a number", "write a plain number, in metres");
  return number;
}

std::optional<double> member_number(const GeoFile& file, const std::string& key) {
  const auto found = file.members.find(key);
  if (found == file.members.end()) return std::nullopt;
  const std::optional<double> number = as_number(found->second);
  if (!number)
    fail_file(file.path, "the collection's '" + key + "' is not a number", "write a plain number, in metres");
  return number;
}

std::string describe(const GeoFeature& feature) {
  std::string text = "feature " + std::to_string(feature.index + 1);
  std::string kind = text_of(feature.properties, "kind");
  std::string id = text_of(feature.properties, "id");
  if (id.empty()) id = text_of(feature.properties, "ref");
  if (id.empty()) id = text_of(feature.properties, "room");
  if (kind.empty() && id.empty()) return text;
  return text + " (" + kind + (kind.empty() || id.empty() ? "" : " ") + (id.empty() ? "" : "'" + id + "'") +
         ")";
}

void fail(const GeoFile& file, const GeoFeature& feature, const std::string& message,
          const std::string& advice) {
  throw InputError({file.path}, describe(feature) + ": " + message, advice);
}

Polygon ring_of(const GeoFile& file, const GeoFeature& feature, bool holes_allowed) {
  if (feature.geometry != "Polygon" && feature.geometry != "MultiPolygon")
    fail(file, feature,
         "it needs a Polygon, not a " + (feature.geometry.empty() ? "null geometry" : feature.geometry),
         "draw it as one closed area");
  if (feature.parts.size() != 1)
    fail(file, feature, "its MultiPolygon has " + std::to_string(feature.parts.size()) + " parts",
         "draw each part as a feature of its own");
  if (feature.parts[0].size() != 1 && !holes_allowed)
    fail(file, feature, "its polygon has a hole",
         "cut it into pieces without holes, each a feature of its own");
  Polygon ring = simple_ring(file, feature, feature.parts[0][0], "its polygon");
  if (signed_area(ring) < 0) std::reverse(ring.begin(), ring.end());
  return ring;
}

std::vector<Polygon> holes_of(const GeoFile& file, const GeoFeature& feature) {
  std::vector<Polygon> holes;
  for (std::size_t i = 1; i < feature.parts[0].size(); ++i)
    holes.push_back(simple_ring(file, feature, feature.parts[0][i], "its hole " + std::to_string(i)));
  if (const auto fault = holes_fault(without_repeats(feature.parts[0][0]), holes))
    fail(file, feature, *fault,
         "a hole is a courtyard: draw it inside of the outline, apart from other holes");
  return holes;
}

std::pair<Vec2, Vec2> segment_of(const GeoFile& file, const GeoFeature& feature) {
  if (feature.geometry != "LineString" && feature.geometry != "MultiLineString")
    fail(file, feature,
         "it needs a LineString, not a " + (feature.geometry.empty() ? "null geometry" : feature.geometry),
         "draw it as one straight line");
  if (feature.parts.size() != 1 || feature.parts[0][0].size() < 2)
    fail(file, feature, "its line is not one line of two points", "draw it as one straight line");
  const Polygon& line = feature.parts[0][0];
  if ((line.front() - line.back()).norm() < 1e-6)
    fail(file, feature, "its line has no length", "give two different end points");
  for (const Vec2& point : line)
    if (distance_to_segment(point, line.front(), line.back()) > 0.05)
      fail(file, feature, "its line is bent",
           "draw it as one straight line, or as one feature for each piece");
  return {line.front(), line.back()};
}

Vec2 point_of(const GeoFile& file, const GeoFeature& feature) {
  if (feature.geometry != "Point")
    fail(file, feature,
         "it needs a Point, not a " + (feature.geometry.empty() ? "null geometry" : feature.geometry),
         "mark the place with a point");
  return feature.parts[0][0][0];
}

}  // namespace gramap
