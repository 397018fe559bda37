#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>

#include "floor/indoor_plan.h"

namespace gramap {
namespace {

/// A tag, where converters put tags: among the properties or in an object `tags` of their own.
std::string tag(const GeoFeature& feature, const std::string& key) {
  const std::string text = text_of(feature.properties, key);
  return text.empty() ? text_of(feature.properties, "tags." + key) : text;
}

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t"), last = text.find_last_not_of(" \t");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

template <class Number>
std::optional<Number> whole_number(const std::string& text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// "1", "0;1", "-2--1", "0-2;5": the levels that the text lists; nothing when a range of it is none.
std::optional<std::vector<std::string>> listed_levels(const std::string& text) {
  constexpr int kMost = 200;  // storeys of a building
  std::vector<std::string> levels;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(';', begin), text.size());
    const std::string part = trimmed(text.substr(begin, end - begin));
    begin = end + 1;
    if (part.empty()) continue;
    const std::size_t dash = part.find('-', 1);
    const auto first = whole_number<int>(trimmed(part.substr(0, dash)));
    if (dash == std::string::npos || !first) {
      levels.push_back(part);  // also "0.5" and "EG"
      continue;
    }
    const auto last = whole_number<int>(trimmed(part.substr(dash + 1)));
    if (!last || *last < *first || *last - *first > kMost) return std::nullopt;
    for (int level = *first; level <= *last; ++level) levels.push_back(std::to_string(level));
  }
  return levels;
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

PlanUnit unit_of(const GeoFeature& feature) {
  const std::string indoor = tag(feature, "indoor"), room = tag(feature, "room"),
                    highway = tag(feature, "highway");
  PlanUnit unit;
  unit.id = tag(feature, "ref");
  if (unit.id.empty()) unit.id = text_of(feature.properties, "id");
  unit.name = tag(feature, "name");
  if (tag(feature, "stairs") == "yes" || !highway.empty() || room == "stairs" || room == "elevator") {
    unit.use = PlanUnit::Use::fixed;
    unit.type = highway == "elevator" || room == "elevator" ? "Lift" : "Stairs";
  } else if (indoor == "corridor" || indoor == "area" || room == "corridor" || room == "hall" ||
             room == "entrance") {
    unit.use = PlanUnit::Use::hallway;
  } else if (tag(feature, "amenity") == "toilets" || room == "toilet" || room == "toilets") {
    unit.type = "WC";
  } else {
    unit.type = capitalised(room == "yes" ? "" : room);
  }
  return unit;
}

/// A door's middle and width: a point, or a line across the opening.
std::optional<PlanDoor> door_of(const GeoFile& file, const GeoFeature& feature) {
  PlanDoor door{named(file, feature), Vec2::Zero(), osm_length_m(tag(feature, "width")).value_or(0)};
  if (feature.parts.size() != 1) return std::nullopt;
  const Polygon& points = feature.parts[0][0];
  if (feature.geometry == "Point") {
    door.at = points.front();
  } else if (feature.geometry == "LineString" && points.size() >= 2) {
    door.at = (points.front() + points.back()) / 2;
    if (door.width_m == 0) door.width_m = (points.back() - points.front()).norm();
  } else {
    return std::nullopt;
  }
  return door;
}

/// What a feature is to us: an area, a passage, or neither.
enum class Kind { area, passage, other };

Kind kind_of(const GeoFeature& feature) {
  const std::string indoor = tag(feature, "indoor");
  if (indoor == "room" || indoor == "corridor" || indoor == "area") return Kind::area;
  const bool passage = indoor == "door" || !tag(feature, "door").empty() || !tag(feature, "entrance").empty();
  return passage ? Kind::passage : Kind::other;
}

/// The levels that a feature is on, with those it is repeated on; sets it aside when that cannot be known.
/// Without the tag: the plan's only level, or level 0 of a plan that knows no levels.
std::vector<std::string> levels_of(const GeoFile& file, const GeoFeature& feature,
                                   const std::set<std::string>& all, IndoorPlan& plan) {
  const std::string given = tag(feature, "level"), repeated = tag(feature, "repeat_on");
  const auto levels = listed_levels(given), more = listed_levels(repeated);
  const auto set_aside = [&](const std::string& reason) {
    plan.set_aside.push_back({named(file, feature), reason});
    return std::vector<std::string>();
  };
  if (!levels) return set_aside("its level '" + given + "' is neither a level nor a range of levels");
  if (!more) return set_aside("its repeat_on '" + repeated + "' is neither a level nor a range of levels");
  std::set<std::string> on(levels->begin(), levels->end());
  on.insert(more->begin(), more->end());
  if (on.empty() && all.size() > 1) return set_aside("it has no level, and the plan has several");
  if (on.empty()) on.insert(all.empty() ? "0" : *all.begin());
  return {on.begin(), on.end()};
}

}  // namespace

IndoorPlan read_osm(const GeoFile& file) {
  IndoorPlan plan;
  plan.name = std::filesystem::path(file.path).stem().string();
  plan.origin = file.origin;
  std::set<std::string> all;
  for (const GeoFeature& feature : file.features)
    if (kind_of(feature) == Kind::area)
      for (const std::string& level :
           listed_levels(tag(feature, "level")).value_or(std::vector<std::string>()))
        all.insert(level);
  WordCount others;
  std::vector<SetAsideInput> no_width;
  for (const GeoFeature& feature : file.features) {
    const Kind kind = kind_of(feature);
    if (kind == Kind::other) {
      const std::string indoor = tag(feature, "indoor");
      others.add(indoor.empty() ? "without indoor tag" : "indoor=" + indoor);
      continue;
    }
    for (const std::string& name : levels_of(file, feature, all, plan)) {
      PlanLevel& level = plan.levels[name];
      level.name = name;
      level.position = whole_number<double>(name);
      if (kind == Kind::area) {
        add_areas(file, feature, unit_of(feature), level);
        continue;
      }
      const auto door = door_of(file, feature);
      if (door)
        level.doors.push_back(*door);
      else
        level.set_aside.push_back(
            {named(file, feature),
             feature.fault.empty() ? "a door is a point or a line, and it is neither" : feature.fault});
      if (door && !tag(feature, "width").empty() && !osm_length_m(tag(feature, "width")))
        no_width.push_back({named(file, feature), "its width is no length"});
    }
  }
  for (const SetAsideInput& item : gathered(no_width))
    plan.remarks.push_back("taken to be as wide as doors without a width: " + item.what);
  if (others.total() > 0)
    plan.remarks.push_back("features that are neither rooms, corridors, areas nor doors and not needed: " +
                           others.text());
  return plan;
}

}  // namespace gramap
