#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>

#include "floor/geojson.h"
#include "floor/ground_truth.h"
#include "floor/read_indoor.h"
#include "floor/reference_line.h"
#include "geometry/error.h"
#include "geometry/polygon.h"

namespace gramap {
namespace {

const std::set<std::string> kTruthKinds = {"room", "door", "window", "furniture"};
constexpr const char* kKnownKinds =
    "outline, hallway, fixed, space, reference_line, scan; room, door, window, furniture";

/// The feature's own name, from the first of `keys` that it has.
std::string required(const GeoFile& file, const GeoFeature& feature, const std::string& key) {
  const std::string text = text_of(feature.properties, key);
  if (text.empty())
    fail(file, feature, "it has no '" + key + "'", "add \"" + key + "\" to the feature's properties");
  return text;
}

void claim(std::set<std::string>& taken, const std::string& id, const GeoFile& file,
           const GeoFeature& feature) {
  if (!taken.insert(id).second)
    fail(file, feature, "the id '" + id + "' is used twice", "give every feature of a kind an id of its own");
}

struct ReferenceLine {
  const GeoFeature* feature = nullptr;
  Vec2 start, end;
};

std::optional<double> positive_member(const GeoFile& file, const std::string& key, double most) {
  const std::optional<double> value = member_number(file, key);
  if (value && !(*value > 0 && *value <= most))
    throw InputError({file.path},
                     "the collection's '" + key + "' must be more than 0 and at most " +
                         std::to_string(static_cast<int>(most)) + " m",
                     "give it in metres, or leave it out when it is not known");
  return value;
}

void place_line(const GeoFile& file, const GeoFeature& feature, const ReferenceLine& line, Space& space,
                std::vector<std::string>& remarks) {
  space.start = line.start;
  space.end = line.end;
  switch (side_of(space.outline, space.start, space.end)) {
    case LineSide::left:
      break;
    case LineSide::right:
      std::swap(space.start, space.end);
      remarks.push_back("the reference line of space '" + space.id +
                        "' had the space on its right and was turned round");
      break;
    case LineSide::off_border:
      fail(file, feature, "the line does not run along the border of space '" + space.id + "' (to 5 cm)",
           "draw it along the space's hallway edge, with the space on its left; or leave the line out, and "
           "the "
           "edge beside the hallway is taken");
  }
  const double length = (space.end - space.start).norm(),
               whole = side_length(space.outline, space.start, space.end);
  if (whole > length + 0.3) {
    char text[200];
    std::snprintf(
        text, sizeof text,
        "' covers %.2f m of the space's side of %.2f m; beyond its ends the space stays without rooms",
        length, whole);
    remarks.push_back("the reference line of space '" + space.id + text);
  }
}

void find_line(const GeoFile& file, const GeoFeature& feature, const FloorGroundTruth& floor, Space& space,
               std::vector<std::string>& remarks) {
  for (const Hallway& hallway : floor.hallways) {
    if (hallway.id != space.hallway) continue;
    const auto edge = edge_beside(space.outline, hallway.outline);
    if (!edge) break;
    space.start = edge->first;
    space.end = edge->second;
    remarks.push_back("space '" + space.id + "' has no reference line; its edge beside hallway '" +
                      hallway.id + "' is taken");
    return;
  }
  fail(file, feature,
       "it has no reference line, and no edge of it runs beside its hallway '" + space.hallway + "'",
       "add a reference_line feature with \"space\": \"" + space.id + "\"");
}

/// The hallway whose border is nearest to the reference line's middle, or to the space when there is none
/// yet.
std::string nearest_hallway(const FloorGroundTruth& floor, const Vec2& from) {
  std::string best;
  double least = 0;
  for (const Hallway& hallway : floor.hallways) {
    const double distance = distance_to_border(hallway.outline, from);
    if (!best.empty() && distance >= least) continue;
    best = hallway.id;
    least = distance;
  }
  return best;
}

/// Refuses a file that holds something else altogether, before its first feature is blamed for it.
void require_kinds(const GeoFile& file) {
  if (file.features.empty() ||
      std::any_of(file.features.begin(), file.features.end(),
                  [](const GeoFeature& feature) { return feature.properties.contains("kind"); }))
    return;
  throw InputError({file.path},
                   "this is no floor: no feature of it has a 'kind', an 'indoor' tag or a 'feature_type'",
                   "floors are drawn with a \"kind\" on each feature, or are plans in OpenStreetMap's indoor "
                   "tagging or IMDF");
}

}  // namespace

FloorGroundTruth read_floor(const std::filesystem::path& path) {
  if (is_indoor_plan(path)) return only_level(path).floor;
  const GeoFile file = read_geojson(floor_file(path, "floor.geojson"));
  require_kinds(file);
  FloorGroundTruth floor;
  floor.name = text_of(file.members, "name");
  floor.origin = file.origin;
  floor.elevation_m = member_number(file, "elevation").value_or(0);
  floor.ceiling_height_m = positive_member(file, "ceiling_height", 100);
  floor.inner_wall_m = positive_member(file, "walls.inner", 5);
  floor.outer_wall_m = positive_member(file, "walls.outer", 5);

  std::set<std::string> rooms, spaces;
  int clockwise = 0;
  std::map<std::string, ReferenceLine> lines;  // by space
  std::vector<const GeoFeature*> space_features;
  for (const GeoFeature& feature : file.features) {
    const std::string kind = required(file, feature, "kind");
    if (kTruthKinds.contains(kind)) continue;
    if (feature.geometry == "Polygon" && signed_area(feature.parts[0][0]) < 0) ++clockwise;
    if (kind == "outline") {
      if (!floor.outline.empty())
        fail(file, feature, "the floor has a second outline",
             "keep one outline: the outer face of the outer walls");
      floor.outline = ring_of(file, feature, true);
      for (const Polygon& hole : holes_of(file, feature)) floor.courtyards.push_back(simplified(hole));
    } else if (kind == "hallway") {
      const std::string id = required(file, feature, "id");
      claim(rooms, id, file, feature);
      floor.hallways.push_back({id, text_of(feature.properties, "name"), ring_of(file, feature)});
    } else if (kind == "fixed") {
      const std::string id = required(file, feature, "id");
      claim(rooms, id, file, feature);
      floor.fixed.push_back({id, text_of(feature.properties, "type"), text_of(feature.properties, "name"),
                             ring_of(file, feature)});
    } else if (kind == "space") {
      Space space;
      space.id = required(file, feature, "id");
      claim(spaces, space.id, file, feature);
      space.hallway = text_of(feature.properties, "hallway");
      space.outline = ring_of(file, feature);
      floor.spaces.push_back(space);
      space_features.push_back(&feature);
    } else if (kind == "reference_line") {
      const auto [start, end] = segment_of(file, feature);
      const std::string space = required(file, feature, "space");
      if (!lines.insert({space, {&feature, start, end}}).second)
        fail(file, feature, "space '" + space + "' has a second reference line",
             "keep one line for each space");
    } else if (kind == "scan") {
      Pin pin{required(file, feature, "room"), point_of(file, feature),
              number_of(file, feature, "sigma").value_or(0.5)};
      if (!(pin.sigma_m > 0))
        fail(file, feature, "its 'sigma' is not positive",
             "give the pin's standard deviation in metres, say 0.5");
      floor.pins.push_back(pin);
    } else {
      fail(file, feature, "its kind '" + kind + "' is unknown", std::string("use one of: ") + kKnownKinds);
    }
  }

  for (std::size_t i = 0; i < floor.spaces.size(); ++i) {
    Space& space = floor.spaces[i];
    const GeoFeature& feature = *space_features[i];
    const auto line = lines.find(space.id);
    if (!space.hallway.empty() &&
        std::none_of(floor.hallways.begin(), floor.hallways.end(),
                     [&](const Hallway& hallway) { return hallway.id == space.hallway; }))
      fail(file, feature, "it names the hallway '" + space.hallway + "', which the file does not have",
           "write the id of one of the file's hallway features");
    if (space.hallway.empty())
      space.hallway =
          nearest_hallway(floor, line == lines.end() ? centroid(space.outline)
                                                     : Vec2((line->second.start + line->second.end) / 2));
    if (line == lines.end())
      find_line(file, feature, floor, space, floor.remarks);
    else
      place_line(file, *line->second.feature, line->second, space, floor.remarks);
    lines.erase(space.id);
  }
  if (clockwise > 0)
    floor.remarks.push_back("areas drawn clockwise, which were turned round: " + std::to_string(clockwise));
  if (!lines.empty())
    fail(file, *lines.begin()->second.feature,
         "it names the space '" + lines.begin()->first + "', which the file does not have",
         "write the id of one of the file's space features");
  return floor;
}

std::filesystem::path floor_file(const std::filesystem::path& path, const std::string& name) {
  std::error_code ignored;
  if (!std::filesystem::is_directory(path, ignored)) return path;
  if (!std::filesystem::exists(path / name, ignored)) {
    std::string inside;  // an archive unpacks into a folder of its own
    for (std::filesystem::directory_iterator entry(path, ignored), end; entry != end;
         entry.increment(ignored))
      for (const char* file : {"floor.geojson", "unit.geojson"})
        if (std::filesystem::exists(entry->path() / file, ignored)) inside = entry->path().string();
    throw InputError({path.string()}, "the floor folder has no " + name,
                     inside.empty()
                         ? "a floor folder holds floor.geojson, scans/ and, where it is known, truth.geojson"
                         : "did you mean the folder '" + inside + "'?");
  }
  return path / name;
}

}  // namespace gramap
