// What OpenStreetMap's simple indoor tagging and IMDF have in common: levels with areas and doors. Both are
// drawn by hand and by crowds, so a feature that cannot be used is set aside, by its name and with the
// reason, and the rest is read.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "floor/geojson.h"
#include "floor/ground_truth.h"

namespace gramap {

struct PlanUnit {
  enum class Use { room, hallway, fixed } use = Use::room;
  std::string id, type, name;
  std::string feature;  ///< where it stands in the file, for messages
  Polygon outline;
};

struct PlanDoor {
  std::string feature;
  Vec2 at = Vec2::Zero();
  double width_m = 0;  ///< 0: not known
};

struct PlanLevel {
  std::string name;                ///< as "#LEVEL" after a path means it
  std::set<std::string> also;      ///< other names for it: IMDF's id, short name
  std::optional<double> position;  ///< from below; levels without one come last, by name
  std::vector<PlanUnit> units;
  std::vector<PlanDoor> doors;
  std::vector<SetAsideInput> set_aside;
  std::vector<std::string> remarks;
};

struct IndoorPlan {
  std::string name;
  std::optional<GeoOrigin> origin;
  std::map<std::string, PlanLevel> levels;  ///< by the id that features refer to
  std::vector<SetAsideInput> set_aside;     ///< that belong to no level
  std::vector<std::string> remarks;
};

/// An OpenStreetMap extract as GeoJSON: https://wiki.openstreetmap.org/wiki/Simple_Indoor_Tagging
IndoorPlan read_osm(const GeoFile& file);

/// An IMDF archive, as a folder or a zip archive, or one file with features of all types:
/// https://docs.ogc.org/cs/20-094/. Throws InputError.
IndoorPlan read_imdf(const std::filesystem::path& path);

/// True for the name of a file in a zip archive that `read_imdf` reads.
bool is_imdf_file(const std::string& name);

/// "unit.geojson feature 7 ('b')".
std::string named(const GeoFile& file, const GeoFeature& feature);

/// Adds the feature's areas to a level, each part of a MultiPolygon as a unit of its own, `like` in all else.
/// A hallway with holes is cut into pieces; holes of other units are filled (a column, a void).
void add_areas(const GeoFile& file, const GeoFeature& feature, const PlanUnit& like, PlanLevel& level);

/// Leaves out what is drawn twice: areas with the same outline, doors at the same place.
void drop_repeated(PlanLevel& level);

/// Those with the same reason become one, which names the first few.
std::vector<SetAsideInput> gathered(const std::vector<SetAsideInput>& set_aside);

/// How often words came up: "wall 3, yes 2".
struct WordCount {
  std::map<std::string, int> counts;
  void add(const std::string& word) { ++counts[word]; }
  int total() const;
  std::string text() const;
};

/// The text with its first letter large and '_' for all that is no letter or digit: a room type's name.
std::string capitalised(std::string text);

}  // namespace gramap
