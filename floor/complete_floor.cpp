#include "floor/complete_floor.h"

#include <cstdio>

#include "floor/fit_floor.h"
#include "floor/grow_hallways.h"
#include "floor/place.h"
#include "floor/spaces.h"
#include "geometry/error.h"
#include "geometry/polygon.h"
#include "grammar/fillable.h"

namespace gramap {
namespace {

constexpr double kGrid_m = 0.02;  // fine enough to tell whether anything fits

}  // namespace

std::vector<std::string> complete_floor(FloorGroundTruth& floor, const RuleSet& rules, std::uint64_t seed) {
  std::vector<std::string> said;
  if (!floor.spaces.empty()) return said;
  const RuleSet here = rules_on_floor(rules, floor);
  const double inner_m = here.inner_wall_m, outer_m = here.outer_wall_m;
  if (floor.hallways.empty() && rules.hallways && !floor.outline.empty()) {
    Polygon ring = grow_hallways(floor, *rules.hallways, inner_m, outer_m, seed);
    char text[160];
    std::snprintf(text, sizeof text, "hallways of %.1f m2 grown from the rules into %.1f m2 of outline",
                  signed_area(ring), signed_area(floor.outline));
    said.emplace_back(text);
    floor.hallways.push_back({"hallway", "Hallway", std::move(ring)});
  }
  const std::vector<std::string> derived = derive_spaces(floor, inner_m, outer_m);
  said.insert(said.end(), derived.begin(), derived.end());
  std::vector<Space> kept;
  for (const Space& space : floor.spaces) {
    const SpaceProblem problem = bare_problem(floor, outer_m, space);
    if (can_fill(here, problem, problem.length_m, kGrid_m)) {
      kept.push_back(space);
      continue;
    }
    char text[200];
    std::snprintf(text, sizeof text, "space '%s' is left solid: no derivation fills its %.2f m",
                  space.id.c_str(), problem.length_m);
    said.emplace_back(text);
  }
  if (kept.empty())
    throw InputError({}, "no derivation of the rules fills any of the spaces beside the hallways",
                     "see `gramap check --lengths`");
  floor.spaces = std::move(kept);
  return said;
}

}  // namespace gramap
