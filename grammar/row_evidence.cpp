#include "grammar/row_evidence.h"

#include <algorithm>

namespace gramap {

SpaceProblem bare_problem(const KnownRow& row) {
  SpaceProblem problem;
  problem.id = row.space;
  problem.length_m = row.length_m;
  problem.hallway = row.hallway;
  for (const KnownRoom& room : row.rooms) problem.depth_m = std::max(problem.depth_m, room.depth_m);
  return problem;
}

std::vector<RoomEvidence> row_evidence(const KnownRow& row, double wall_m, double width_sigma_m,
                                       double place_sigma_m, double type_confidence) {
  std::vector<RoomEvidence> rooms;
  double start_m = 0;
  for (const KnownRoom& room : row.rooms) {
    RoomEvidence evidence;
    evidence.id = room.id;
    evidence.width_m = room.width_m;
    evidence.width_sigma_m = width_sigma_m;
    evidence.centre_m = start_m + room.width_m / 2;
    evidence.centre_sigma_m = place_sigma_m;
    if (type_confidence > 0 && !room.type.empty()) {
      evidence.type = room.type;
      evidence.type_confidence = type_confidence;
    }
    rooms.push_back(std::move(evidence));
    start_m += room.width_m + wall_m;
  }
  return rooms;
}

}  // namespace gramap
