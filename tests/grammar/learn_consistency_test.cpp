// Learning is consistent: rows derived from a shipped rule file give back rules that promise the same.
//
// GRAMAP_CONSISTENCY_FLOORS sets how many floors are derived from each file (a few by default; 200 for the
// figures of the quality table).
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "geometry/file.h"
#include "grammar/derive.h"
#include "grammar/format.h"
#include "grammar/language.h"
#include "grammar/learn.h"

using namespace gramap;

namespace {

const std::vector<double> kLengths_m = {21, 34, 47};
constexpr double kDepth_m = 5;
/// A chain of rooms does not know of conditions on the length that is left, nor of bounds on repeats: numbers
/// of rooms may differ by this share for it.
constexpr double kChain = 0.05;

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

SpaceProblem bare(double length_m) {
  SpaceProblem problem;
  problem.id = "S" + std::to_string(std::lround(length_m));
  problem.length_m = length_m;
  problem.depth_m = kDepth_m;
  return problem;
}

RuleSet parsed(const std::string& text, const std::string& name) {
  const CheckedRules checked = check_rules(text, name);
  for (const Diagnostic& diagnostic : checked.diagnostics) MESSAGE(diagnostic.message);
  CHECK(checked.diagnostics.empty());
  REQUIRE(checked.rules);
  return *checked.rules;
}

/// What a row shows at the hallway: how many rooms of each type, how wide.
struct RowStatistics {
  std::map<std::string, Tally> rooms, width_m;  // per row; per room
};

void count(const std::vector<PlacedRoom>& rooms, const std::vector<std::string>& types, RowStatistics& sums) {
  std::map<std::string, double> numbers;
  for (const std::string& type : types) numbers[type];
  for (const PlacedRoom& room : rooms) {
    if (room.depth_start_m > 0) continue;
    numbers[room.type] += 1;
    sums.width_m[room.type].add(room.width_m);
  }
  for (const auto& [type, number] : numbers) sums.rooms[type].add(number);
}

int floors_to_derive() {
  const char* const asked = std::getenv("GRAMAP_CONSISTENCY_FLOORS");
  return asked ? std::max(2, std::atoi(asked)) : 30;
}

}  // namespace

TEST_CASE("rules learned from derived floors promise what the rules promised that the floors came from") {
  const int floors = floors_to_derive();
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(GRAMAP_SOURCE_DIR "/rules")) {
    if (entry.path().extension() != ".grammar") continue;
    const std::string name = entry.path().filename().string();
    CAPTURE(name);
    const RuleSet rules = parsed(read_file(entry.path()), name);
    std::vector<std::string> types;
    for (const RoomType& type : rules.rooms) types.push_back(type.name);
    ++files;

    LearnData data;
    data.sources = {name};
    data.inner_wall_m = rules.inner_wall_m;
    std::map<double, std::vector<Derivation>> derived;
    for (const double length_m : kLengths_m) {
      derived[length_m] = SpaceDeriver(rules, bare(length_m), 0.02).draw(floors, 7);
      const std::vector<Derivation>& drawn = derived[length_m];
      for (std::size_t i = 0; i < drawn.size(); ++i) {
        KnownRow row;
        row.floor = "floor " + std::to_string(i);
        row.space = bare(length_m).id;
        row.length_m = length_m;
        for (const PlacedRoom& room : drawn[i].rooms) {
          if (room.depth_start_m > 0) continue;  // behind another room
          KnownRoom known;
          known.type = room.type == "Unknown" ? "" : room.type;
          known.width_m = room.width_m;
          row.rooms.push_back(known);
        }
        data.rows.push_back(row);
      }
    }
    const LearnedRules learned = learn_rules(data);
    const std::string text = to_text(learned);
    CHECK(format_rules(text).text == text);
    const RuleSet again = parsed(text, "learned from " + name);
    RowStatistics truth, now;
    for (const double length_m : kLengths_m) {
      for (const Derivation& derivation : derived[length_m]) count(derivation.rooms, types, truth);
      for (const Derivation& derivation : SpaceDeriver(again, bare(length_m), 0.02).draw(4 * floors, 11))
        count(derivation.rooms, types, now);
    }
    for (const RoomType& room_type : rules.rooms) {
      const std::string& type = room_type.name;
      CAPTURE(type);
      const Tally &rooms = truth.rooms[type], &rooms_now = now.rooms[type];
      CHECK(std::abs(rooms.mean() - rooms_now.mean()) <=
            4 * std::hypot(rooms.standard_error(), rooms_now.standard_error()) + kChain * rooms.mean());
      const Tally &width = truth.width_m[type], &width_now = now.width_m[type];
      if (width.count < 5 || width_now.count < 5) continue;
      // How often which of a type's widths is used is a matter of numbers of rooms again.
      const double slack_m = room_type.width.components.size() > 1 ? kChain * width.mean() : 0.02;
      CHECK(std::abs(width.mean() - width_now.mean()) <=
            4 * std::hypot(width.standard_error(), width_now.standard_error()) + slack_m);
    }
  }
  CHECK(files >= 7);
}
