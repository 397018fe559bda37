#include "floor/indoor_plan.h"

#include <algorithm>
#include <cmath>

#include "floor/cut_holes.h"
#include "floor/ring_check.h"
#include "geometry/polygon.h"

namespace gramap {
namespace {

Polygon counter_clockwise(Polygon ring) {
  if (signed_area(ring) < 0) std::reverse(ring.begin(), ring.end());
  return ring;
}

/// One polygon of a feature; the first ring is known to be simple.
void add_polygon(const std::vector<Polygon>& rings, const std::string& hole_of, const PlanUnit& like,
                 PlanLevel& level) {
  PlanUnit unit = like;
  unit.outline = counter_clockwise(without_repeats(rings[0]));
  std::vector<Polygon> holes;
  for (std::size_t i = 1; i < rings.size(); ++i) {
    const Polygon hole = counter_clockwise(without_repeats(rings[i]));
    if (!area_fault(hole)) holes.push_back(hole);
  }
  const bool faulty = holes.size() + 1 < rings.size() || holes_fault(unit.outline, holes);
  if (rings.size() > 1 && (faulty || unit.use != PlanUnit::Use::hallway)) {
    level.remarks.push_back(hole_of + (rings.size() > 2 ? ": its holes are" : ": its hole is") + " filled");
  } else if (rings.size() > 1) {
    std::vector<Polygon> pieces = cut_at_holes(unit.outline, holes);
    level.remarks.push_back(hole_of + (rings.size() > 2 ? ": cut at its holes" : ": cut at its hole") +
                            " into " + std::to_string(pieces.size()) + " pieces");
    for (Polygon& piece : pieces) {
      unit.outline = std::move(piece);
      level.units.push_back(unit);
    }
    return;
  }
  level.units.push_back(std::move(unit));
}

constexpr double kSame_m = 0.05;

bool same_border(const Polygon& a, const Polygon& b) {
  const auto on_border = [&](const Polygon& points, const Polygon& ring) {
    return std::all_of(points.begin(), points.end(),
                       [&](const Vec2& point) { return distance_to_border(ring, point) < kSame_m; });
  };
  return on_border(a, b) && on_border(b, a);
}

}  // namespace

std::string named(const GeoFile& file, const GeoFeature& feature) {
  return std::filesystem::path(file.path).filename().string() + " " + describe(feature);
}

void add_areas(const GeoFile& file, const GeoFeature& feature, const PlanUnit& like, PlanLevel& level) {
  const auto set_aside = [&](const std::string& reason) {
    level.set_aside.push_back({named(file, feature), reason});
  };
  if (!feature.fault.empty()) return set_aside(feature.fault);
  if (feature.geometry.empty()) return set_aside("it has no geometry");
  std::vector<std::vector<Polygon>> parts = feature.parts;
  if (feature.geometry == "LineString") {  // a closed way, by a converter that knows no areas
    if (parts[0][0].size() < 4 || (parts[0][0].front() - parts[0][0].back()).norm() > 1e-6)
      return set_aside("it is a line that does not end where it begins, and no area");
  } else if (feature.geometry != "Polygon" && feature.geometry != "MultiPolygon") {
    return set_aside("it is a " + feature.geometry + " and no area");
  }
  if (parts.empty()) return set_aside("its geometry is empty");
  if (parts.size() > 1)
    level.remarks.push_back(named(file, feature) + ": each of its " + std::to_string(parts.size()) +
                            " parts is an area of its own");
  PlanUnit unit = like;
  unit.feature = named(file, feature);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const std::string which = parts.size() == 1 ? "its polygon " : "its part " + std::to_string(i + 1) + " ";
    const Polygon ring = without_repeats(parts[i][0]);
    if (const auto fault = area_fault(ring))
      set_aside(which + *fault);
    else if (std::abs(signed_area(ring)) < 0.01)  // of one line, but for rounding
      set_aside(which + "encloses no area");
    else
      add_polygon(parts[i], unit.feature, unit, level);
  }
}

void drop_repeated(PlanLevel& level) {
  std::vector<PlanUnit> units;
  std::vector<Vec2> centres;
  for (PlanUnit& unit : level.units) {
    const Vec2 centre = centroid(unit.outline);
    std::size_t first = 0;
    while (first < units.size() &&
           ((centre - centres[first]).norm() > kSame_m || !same_border(unit.outline, units[first].outline)))
      ++first;
    if (first < units.size()) {
      level.set_aside.push_back({unit.feature, "it has the outline of " + units[first].feature});
      continue;
    }
    units.push_back(std::move(unit));
    centres.push_back(centre);
  }
  level.units = std::move(units);
  std::vector<PlanDoor> doors;
  for (PlanDoor& door : level.doors) {
    const auto first = std::find_if(doors.begin(), doors.end(),
                                    [&](const PlanDoor& other) { return (door.at - other.at).norm() < 0.1; });
    if (first == doors.end())
      doors.push_back(std::move(door));
    else
      level.set_aside.push_back({door.feature, "it is a door at the place of " + first->feature});
  }
  level.doors = std::move(doors);
}

std::vector<SetAsideInput> gathered(const std::vector<SetAsideInput>& set_aside) {
  constexpr std::size_t kNamed = 6;
  std::vector<std::string> reasons;
  std::map<std::string, std::vector<std::string>> by_reason;
  for (const SetAsideInput& item : set_aside) {
    std::vector<std::string>& names = by_reason[item.reason];
    if (names.empty()) reasons.push_back(item.reason);
    names.push_back(item.what);
  }
  std::vector<SetAsideInput> result;
  for (const std::string& reason : reasons) {
    const std::vector<std::string>& names = by_reason[reason];
    std::string what;
    for (std::size_t i = 0; i < std::min(names.size(), kNamed); ++i) what += (i ? ", " : "") + names[i];
    if (names.size() > kNamed) what += " and " + std::to_string(names.size() - kNamed) + " more";
    result.push_back({what, reason});
  }
  return result;
}

int WordCount::total() const {
  int sum = 0;
  for (const auto& [word, count] : counts) sum += count;
  return sum;
}

std::string WordCount::text() const {
  std::string text;
  for (const auto& [word, count] : counts)
    text += (text.empty() ? "" : ", ") + word + " " + std::to_string(count);
  return text;
}

std::string capitalised(std::string text) {
  for (char& letter : text)
    if (!std::isalnum(static_cast<unsigned char>(letter))) letter = '_';
  if (!text.empty()) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text;
}

}  // namespace gramap
