#include <algorithm>
#include <set>

#include "floor/geojson.h"
#include "floor/ground_truth.h"
#include "floor/read_indoor.h"
#include "floor/reference_line.h"
#include "geometry/error.h"

namespace gramap {
namespace {

struct Heights {
  double low = 0, high = 0;
};

Heights read_heights(const GeoFile& file, const GeoFeature& feature, const std::string& low_key,
                     const std::string& high_key) {
  const Heights heights{number_of(file, feature, low_key).value_or(0),
                        number_of(file, feature, high_key).value_or(0)};
  if (heights.high < heights.low && feature.properties.contains(high_key))
    fail(file, feature, "its '" + high_key + "' is below its '" + low_key + "'", "give both in metres");
  return heights;
}

TrueRoom read_room(const GeoFile& file, const GeoFeature& feature) {
  TrueRoom room;
  room.id = text_of(feature.properties, "id");
  if (room.id.empty()) fail(file, feature, "the room has no 'id'", "add \"id\" to the feature's properties");
  room.type = text_of(feature.properties, "type");
  room.name = text_of(feature.properties, "name");
  const Heights heights = read_heights(file, feature, "floor", "ceiling");
  room.floor_m = heights.low;
  room.ceiling_m = heights.high;
  room.outline = ring_of(file, feature);
  return room;
}

TrueOpening read_opening(const GeoFile& file, const GeoFeature& feature, const std::string& kind) {
  TrueOpening opening;
  opening.kind = kind;
  opening.room = text_of(feature.properties, "room");
  std::tie(opening.a, opening.b) = segment_of(file, feature);
  opening.width_m = number_of(file, feature, "width").value_or((opening.b - opening.a).norm());
  if (!(opening.width_m > 0))
    fail(file, feature, "it has no width",
         "draw it from one end to the other, or give its \"width\" in metres");
  const Heights heights = read_heights(file, feature, "sill", "head");
  opening.sill_m = heights.low;
  opening.head_m = heights.high;
  return opening;
}

TrueFurniture read_furniture(const GeoFile& file, const GeoFeature& feature) {
  const Heights heights = read_heights(file, feature, "bottom", "top");
  return {text_of(feature.properties, "room"), text_of(feature.properties, "class"), ring_of(file, feature),
          heights.low, heights.high};
}

}  // namespace

FloorTruth read_truth(const std::filesystem::path& path, const std::optional<GeoOrigin>& about) {
  if (is_indoor_plan(path)) return only_level(path).truth;
  std::optional<GeoOrigin> origin = about;
  std::error_code ignored;
  if (!origin && std::filesystem::exists(path / "floor.geojson", ignored))
    origin = read_geojson(path / "floor.geojson").origin;
  const GeoFile file = read_geojson(floor_file(path, "truth.geojson"), origin);
  FloorTruth truth;
  std::set<std::string> ids;
  for (const GeoFeature& feature : file.features) {
    const std::string kind = text_of(feature.properties, "kind");
    if (kind == "room") {
      truth.rooms.push_back(read_room(file, feature));
      if (!ids.insert(truth.rooms.back().id).second)
        fail(file, feature, "the id '" + truth.rooms.back().id + "' is used twice",
             "give every room its own id");
    } else if (kind == "door" || kind == "window") {
      truth.openings.push_back(read_opening(file, feature, kind));
    } else if (kind == "furniture") {
      truth.furniture.push_back(read_furniture(file, feature));
    } else if (kind.empty()) {
      fail(file, feature, "it has no 'kind'",
           "add \"kind\" to the feature's properties: room, door, window, furniture");
    }
  }
  for (const GeoFeature& feature : file.features) {
    const std::string kind = text_of(feature.properties, "kind"), room = text_of(feature.properties, "room");
    if ((kind == "door" || kind == "window" || kind == "furniture") && !room.empty() && !ids.contains(room))
      fail(file, feature, "it names the room '" + room + "', which the file does not have",
           "write the id of one of the file's room features");
  }
  return truth;
}

}  // namespace gramap
