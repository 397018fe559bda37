#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <set>

#include "floor/indoor_plan.h"
#include "floor/zip.h"
#include "geometry/error.h"
#include "geometry/file.h"

namespace gramap {
namespace {

/// IMDF's unit categories (its reference, "Unit"); others are read by their name, with a remark.
const std::set<std::string> kHallways = {"walkway", "vegetation.walkway", "lobby", "foyer", "footbridge"};
const std::map<std::string, std::string> kFixed = {{"stairs", "Stairs"},      {"steps", "Stairs"},
                                                   {"elevator", "Lift"},      {"escalator", "Escalator"},
                                                   {"movingwalkway", "Ramp"}, {"ramp", "Ramp"}};
const std::set<std::string> kNoRooms = {"opentobelow", "column", "structure", "brick",
                                        "concrete",    "glass",  "drywall",   "wood"};
const std::set<std::string> kRooms = {
    "administration", "auditorium",   "classroom",   "conferenceroom", "fieldofplay",    "firstaid",
    "fitnessroom",    "foodservice",  "huddleroom",  "kitchen",        "laboratory",     "library",
    "lounge",         "mailroom",     "mothersroom", "movietheater",   "nonpublic",      "office",
    "parking",        "phoneroom",    "platform",    "privatelounge",  "recreation",     "restroom",
    "road",           "room",         "security",    "serverroom",     "shower",         "smokingarea",
    "storage",        "swimmingpool", "terrace",     "theater",        "unenclosedarea", "unspecified",
    "vegetation",     "waitingroom",  "walkway"};

PlanUnit unit_of(const GeoFeature& feature, const std::string& category) {
  PlanUnit unit;
  unit.id = text_of(feature.properties, "id");
  for (const auto& [key, value] : feature.properties)  // a name in any language
    if (key.starts_with("name.") && unit.name.empty()) unit.name = text_of(feature.properties, key);
  if (kHallways.contains(category)) {
    unit.use = PlanUnit::Use::hallway;
  } else if (const auto found = kFixed.find(category); found != kFixed.end()) {
    unit.use = PlanUnit::Use::fixed;
    unit.type = found->second;
  } else if (category.starts_with("restroom")) {
    unit.type = "WC";
  } else if (category != "room" && category != "unspecified") {
    unit.type = capitalised(category);
  }
  return unit;
}

struct Source {
  const GeoFile* file = nullptr;
  const GeoFeature* feature = nullptr;
};

/// The features of an archive by their type, whichever file they stand in.
struct Archive {
  std::vector<GeoFile> files;
  std::map<std::string, std::vector<Source>> by_type;
};

constexpr const char* kFiles[] = {"unit.geojson", "level.geojson", "opening.geojson"};

/// The archive's files that matter, by name: of a folder, or of a zip archive, in whatever folder in it.
std::map<std::string, std::string> texts_of(const std::filesystem::path& path) {
  std::map<std::string, std::string> texts;
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    for (const char* name : kFiles)
      if (std::filesystem::exists(path / name, ignored)) texts[name] = read_file(path / name);
    return texts;
  }
  for (auto& [name, text] : read_zip(path, is_imdf_file))
    texts.try_emplace(std::filesystem::path(name).filename().string(), std::move(text));
  return texts;
}

Archive read_archive(const std::filesystem::path& path, IndoorPlan& plan) {
  Archive archive;
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored) || is_zip(read_file(path))) {
    const std::map<std::string, std::string> texts = texts_of(path);
    if (!texts.contains("unit.geojson"))
      throw InputError({path.string()}, "the IMDF archive has no unit.geojson",
                       "IMDF keeps rooms as units there");
    for (const char* name : kFiles) {
      const auto text = texts.find(name);
      if (text == texts.end()) continue;
      archive.files.push_back(
          parse_geojson(text->second, (path / name).string(), plan.origin, GeoFaults::keep));
      if (!plan.origin) plan.origin = archive.files.back().origin;
    }
  } else {
    archive.files.push_back(read_geojson(path, std::nullopt, GeoFaults::keep));
    plan.origin = archive.files.back().origin;
  }
  for (const GeoFile& file : archive.files) {
    const std::string usual = std::filesystem::path(file.path).stem().string();
    WordCount misplaced;
    for (const GeoFeature& feature : file.features) {
      std::string type = text_of(feature.properties, "feature_type");
      if (type.empty()) type = usual;
      if (type != usual && archive.files.size() > 1) misplaced.add(type);
      archive.by_type[type].push_back({&file, &feature});
    }
    if (misplaced.total() > 0)
      plan.remarks.push_back(file.path +
                             " also holds other types, which are read as what they are: " + misplaced.text());
  }
  return archive;
}

void read_levels(const Archive& archive, IndoorPlan& plan) {
  const auto found = archive.by_type.find("level");
  if (found == archive.by_type.end()) return;
  std::map<std::string, int> ordinals;
  for (const auto& [file, feature] : found->second) {
    const std::string id = text_of(feature->properties, "id");
    if (id.empty() || plan.levels.contains(id)) {
      plan.set_aside.push_back(
          {named(*file, *feature), id.empty() ? "the level has no id" : "another level has its id"});
      continue;
    }
    PlanLevel& level = plan.levels[id];
    level.also.insert(id);
    for (const auto& [key, value] : feature->properties)
      if (key.starts_with("short_name.") || key.starts_with("name."))
        level.also.insert(text_of(feature->properties, key));
    level.name = text_of(feature->properties, "ordinal");
    const auto given = feature->properties.find("ordinal");
    const double* const ordinal =
        given == feature->properties.end() ? nullptr : std::get_if<double>(&given->second);
    if (ordinal) {
      level.position = *ordinal;
      ++ordinals[level.name];
    } else {
      level.remarks.push_back(named(*file, *feature) + " has no number as its ordinal: its level comes last");
      if (level.name.empty()) level.name = id;
    }
  }
  // Buildings of one venue have levels of the same ordinal each.
  for (auto& [id, level] : plan.levels)
    if (ordinals[level.name] > 1) level.name = id;
}

/// The levels that units name, for an archive that gives none; one when they name none.
void make_levels(const Archive& archive, IndoorPlan& plan) {
  if (const auto found = archive.by_type.find("unit"); found != archive.by_type.end())
    for (const auto& [file, feature] : found->second)
      if (const std::string id = text_of(feature->properties, "level_id"); !id.empty())
        plan.levels[id].name = id;
  if (plan.levels.empty()) plan.levels["0"].name = "0";
  plan.remarks.push_back("the archive gives no levels: they are those that units name, in their order");
}

/// The level that the feature names, or the plan's only one where it names none; null when there is no such
/// level, and the feature is set aside.
PlanLevel* level_of(const GeoFile& file, const GeoFeature& feature, IndoorPlan& plan) {
  const std::string id = text_of(feature.properties, "level_id");
  if (id.empty() && plan.levels.size() == 1) return &plan.levels.begin()->second;
  const auto found = plan.levels.find(id);
  if (found != plan.levels.end()) return &found->second;
  plan.set_aside.push_back({named(file, feature), id.empty()
                                                      ? "it has no level_id, and there are several levels"
                                                      : "its level_id '" + id + "' names no level"});
  return nullptr;
}

void read_units(const Archive& archive, IndoorPlan& plan) {
  const auto found = archive.by_type.find("unit");
  if (found == archive.by_type.end()) return;
  WordCount none, unknown;
  std::vector<SetAsideInput> uncategorised;
  for (const auto& [file, feature] : found->second) {
    const std::string category = text_of(feature->properties, "category");
    if (kNoRooms.contains(category)) {
      none.add(category);
      continue;
    }
    if (category.empty())
      uncategorised.push_back({named(*file, *feature), "no category"});
    else if (!kRooms.contains(category.substr(0, category.find('.'))) && !kHallways.contains(category) &&
             !kFixed.contains(category))
      unknown.add("'" + category + "'");
    if (PlanLevel* const level = level_of(*file, *feature, plan))
      add_areas(*file, *feature, unit_of(*feature, category), *level);
  }
  if (none.total() > 0) plan.remarks.push_back("units that are no rooms and not needed: " + none.text());
  if (unknown.total() > 0)
    plan.remarks.push_back("unit categories that IMDF does not know, read as types of rooms: " +
                           unknown.text());
  for (const SetAsideInput& item : gathered(uncategorised))
    plan.remarks.push_back("without a category, read as rooms of no type: " + item.what);
}

void read_openings(const Archive& archive, IndoorPlan& plan) {
  const auto found = archive.by_type.find("opening");
  if (found == archive.by_type.end()) return;
  for (const auto& [file, feature] : found->second) {
    PlanLevel* const level = level_of(*file, *feature, plan);
    if (!level) continue;
    const auto set_aside = [&, at = feature, in = file](const std::string& reason) {
      level->set_aside.push_back({named(*in, *at), reason});
    };
    if (!feature->fault.empty()) {
      set_aside(feature->fault);
    } else if (feature->geometry != "LineString" || feature->parts[0][0].size() < 2) {
      set_aside("an opening is a line, and it is " +
                (feature->geometry.empty() ? "without geometry" : "a " + feature->geometry));
    } else {
      const Polygon& line = feature->parts[0][0];
      const double width_m = (line.back() - line.front()).norm();
      if (width_m < 0.01)
        set_aside("its line has no length");
      else
        level->doors.push_back({named(*file, *feature), (line.front() + line.back()) / 2, width_m});
    }
  }
}

}  // namespace

bool is_imdf_file(const std::string& name) {
  if (name.starts_with("__MACOSX/")) return false;  // attributes of files, by their names
  const std::string file = std::filesystem::path(name).filename().string();
  return std::find(std::begin(kFiles), std::end(kFiles), file) != std::end(kFiles);
}

IndoorPlan read_imdf(const std::filesystem::path& given) {
  IndoorPlan plan;
  const std::filesystem::path path = given.filename() == "unit.geojson" ? given.parent_path() : given;
  const std::filesystem::path clean = std::filesystem::absolute(path).lexically_normal();
  plan.name = (clean.has_filename() ? clean : clean.parent_path()).stem().string();
  const Archive archive = read_archive(path, plan);
  read_levels(archive, plan);
  if (plan.levels.empty()) make_levels(archive, plan);
  read_units(archive, plan);
  read_openings(archive, plan);
  WordCount others;
  for (const auto& [type, sources] : archive.by_type)
    if (type != "unit" && type != "level" && type != "opening")
      for (std::size_t i = 0; i < sources.size(); ++i) others.add(type);
  if (others.total() > 0) plan.remarks.push_back("features of types that are not needed: " + others.text());
  return plan;
}

}  // namespace gramap
