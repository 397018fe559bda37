// Rows derived from a rule file, rules learned from these rows, rows derived from those: do they say the
// same?
#pragma once

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "geometry/file.h"
#include "grammar/derive.h"
#include "grammar/language.h"
#include "grammar/learn.h"

namespace gramap::test {

struct Tally {
  double count = 0, sum = 0, squares = 0;
  void add(double value) {
    count += 1;
    sum += value;
    squares += value * value;
  }
  double mean() const { return sum / count; }
  double standard_error() const {
    return std::sqrt(std::max(0.0, squares / count - mean() * mean()) / count);
  }
};

/// Of the difference of two means.
inline double standard_error(const Tally& a, const Tally& b) {
  return std::hypot(a.standard_error(), b.standard_error());
}

/// Rooms of a type at the hallway: how many in a row, how wide; as derived from the file and as learned.
struct TypeConsistency {
  std::string type;
  bool has_one_width = true;
  Tally rooms, rooms_again;
  Tally width_m, width_again_m;
};

struct Consistency {
  std::string text;  ///< the learned rule file
  double axis_m = 0;
  std::vector<Diagnostic> diagnostics;  ///< of either file
  std::vector<TypeConsistency> types;
};

/// `floors` rows of each of three lengths, and four times as many from the learned rules.
inline Consistency learn_back(const std::filesystem::path& path, int floors) {
  constexpr double kDepth_m = 5, kGrid_m = 0.02;
  Consistency found;
  const auto parsed = [&](const std::string& text, const std::string& name) {
    const CheckedRules checked = check_rules(text, name);
    found.diagnostics.insert(found.diagnostics.end(), checked.diagnostics.begin(), checked.diagnostics.end());
    if (!checked.rules) throw std::runtime_error(name + " has errors");
    return *checked.rules;
  };
  std::vector<SpaceProblem> spaces;
  for (const double length_m : {21, 34, 47}) {
    SpaceProblem& space = spaces.emplace_back();
    space.id = "S" + std::to_string(std::lround(length_m));
    space.length_m = length_m;
    space.depth_m = kDepth_m;
  }
  const std::string name = path.filename().string();
  const RuleSet rules = parsed(read_file(path), name);
  std::map<std::string, std::size_t> index;
  for (const RoomType& type : rules.rooms) {
    index[type.name] = found.types.size();
    found.types.push_back({type.name, type.width.components.size() < 2, {}, {}, {}, {}});
  }
  const auto count = [&](const Derivation& derivation, auto rooms, auto width_m) {
    std::vector<double> numbers(found.types.size(), 0);
    for (const PlacedRoom& room : derivation.rooms) {
      const auto type = index.find(room.type);
      if (room.depth_start_m > 0 || type == index.end()) continue;
      numbers[type->second] += 1;
      (found.types[type->second].*width_m).add(room.width_m);
    }
    for (std::size_t t = 0; t < numbers.size(); ++t) (found.types[t].*rooms).add(numbers[t]);
  };

  LearnData data;
  data.sources = {name};
  data.inner_wall_m = rules.inner_wall_m;
  for (const SpaceProblem& space : spaces) {
    const std::vector<Derivation> drawn = SpaceDeriver(rules, space, kGrid_m).draw(floors, 7);
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      count(drawn[i], &TypeConsistency::rooms, &TypeConsistency::width_m);
      KnownRow& row = data.rows.emplace_back();
      row.floor = "floor " + std::to_string(i);
      row.space = space.id;
      row.length_m = space.length_m;
      for (const PlacedRoom& room : drawn[i].rooms) {
        if (room.depth_start_m > 0) continue;  // behind another room
        KnownRoom& known = row.rooms.emplace_back();
        known.type = room.type == "Unknown" ? "" : room.type;
        known.width_m = room.width_m;
      }
    }
  }
  const LearnedRules learned = learn_rules(data);
  found.axis_m = learned.axis_m;
  found.text = to_text(learned);
  const RuleSet again = parsed(found.text, "learned from " + name);
  for (const SpaceProblem& space : spaces)
    for (const Derivation& derivation : SpaceDeriver(again, space, kGrid_m).draw(4 * floors, 11))
      count(derivation, &TypeConsistency::rooms_again, &TypeConsistency::width_again_m);
  return found;
}

}  // namespace gramap::test
