#include "floor/drawn_rooms.h"

#include <algorithm>

#include "floor/known_rows.h"
#include "grammar/row_evidence.h"

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
    for (RoomEvidence& room :
         row_evidence(row, data.inner_wall_m, kWidthSigma_m, kPlaceSigma_m, kTypeConfidence)) {
      if (std::any_of(problem->rooms.begin(), problem->rooms.end(),
                      [&](const RoomEvidence& known) { return known.id == room.id; }))
        continue;
      if (std::none_of(rules.rooms.begin(), rules.rooms.end(),
                       [&](const RoomType& type) { return type.name == room.type; })) {
        room.type.clear();
        room.type_confidence = 0;
      }
      problem->rooms.push_back(std::move(room));
    }
  }
}

}  // namespace gramap
