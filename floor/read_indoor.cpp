#include "floor/read_indoor.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "floor/find_spaces.h"
#include "floor/indoor_plan.h"
#include "floor/ring_check.h"
#include "floor/zip.h"
#include "geometry/error.h"
#include "geometry/file.h"
#include "geometry/polygon.h"

namespace gramap {
namespace {

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

enum class Style { none, osm, imdf };

/// Whose plan it is: features of our own kinds are nobody's but ours; else IMDF's have a feature_type, and
/// OpenStreetMap's an `indoor` tag.
Style style_of(const std::filesystem::path& path) {
  static const std::set<std::string> ours = {"outline", "hallway", "fixed", "space",  "reference_line",
                                             "scan",    "room",    "door",  "window", "furniture"};
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    const bool archive = std::filesystem::exists(path / "unit.geojson", ignored) ||
                         (std::filesystem::exists(path / "manifest.json", ignored) &&
                          std::filesystem::exists(path / "level.geojson", ignored));
    return archive && !std::filesystem::exists(path / "floor.geojson", ignored) ? Style::imdf : Style::none;
  }
  if (const std::string text = read_file(path); is_zip(text))
    return read_zip(path, is_imdf_file).empty() ? Style::none : Style::imdf;
  Style style = Style::none;
  for (const GeoFeature& feature : read_geojson(path, std::nullopt, GeoFaults::keep).features) {
    if (ours.contains(text_of(feature.properties, "kind"))) return Style::none;
    if (feature.properties.contains("feature_type")) style = Style::imdf;
    if (style == Style::none &&
        (feature.properties.contains("indoor") || feature.properties.contains("tags.indoor")))
      style = Style::osm;
  }
  return style;
}

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

/// The stretch of a border that a door lies on.
struct Threshold {
  double distance_m = 1e300;
  Vec2 foot = Vec2::Zero();  ///< the nearest place on the border
  Vec2 along = Vec2::UnitX();
};

void approach(const Vec2& door, const Polygon& outline, Threshold& nearest) {
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2 &a = outline[i], &b = outline[(i + 1) % outline.size()];
    const double distance = distance_to_segment(door, a, b);
    if (distance >= nearest.distance_m || (b - a).norm() < 0.3) continue;
    const Vec2 along = (b - a).normalized();
    nearest = {distance, a + along * std::clamp(along.dot(door - a), 0.0, (b - a).norm()), along};
  }
}

/// Doors belong to the rooms whose border they lie on; between two rooms, to the nearer. Entrances and doors
/// between hallways belong to none.
void place_doors(const PlanLevel& level, const IndoorOptions& options, IndoorFloor& indoor) {
  constexpr double kReach_m = 0.4;
  for (const PlanDoor& door : level.doors) {
    Threshold nearest;
    const TrueRoom* of = nullptr;
    for (const TrueRoom& room : indoor.truth.rooms) {
      const double before = nearest.distance_m;
      approach(door.at, room.outline, nearest);
      if (nearest.distance_m < before) of = &room;
    }
    if (nearest.distance_m < kReach_m) {
      const double width = door.width_m > 0 ? door.width_m : options.door_width_m;
      indoor.truth.openings.push_back({"door", of->id, nearest.foot - nearest.along * width / 2,
                                       nearest.foot + nearest.along * width / 2, width, 0,
                                       options.door_height_m});
      continue;
    }
    for (const Hallway& hallway : indoor.floor.hallways) approach(door.at, hallway.outline, nearest);
    for (const FixedRoom& fixed : indoor.floor.fixed) approach(door.at, fixed.outline, nearest);
    if (nearest.distance_m >= kReach_m)
      indoor.floor.set_aside.push_back(
          {door.feature, "the door lies on no wall of a room, hallway or stairs (to 40 cm)"});
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

/// The plan's units under ids of their own.
void place_units(const PlanLevel& level, const IndoorOptions& options, IndoorFloor& indoor) {
  std::set<std::string> taken;
  std::map<std::string, std::string> first;  // by id: the feature that has it
  std::vector<SetAsideInput> renamed;
  int count = 0;
  for (const PlanUnit& unit : level.units) {
    const std::string id = unique_id(unit.id, "unit" + std::to_string(++count), taken);
    // Pieces of one feature share its id anyway.
    if (!unit.id.empty() && first.try_emplace(unit.id, unit.feature).first->second != unit.feature)
      renamed.push_back({unit.feature + " is now '" + id + "'", "id"});
    if (unit.use == PlanUnit::Use::hallway) indoor.floor.hallways.push_back({id, unit.name, unit.outline});
    if (unit.use == PlanUnit::Use::fixed)
      indoor.floor.fixed.push_back({id, unit.type, unit.name, unit.outline});
    if (unit.use == PlanUnit::Use::room)
      indoor.truth.rooms.push_back({id, unit.type, unit.name, unit.outline, 0, options.storey_height_m});
  }
  for (const SetAsideInput& item : gathered(renamed))
    indoor.floor.remarks.push_back("another unit has the same id: " + item.what);
}

/// Rooms in no row teach nothing of rows; people should know.
void remark_on_lone_rooms(const std::vector<std::vector<HallwayContact>>& rows, IndoorFloor& indoor) {
  std::set<int> in_rows;
  for (const auto& row : rows)
    for (const HallwayContact& contact : row) in_rows.insert(contact.room);
  std::vector<SetAsideInput> lone;
  for (std::size_t i = 0; i < indoor.truth.rooms.size(); ++i)
    if (!in_rows.contains(static_cast<int>(i))) lone.push_back({indoor.truth.rooms[i].id, "lone"});
  for (const SetAsideInput& item : gathered(lone))
    indoor.floor.remarks.push_back(std::to_string(lone.size()) +
                                   (lone.size() == 1 ? " room lies" : " rooms lie") +
                                   " along no hallway: " + item.what);
}

IndoorFloor to_floor(const PlanLevel& level, const IndoorPlan& plan, const IndoorOptions& options) {
  IndoorFloor result;
  result.floor.name = plan.name + " level " + level.name;
  result.floor.origin = plan.origin;
  result.floor.ceiling_height_m = options.storey_height_m;
  result.floor.remarks = level.remarks;
  result.floor.set_aside = level.set_aside;
  place_units(level, options, result);
  std::vector<Vec2> doors;
  for (const PlanDoor& door : level.doors) doors.push_back(door.at);

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
  remark_on_lone_rooms(rows, result);
  place_doors(level, options, result);
  result.floor.set_aside = gathered(result.floor.set_aside);
  return result;
}

/// What a level lacks to be a floor; empty when it has all.
std::string missing_in(const PlanLevel& level, Style style) {
  const auto has = [&](PlanUnit::Use use) {
    return std::any_of(level.units.begin(), level.units.end(),
                       [&](const PlanUnit& unit) { return unit.use == use; });
  };
  if (!has(PlanUnit::Use::hallway))
    return std::string("no hallway to find spaces along; hallways are ") +
           (style == Style::imdf ? "units of the category 'walkway'" : "areas tagged indoor=corridor");
  if (!has(PlanUnit::Use::room)) return "no room";
  return "";
}

}  // namespace

bool is_indoor_plan(const std::filesystem::path& path) {
  return style_of(split_path(path).path) != Style::none;
}

std::vector<IndoorFloor> read_indoor(const std::filesystem::path& path, const IndoorOptions& options) {
  const PathAndLevel wanted = split_path(path);
  const Style style = style_of(wanted.path);
  IndoorPlan plan = style == Style::imdf ? read_imdf(wanted.path)
                                         : read_osm(read_geojson(wanted.path, std::nullopt, GeoFaults::keep));
  std::vector<PlanLevel*> levels;
  std::string names;
  for (auto& [id, level] : plan.levels) {
    drop_repeated(level);
    names += (names.empty() ? "" : ", ") + level.name;
    if (wanted.level.empty() || wanted.level == level.name || level.also.contains(wanted.level))
      levels.push_back(&level);
  }
  if (levels.empty() && !wanted.level.empty())
    throw InputError({path.string()}, "the plan has no level '" + wanted.level + "'",
                     names.empty() ? "no level of it has any rooms" : "its levels: " + names);
  std::stable_sort(levels.begin(), levels.end(), [](const PlanLevel* a, const PlanLevel* b) {
    return a->position.value_or(1e300) < b->position.value_or(1e300);
  });
  std::vector<IndoorFloor> floors;
  std::vector<SetAsideInput> lacking;
  std::string reason =
      style == Style::imdf ? "there is no unit in it" : "no area is tagged indoor=room in it";
  for (const PlanLevel* level : levels) {
    const std::string missing = missing_in(*level, style);
    if (missing.empty()) {
      floors.push_back(to_floor(*level, plan, options));
      continue;
    }
    if (level->units.empty() && level->set_aside.empty()) continue;
    reason = "level " + level->name + " has " + missing;
    plan.set_aside.insert(plan.set_aside.end(), level->set_aside.begin(), level->set_aside.end());
    lacking.push_back({"level " + level->name, "it has " + missing});
  }
  plan.set_aside = gathered(plan.set_aside);
  if (floors.empty()) {
    std::string aside;
    for (const SetAsideInput& item : plan.set_aside)
      aside += "\n  set aside: " + item.what + ": " + item.reason;
    throw InputError({path.string()}, "there is no floor to be had from this indoor plan: " + reason + aside,
                     "see https://wiki.openstreetmap.org/wiki/Simple_Indoor_Tagging or "
                     "https://docs.ogc.org/cs/20-094/ for how rooms and hallways are drawn");
  }
  // What concerns the whole plan is said once, with its first floor.
  FloorGroundTruth& first = floors.front().floor;
  first.set_aside.insert(first.set_aside.begin(), lacking.begin(), lacking.end());
  first.set_aside.insert(first.set_aside.begin(), plan.set_aside.begin(), plan.set_aside.end());
  first.remarks.insert(first.remarks.begin(), plan.remarks.begin(), plan.remarks.end());
  return floors;
}

IndoorFloor only_level(const std::filesystem::path& path, const IndoorOptions& options) {
  std::vector<IndoorFloor> floors = read_indoor(path, options);
  if (floors.size() > 1) {
    std::string names;
    for (const IndoorFloor& floor : floors) names += (names.empty() ? "" : ", ") + floor.floor.name;
    throw InputError({path.string()}, "the plan has " + std::to_string(floors.size()) + " levels: " + names,
                     "name one after a '#': '" + path.string() + "#1'");
  }
  return std::move(floors.front());
}

}  // namespace gramap
