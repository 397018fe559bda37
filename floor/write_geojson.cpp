#include <cmath>
#include <nlohmann/json.hpp>

#include "floor/ground_truth.h"

namespace gramap {
namespace {

using json = nlohmann::ordered_json;

double rounded(double value) {
  const double micrometres = std::round(value * 1e6);
  return micrometres == 0 ? 0.0 : micrometres / 1e6;  // never minus zero
}

json position(const Vec2& point) {
  return json::array({rounded(point.x()), rounded(point.y())});
}

json polygon(const Polygon& ring, const std::vector<Polygon>& holes = {}) {
  const auto closed = [](const Polygon& points) {
    json list = json::array();
    for (const Vec2& point : points) list.push_back(position(point));
    if (!points.empty()) list.push_back(position(points.front()));
    return list;
  };
  json rings = json::array({closed(ring)});
  for (const Polygon& hole : holes) rings.push_back(closed(hole));
  return {{"type", "Polygon"}, {"coordinates", rings}};
}

json line(const Vec2& a, const Vec2& b) {
  return {{"type", "LineString"}, {"coordinates", json::array({position(a), position(b)})}};
}

json feature(json properties, json geometry) {
  return {{"type", "Feature"}, {"properties", std::move(properties)}, {"geometry", std::move(geometry)}};
}

void add_floor(const FloorGroundTruth& floor, std::vector<json>& features) {
  if (!floor.outline.empty())
    features.push_back(feature({{"kind", "outline"}}, polygon(floor.outline, floor.courtyards)));
  for (const Hallway& hallway : floor.hallways)
    features.push_back(
        feature({{"kind", "hallway"}, {"id", hallway.id}, {"name", hallway.name}}, polygon(hallway.outline)));
  for (const FixedRoom& room : floor.fixed)
    features.push_back(feature({{"kind", "fixed"}, {"id", room.id}, {"type", room.type}, {"name", room.name}},
                               polygon(room.outline)));
  for (const Space& space : floor.spaces) {
    json properties = {{"kind", "space"}, {"id", space.id}};
    if (!space.hallway.empty()) properties["hallway"] = space.hallway;
    features.push_back(feature(properties, polygon(space.outline)));
    features.push_back(feature({{"kind", "reference_line"}, {"id", space.id}, {"space", space.id}},
                               line(space.start, space.end)));
  }
  for (const Pin& pin : floor.pins)
    features.push_back(feature({{"kind", "scan"}, {"room", pin.room}, {"sigma", rounded(pin.sigma_m)}},
                               {{"type", "Point"}, {"coordinates", position(pin.at)}}));
}

void add_truth(const FloorTruth& truth, std::vector<json>& features) {
  for (const TrueRoom& room : truth.rooms)
    features.push_back(feature({{"kind", "room"},
                                {"id", room.id},
                                {"type", room.type},
                                {"name", room.name},
                                {"floor", rounded(room.floor_m)},
                                {"ceiling", rounded(room.ceiling_m)}},
                               polygon(room.outline)));
  for (const TrueOpening& opening : truth.openings)
    features.push_back(feature({{"kind", opening.kind},
                                {"room", opening.room},
                                {"width", rounded(opening.width_m)},
                                {"sill", rounded(opening.sill_m)},
                                {"head", rounded(opening.head_m)}},
                               line(opening.a, opening.b)));
  for (const TrueFurniture& piece : truth.furniture)
    features.push_back(feature({{"kind", "furniture"},
                                {"room", piece.room},
                                {"class", piece.type},
                                {"bottom", rounded(piece.bottom_m)},
                                {"top", rounded(piece.top_m)}},
                               polygon(piece.outline)));
}

}  // namespace

std::string to_geojson(const FloorGroundTruth& floor, const FloorTruth& truth) {
  json members = {{"type", "FeatureCollection"}};
  if (!floor.name.empty()) members["name"] = floor.name;
  members["coordinate_units"] = "m";
  if (floor.origin)  // degrees to 1e-9: a tenth of a millimetre
    members["origin"] = {std::round(floor.origin->longitude_deg * 1e9) / 1e9,
                         std::round(floor.origin->latitude_deg * 1e9) / 1e9};
  members["elevation"] = rounded(floor.elevation_m);
  if (floor.ceiling_height_m) members["ceiling_height"] = rounded(*floor.ceiling_height_m);
  if (floor.inner_wall_m) members["walls"]["inner"] = rounded(*floor.inner_wall_m);
  if (floor.outer_wall_m) members["walls"]["outer"] = rounded(*floor.outer_wall_m);

  std::vector<json> features;
  add_floor(floor, features);
  add_truth(truth, features);
  // A feature a line: readable, and a change of one room is a change of one line.
  std::string text = members.dump();
  text.pop_back();
  text += ",\"features\":[";
  for (std::size_t i = 0; i < features.size(); ++i)
    text += (i == 0 ? "\n" : ",\n") + features[i].dump(-1, ' ', false, json::error_handler_t::replace);
  return text + "\n]}\n";
}

}  // namespace gramap
