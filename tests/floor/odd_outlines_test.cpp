// Buildings of shapes that nobody prepared, with a hallway and shipped rules only: each becomes a model that
// passes the proof, and its rooms can be reached.
#include <doctest/doctest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "floor/complete_floor.h"
#include "floor/fit_floor.h"
#include "floor/place.h"
#include "floor/svg.h"
#include "floor/verify.h"
#include "geometry/file.h"
#include "grammar/language.h"
#include "tests/support/rectangle.h"

using namespace gramap;
using test::rectangle;

namespace {

struct OddFloor {
  std::string name;
  Polygon outline;
  std::vector<Polygon> hallways;
  double inner_wall_m = 0.15;
  double outer_wall_m = 0.35;
};

std::vector<OddFloor> odd_floors() {
  const Polygon bar = rectangle(0, 0, 40, 15), bent{{0, 0}, {30, 0}, {58, 20}, {50, 31.5}, {26, 14}, {0, 14}};
  return {
      {"a wedge, no two sides parallel",
       {{0, 0}, {48, 3}, {46, 9}, {8, 24}, {-2, 20}},
       {{{1.5, 6.2}, {42, 6.5}, {42, 8.3}, {1.5, 8.3}}}},
      {"a U",
       {{0, 0}, {50, 0}, {50, 40}, {36, 40}, {36, 14}, {14, 14}, {14, 40}, {0, 40}},
       {{{6, 6}, {44, 6}, {44, 34}, {42, 34}, {42, 8}, {8, 8}, {8, 34}, {6, 34}}}},
      {"a bent hallway", bent, {{{0.5, 6}, {28, 6}, {53, 23.5}, {51.9, 25.1}, {27.4, 8}, {0.5, 8}}}},
      {"two hallways that meet at an angle",
       bent,
       {rectangle(0.5, 6, 27, 8), {{27.15, 6}, {28, 6}, {53, 23.5}, {51.9, 25.1}, {27.4, 8}, {27.15, 8}}}},
      {"a cross",
       {{0, 12},
        {12, 12},
        {12, 0},
        {26, 0},
        {26, 12},
        {38, 12},
        {38, 26},
        {26, 26},
        {26, 38},
        {12, 38},
        {12, 26},
        {0, 26}},
       {{{0.5, 18},
         {18, 18},
         {18, 0.5},
         {20, 0.5},
         {20, 18},
         {37.5, 18},
         {37.5, 20},
         {20, 20},
         {20, 37.5},
         {18, 37.5},
         {18, 20},
         {0.5, 20}}}},
      {"walls like paper", bar, {rectangle(1, 6.5, 39, 8.5)}, 0.02, 0.03},
      {"walls of a fortress", bar, {rectangle(1.5, 6.5, 38.5, 8.5)}, 0.5, 1.2},
  };
}

std::size_t count(const std::string& text, const std::string& word) {
  std::size_t found = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++found;
  return found;
}

}  // namespace

TEST_CASE("floors of odd shapes, fitted without scans, pass the proof and leave hardly a room closed") {
  for (const char* file : {"rules/office_wing.grammar", "rules/hotel.grammar"}) {
    const std::filesystem::path path = std::filesystem::path(GRAMAP_SOURCE_DIR) / file;
    const RuleSet rules = *check_rules(read_file(path), path.string()).rules;
    for (const OddFloor& odd : odd_floors()) {
      CAPTURE(file);
      CAPTURE(odd.name);
      FloorGroundTruth floor;
      floor.name = odd.name;
      floor.outline = odd.outline;
      floor.inner_wall_m = odd.inner_wall_m;
      floor.outer_wall_m = odd.outer_wall_m;
      for (const Polygon& ring : odd.hallways)
        floor.hallways.push_back({"h" + std::to_string(floor.hallways.size()), "", ring});
      complete_floor(floor, rules, 1);
      std::vector<SetAsideInput> set_aside;
      FloorFitOptions options;
      options.space.grid_m = 0.05;
      const auto problems = space_problems(floor, rules, {}, options, set_aside);
      const FloorModel model = build_model(fit_floor(floor, rules, problems, {}, options));
      const VerifyReport report = verify(model);
      INFO(to_text(report));
      CHECK(report.ok());
      CHECK(report.totals.area_exact);
      // A room in a sharp corner may have no wall that is long enough for a door.
      CHECK(static_cast<int>(report.warnings.size()) * 20 <= report.totals.rooms);
      CHECK(report.totals.rooms >= 8);
      CHECK(report.totals.windows >= 8);
      const std::string svg = to_svg(model);
      CHECK(count(svg, "<clipPath ") == floor.spaces.size());
      CHECK(count(svg, "clip-path=\"url(#clip-") == floor.spaces.size());
    }
  }
}
