#include "floor/read_indoor.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "floor/find_spaces.h"
#include "floor/ring_check.h"
#include "geometry/error.h"
#include "geometry/polygon.h"

namespace gramap {
namespace {

struct Unit {
  enum class Use { room, hallway, fixed } use = Use::room;
  std::string id, type, name;
  Polygon outline;
};

struct Door {
  Vec2 at = Vec2::Zero();
  double width_m = 0;
};

/// One level as both formats have it.
struct Level {
  std::string name;
  double order = 0;
  std::vector<Unit> units;
  std::vector<Door> doors;
};

struct PathAndLevel {
  std::filesystem::path path;
  std::string level;
};

PathAndLevel split_path(const std::filesystem::path& path) {
  const std::string text = path.string();
  const std::size_t hash = text.rfind('#');
  if (hash == std::string::npos || std::filesystem::exists(path)) return {path, ""};
  return {text.substr(0, hash), text.substr(hash + 1)};
}

// ---- OpenStreetMap: https://wiki.openstreetmap.org/wiki/Simple_Indoor_Tagging
// ----------------------------------

/// "1", "0;1", "0-2": every level a feature lies on; without the tag, level 0.
std::vector<std::string> levels_of(const GeoFeature& feature) {
  const std::string text = text_of(feature.properties, "level");
  if (text.empty()) return {"0"};
  std::vector<std::string> levels;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(';', begin), text.size());
    const std::string part = text.substr(begin, end - begin);
    const std::size_t dash = part.find('-', 1);
    begin = end + 1;
    if (dash == std::string::npos) {
      levels.push_back(part);
      continue;
    }
    const int first = std::atoi(part.substr(0, dash).c_str()),
              last = std::atoi(part.substr(dash + 1).c_str());
    for (int level = first; level <= last && level < first + 200; ++level)
      levels.push_back(std::to_string(level));
  }
  return levels;
}

std::string capitalised(std::string text) {
  for (char& letter : text)
    if (!std::isalnum(static_cast<unsigned char>(letter))) letter = '_';
  if (!text.empty()) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text;
}

bool is_area(const GeoFeature& feature) {
  return feature.geometry == "Polygon" || (feature.geometry == "MultiPolygon" && feature.parts.size() == 1);
}

Unit osm_unit(const GeoFile& file, const GeoFeature& feature) {
  const auto tag = [&](const char* key) { return text_of(feature.properties, key); };
  Unit unit;
  const std::string indoor = tag("indoor"), room = tag("room");
  unit.id = tag("ref");
  if (unit.id.empty()) unit.id = tag("id");
  unit.name = tag("name");
  unit.outline = ring_of(file, feature, true);
  const bool vertical =
      tag("stairs") == "yes" || !tag("highway").empty() || room == "stairs" || room == "elevator";
  if (vertical) {
    unit.use = Unit::Use::fixed;
    unit.type = tag("highway") == "elevator" || room == "elevator" ? "Lift" : "Stairs";
  } else if (indoor == "corridor" || indoor == "area" || room == "corridor" || room == "hall" ||
             room == "entrance") {
    unit.use = Unit::Use::hallway;
  } else if (tag("amenity") == "toilets" || room == "toilet" || room == "toilets") {
    unit.type = "WC";
  } else {
    unit.type = capitalised(room == "yes" ? "" : room);
  }
  return unit;
}

/// Metres of a length as OpenStreetMap writes them: "0.9", "0.9 m", "90 cm", "3 ft", 6'8" (its wiki, "Map
/// features/Units"); nothing for other text, of which crowds write much.
std::optional<double> osm_length_m(const std::string& text) {
  static const std::map<std::string, double> units{{"", 1},        {"m", 1},       {"cm", 0.01},
                                                   {"mm", 0.001},  {"ft", 0.3048}, {"'", 0.3048},
                                                   {"in", 0.0254}, {"\"", 0.0254}};
  const auto skip_blanks = [](const char* at, const char* end) {
    return std::find_if(at, end, [](char c) { return c != ' '; });
  };
  const char* const end = text.data() + text.size();
  double length_m = 0;
  const char* at = skip_blanks(text.data(), end);
  if (at == end) return std::nullopt;
  while (at != end) {
    double value = 0;
    const auto [stop, error] = std::from_chars(at, end, value);
    if (error != std::errc()) return std::nullopt;
    const char* const unit = skip_blanks(stop, end);
    const char* const unit_end =
        std::find_if(unit, end, [](char c) { return c == ' ' || (c >= '0' && c <= '9'); });
    const auto known = units.find(std::string(unit, unit_end));
    if (known == units.end()) return std::nullopt;
    length_m += value * known->second;
    at = skip_blanks(unit_end, end);
  }
  return std::isfinite(length_m) && length_m > 0 ? std::optional(length_m) : std::nullopt;
}

std::map<std::string, Level> read_osm(const GeoFile& file) {
  std::map<std::string, Level> levels;
  for (const GeoFeature& feature : file.features) {
    const std::string indoor = text_of(feature.properties, "indoor");
    const std::string door = text_of(feature.properties, "door");
    const bool area = is_area(feature) && (indoor == "room" || indoor == "corridor" || indoor == "area");
    const bool passage =
        feature.geometry == "Point" && (!door.empty() || feature.properties.contains("entrance"));
    if (!area && !passage) continue;
    for (const std::string& name : levels_of(feature)) {
      Level& level = levels[name];
      level.name = name;
      level.order = std::atof(name.c_str());
      if (area)
        level.units.push_back(osm_unit(file, feature));
      else
        level.doors.push_back(
            {point_of(file, feature), osm_length_m(text_of(feature.properties, "width")).value_or(0)});
    }
  }
  return levels;
}

// ---- IMDF: https://docs.ogc.org/cs/20-094/
// ---------------------------------------------------------------------

Unit imdf_unit(const GeoFile& file, const GeoFeature& feature) {
  static const std::set<std::string> hallways = {"walkway", "vegetation.walkway", "lobby", "foyer"};
  static const std::map<std::string, std::string> fixed = {{"stairs", "Stairs"},
                                                           {"steps", "Stairs"},
                                                           {"elevator", "Lift"},
                                                           {"escalator", "Escalator"},
                                                           {"ramp", "Ramp"}};
  Unit unit;
  const std::string category = text_of(feature.properties, "category");
  unit.id = text_of(feature.properties, "id");
  for (const auto& [key, value] : feature.properties)  // a name in any language
    if (key.starts_with("name.") && unit.name.empty()) unit.name = text_of(feature.properties, key);
  unit.outline = ring_of(file, feature, true);
  if (hallways.contains(category)) {
    unit.use = Unit::Use::hallway;
  } else if (const auto found = fixed.find(category); found != fixed.end()) {
    unit.use = Unit::Use::fixed;
    unit.type = found->second;
  } else if (category.starts_with("restroom")) {
    unit.type = "WC";
  } else if (category != "room" && category != "unspecified") {
    unit.type = capitalised(category);
  }
  return unit;
}

std::map<std::string, Level> read_imdf(const std::filesystem::path& folder, GeoFile& units) {
  units = read_geojson(folder / "unit.geojson");
  std::map<std::string, Level> levels;
  static const std::set<std::string> no_room = {"opentobelow", "column",   "structure",
                                                "brick",       "concrete", "glass"};
  std::error_code ignored;
  if (std::filesystem::exists(folder / "level.geojson", ignored)) {
    const GeoFile file = read_geojson(folder / "level.geojson", units.origin);
    for (const GeoFeature& feature : file.features) {
      Level& level = levels[text_of(feature.properties, "id")];
      level.order = number_of(file, feature, "ordinal").value_or(0);
      level.name = text_of(feature.properties, "ordinal");
    }
  }
  for (const GeoFeature& feature : units.features)
    if (is_area(feature) && !no_room.contains(text_of(feature.properties, "category")))
      levels[text_of(feature.properties, "level_id")].units.push_back(imdf_unit(units, feature));
  if (std::filesystem::exists(folder / "opening.geojson", ignored)) {
    const GeoFile file = read_geojson(folder / "opening.geojson", units.origin);
    for (const GeoFeature& feature : file.features) {
      if (feature.geometry != "LineString") continue;
      const auto [a, b] = segment_of(file, feature);
      levels[text_of(feature.properties, "level_id")].doors.push_back({(a + b) / 2, (b - a).norm()});
    }
  }
  return levels;
}

// ---- A level to a floor
// ----------------------------------------------------------------------------------------

/// The ring with every edge moved inwards; the ring itself where that leaves nothing simple.
Polygon drawn_in(const Polygon& outline, double by_m) {
  const Polygon ring = simplified(outline, 0.02);
  const std::size_t n = ring.size();
  Polygon inner;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 u = (ring[i] - ring[(i + n - 1) % n]).normalized(),
               v = (ring[(i + 1) % n] - ring[i]).normalized();
    const Vec2 a(-u.y(), u.x()), b(-v.y(), v.x());
    inner.push_back(ring[i] + by_m * (a + b) / std::max(0.2, 1 + a.dot(b)));  // both lines, moved, meet here
  }
  if (signed_area(inner) <= 0 || ring_fault(without_repeats(inner))) return outline;
  return inner;
}

/// Median distance between neighbours in the rows: the plan's wall thickness, about 0 where rooms abut.
double median_gap(const std::vector<std::vector<HallwayContact>>& rows) {
  std::vector<double> gaps;
  for (const auto& row : rows)
    for (std::size_t i = 0; i + 1 < row.size(); ++i)
      gaps.push_back((row[i].end - row[i].start).normalized().dot(row[i + 1].start - row[i].end));
  if (gaps.empty()) return 0;
  std::nth_element(gaps.begin(), gaps.begin() + static_cast<std::ptrdiff_t>(gaps.size() / 2), gaps.end());
  return gaps[gaps.size() / 2];
}

std::string unique_id(const std::string& wish, const std::string& otherwise, std::set<std::string>& taken) {
  std::string id = wish.empty() ? otherwise : wish;
  for (int i = 2; !taken.insert(id).second; ++i)
    id = (wish.empty() ? otherwise : wish) + "_" + std::to_string(i);
  return id;
}

/// Doors belong to the rooms whose border they lie on; between two rooms, to the nearer.
void place_doors(const Level& level, const IndoorOptions& options, FloorTruth& truth) {
  for (const Door& door : level.doors) {
    double least = 0.4;
    const TrueRoom* nearest = nullptr;
    Vec2 along = Vec2::UnitX(), foot = door.at;
    for (const TrueRoom& room : truth.rooms) {
      for (std::size_t i = 0; i < room.outline.size(); ++i) {
        const Vec2 &a = room.outline[i], &b = room.outline[(i + 1) % room.outline.size()];
        const double distance = distance_to_segment(door.at, a, b);
        if (distance >= least || (b - a).norm() < 0.3) continue;
        least = distance;
        nearest = &room;
        along = (b - a).normalized();
        foot = a + along * std::clamp(along.dot(door.at - a), 0.0, (b - a).norm());
      }
    }
    if (!nearest) continue;  // an entrance, or a door between hallways
    const double width = door.width_m > 0 ? door.width_m : options.door_width_m;
    truth.openings.push_back({"door", nearest->id, foot - along * width / 2, foot + along * width / 2, width,
                              0, options.door_height_m});
  }
}

/// What a row's space has to keep away from.
std::vector<Polygon> all_but(const std::vector<HallwayContact>& row,
                             const std::vector<std::vector<HallwayContact>>& rows,
                             const IndoorFloor& indoor) {
  std::vector<Polygon> others;
  for (const Hallway& hallway : indoor.floor.hallways) others.push_back(hallway.outline);
  for (const FixedRoom& fixed : indoor.floor.fixed) others.push_back(fixed.outline);
  for (const auto& other : rows)
    if (&other != &row)
      for (const HallwayContact& contact : other)
        others.push_back(indoor.truth.rooms[static_cast<std::size_t>(contact.room)].outline);
  return others;
}

IndoorFloor to_floor(const Level& level, const GeoFile& file, const IndoorOptions& options) {
  IndoorFloor result;
  result.floor.name = std::filesystem::path(file.path).stem().string() + " level " + level.name;
  result.floor.origin = file.origin;
  result.floor.ceiling_height_m = options.storey_height_m;
  std::set<std::string> taken;
  int count = 0;
  for (const Unit& unit : level.units) {
    const std::string id = unique_id(unit.id, "unit" + std::to_string(++count), taken);
    if (unit.use == Unit::Use::hallway) result.floor.hallways.push_back({id, unit.name, unit.outline});
    if (unit.use == Unit::Use::fixed) result.floor.fixed.push_back({id, unit.type, unit.name, unit.outline});
    if (unit.use == Unit::Use::room)
      result.truth.rooms.push_back({id, unit.type, unit.name, unit.outline, 0, options.storey_height_m});
  }
  std::vector<Vec2> doors;
  for (const Door& door : level.doors) doors.push_back(door.at);

  auto rows = contact_rows(hallway_contacts(result.floor.hallways, result.truth.rooms, doors));
  const double gap = median_gap(rows);
  if (gap > 0.05) {
    result.floor.inner_wall_m = gap;
  } else {
    result.floor.inner_wall_m = options.wall_m;
    for (Hallway& hallway : result.floor.hallways)
      hallway.outline = drawn_in(hallway.outline, options.wall_m / 2);
    for (FixedRoom& room : result.floor.fixed) room.outline = drawn_in(room.outline, options.wall_m / 2);
    for (TrueRoom& room : result.truth.rooms) room.outline = drawn_in(room.outline, options.wall_m / 2);
    rows = contact_rows(hallway_contacts(result.floor.hallways, result.truth.rooms, doors));
  }
  for (const auto& row : rows) {
    const Hallway& hallway = result.floor.hallways[static_cast<std::size_t>(row.front().hallway)];
    const std::string first = result.truth.rooms[static_cast<std::size_t>(row.front().room)].id;
    const std::string last = result.truth.rooms[static_cast<std::size_t>(row.back().room)].id;
    result.floor.spaces.push_back(space_of_row(row, first == last ? first : first + "-" + last, hallway.id,
                                               all_but(row, rows, result), *result.floor.inner_wall_m));
  }
  place_doors(level, options, result.truth);
  return result;
}

}  // namespace

bool is_indoor_plan(const std::filesystem::path& path) {
  const PathAndLevel wanted = split_path(path);
  std::error_code ignored;
  if (std::filesystem::is_directory(wanted.path, ignored))
    return std::filesystem::exists(wanted.path / "unit.geojson", ignored) &&
           !std::filesystem::exists(wanted.path / "floor.geojson", ignored);
  const GeoFile file = read_geojson(wanted.path);
  bool indoor = false;
  for (const GeoFeature& feature : file.features) {
    if (feature.properties.contains("kind")) return false;
    indoor = indoor || feature.properties.contains("indoor");
  }
  return indoor;
}

std::vector<IndoorFloor> read_indoor(const std::filesystem::path& path, const IndoorOptions& options) {
  const PathAndLevel wanted = split_path(path);
  std::error_code ignored;
  const bool imdf = std::filesystem::is_directory(wanted.path, ignored);
  GeoFile file;
  std::map<std::string, Level> levels;
  if (imdf) {
    levels = read_imdf(wanted.path, file);
  } else {
    file = read_geojson(wanted.path);
    levels = read_osm(file);
  }
  std::vector<const Level*> order;
  for (const auto& [id, level] : levels)
    if (!level.units.empty() && (wanted.level.empty() || wanted.level == level.name)) order.push_back(&level);
  std::stable_sort(order.begin(), order.end(),
                   [](const Level* a, const Level* b) { return a->order < b->order; });
  if (order.empty())
    throw InputError(
        {path.string()},
        wanted.level.empty() ? "there is no room in this indoor plan"
                             : "the plan has no level '" + wanted.level + "'",
        imdf ? "IMDF keeps rooms as units in unit.geojson" : "rooms are areas tagged indoor=room");
  std::vector<IndoorFloor> floors;
  for (const Level* level : order) {
    floors.push_back(to_floor(*level, file, options));
    if (floors.back().floor.hallways.empty())
      throw InputError(
          {path.string()}, "level " + level->name + " has no hallway to find spaces along",
          imdf ? "give its hallways the unit category 'walkway'" : "tag its hallways indoor=corridor");
  }
  return floors;
}

IndoorFloor only_level(const std::filesystem::path& path, const IndoorOptions& options) {
  std::vector<IndoorFloor> floors = read_indoor(path, options);
  if (floors.size() > 1)
    throw InputError({path.string()}, "the plan has " + std::to_string(floors.size()) + " levels",
                     "name one: '" + path.string() + "#1'");
  return std::move(floors.front());
}

}  // namespace gramap
