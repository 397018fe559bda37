#include "floor/drawn_rooms.h"

#include <algorithm>

#include "floor/known_rows.h"

namespace gramap {
namespace {

constexpr double kWidthSigma_m = 0.005, kPlaceSigma_m = 0.01, kTypeConfidence = 0.99;

}  // namespace

void observe_drawn_rooms(const FloorGroundTruth& floor, const FloorTruth& drawn, const RuleSet& rules,
                         std::vector<SpaceProblem>& problems) {
  const LearnData data = learn_data({floor}, {drawn});
  for (const KnownRow& row : data.rows) {
    const auto problem = std::find_if(problems.begin(), problems.end(),
                                      [&](const SpaceProblem& p) { return p.id == row.space; });
    if (problem == problems.end() || !row.whole) continue;
    double start_m = 0;
    for (const KnownRoom& room : row.rooms) {
      const auto same = [&](const RoomEvidence& known) { return known.id == room.id; };
      if (std::none_of(problem->rooms.begin(), problem->rooms.end(), same)) {
        RoomEvidence evidence;
        evidence.id = room.id;
        evidence.width_m = room.width_m;
        evidence.width_sigma_m = kWidthSigma_m;
        evidence.centre_m = start_m + room.width_m / 2;
        evidence.centre_sigma_m = kPlaceSigma_m;
        const bool is_known_type = std::any_of(rules.rooms.begin(), rules.rooms.end(),
                                               [&](const auto& type) { return type.name == room.type; });
        if (is_known_type) {
          evidence.type = room.type;
          evidence.type_confidence = kTypeConfidence;
        }
        problem->rooms.push_back(std::move(evidence));
      }
      start_m += room.width_m + data.inner_wall_m;
    }
  }
}

}  // namespace gramap
