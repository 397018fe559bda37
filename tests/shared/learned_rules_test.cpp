// Rules learned from each floor of real buildings: what a person gets to read is a file without faults that
// `fmt` leaves alone, makes every row that it was learned from, and derives floors like the building.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "floor/drawn_floor.h"
#include "floor/known_rows.h"
#include "floor/read_indoor.h"
#include "grammar/diagnostic.h"
#include "grammar/format.h"
#include "grammar/language.h"
#include "grammar/learn.h"
#include "grammar/likelihood.h"
#include "grammar/row_evidence.h"
#include "tests/shared/shared_data.h"

using namespace gramap;

namespace {

struct Floor {
  FloorGroundTruth floor;
  FloorTruth truth;
};

std::vector<Floor> real_floors() {
  std::vector<Floor> floors;
  for (const char* name : {"institute-1og", "institute-2og"})
    if (const auto folder = test::shared_data(name))
      floors.push_back({read_floor(*folder), read_truth(*folder)});
  for (const char* name : {"apb/level0.geojson", "apb/level1.geojson", "apb/level2.geojson"})
    if (const auto file = test::shared_data(name)) {
      IndoorFloor level = only_level(*file);
      floors.push_back({std::move(level.floor), std::move(level.truth)});
    }
  return floors;
}

}  // namespace

TEST_CASE("rules learned from a real floor are clean, canonical, and make floors like it") {
  for (const auto& [floor, truth] : real_floors()) {
    CAPTURE(floor.name);
    const LearnData data = learn_data({floor}, {truth});
    const std::string text = to_text(learn_rules(data, {}));
    const CheckedRules checked = check_rules(text, "learned");
    INFO(render(checked.diagnostics, text, "learned"));
    CHECK(checked.diagnostics.empty());
    REQUIRE(checked.rules);
    CHECK(format_rules(text).text == text);

    double rooms = 0, widths_m = 0;
    FitOptions options;
    options.grid_m = 0.1;
    FloorGroundTruth whole = floor;  // with the spaces alone whose rooms are all known
    whole.spaces.clear();
    for (const KnownRow& row : data.rows) {
      if (!row.whole) continue;
      CAPTURE(row.space);
      SpaceProblem problem = bare_problem(row);
      problem.rooms = row_evidence(row, data.inner_wall_m, 0.05, 0.05);
      CHECK(std::isfinite(log_likelihood(*checked.rules, problem, options)));
      rooms += static_cast<double>(row.rooms.size());
      for (const KnownRoom& room : row.rooms) widths_m += room.width_m;
      for (const Space& space : floor.spaces)
        if (space.id == row.space) whole.spaces.push_back(space);
    }
    constexpr int kDraws = 3;
    double derived_rooms = 0, derived_widths_m = 0;
    for (int seed = 1; seed <= kDraws; ++seed)
      for (const FittedRoom& room :
           drawn_floor(whole, *checked.rules, static_cast<std::uint64_t>(seed)).rooms) {
        derived_rooms += 1;
        derived_widths_m += room.width_m;
      }
    CHECK(derived_rooms / kDraws == doctest::Approx(rooms).epsilon(0.2));
    CHECK(derived_widths_m / derived_rooms == doctest::Approx(widths_m / rooms).epsilon(0.2));
  }
}
