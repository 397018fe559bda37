#include "floor/missed_wall.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "geometry/say.h"

namespace gramap {
namespace {

double log_gauss(double x, double mean, double sd) {
  const double u = (x - mean) / sd;
  return -0.5 * u * u - std::log(sd * std::sqrt(2 * std::numbers::pi));
}

int doors_of(const SpaceProblem& problem, const PlacedRoom& room) {
  return static_cast<int>(
      std::count_if(problem.doors.begin(), problem.doors.end(), [&](const DoorEvidence& door) {
        return room.start_m < door.centre_m && door.centre_m < room.start_m + room.width_m;
      }));
}

/// Scans that may be of two rooms, by index, in order: no room of the rules explains them, or the hallway
/// shows two doors to the room that does.
std::vector<int> doubtful(const SpaceProblem& problem, const SpaceFit& fit) {
  std::vector<int> found;
  for (const SetAside& aside : fit.set_aside) found.push_back(aside.evidence);
  for (const PlacedRoom& room : fit.best.rooms)
    if (room.rule == "background" || doors_of(problem, room) >= 2)
      found.insert(found.end(), room.evidence.begin(), room.evidence.end());
  std::erase_if(found, [&](int scan) {
    const RoomEvidence& e = problem.rooms[static_cast<std::size_t>(scan)];
    return !e.centre_m || e.other_width_m;
  });
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

struct Pair {
  std::size_t first = 0;  ///< index of the first room
  double log_density = 0;
};

/// The two neighbours that explain the scan best when they are read as one.
std::optional<Pair> best_pair(const Layout& layout, const RoomEvidence& scan) {
  std::optional<Pair> best;
  for (std::size_t i = 0; i + 1 < layout.rooms.size(); ++i) {
    const PlacedRoom &a = layout.rooms[i], &b = layout.rooms[i + 1];
    if (a.depth_m >= 0 || b.depth_m >= 0) continue;  // one behind the other
    const double end = b.start_m + b.width_m;
    const double sigma = std::hypot(a.start_sigma_m, b.end_sigma_m);
    const double density =
        log_gauss(scan.width_m, end - a.start_m, std::hypot(scan.width_sigma_m, sigma)) +
        log_gauss(*scan.centre_m, 0.5 * (a.start_m + end), std::hypot(scan.centre_sigma_m, 0.5 * sigma));
    if (!best || density > best->log_density) best = Pair{i, density};
  }
  return best;
}

/// Evidence is counted as if the one at `taken_out` were there again.
void put_back(SpaceFit& fit, int taken_out) {
  const auto shift = [&](int& evidence) { evidence += evidence >= taken_out ? 1 : 0; };
  for (PlacedRoom& room : fit.best.rooms)
    for (int& evidence : room.evidence) shift(evidence);
  for (Layout& layout : fit.alternatives)
    for (PlacedRoom& room : layout.rooms)
      for (int& evidence : room.evidence) shift(evidence);
  for (SetAside& aside : fit.set_aside) shift(aside.evidence);
  for (Reinterpreted& note : fit.reinterpreted) shift(note.evidence);
}

}  // namespace

double evidence_score(const SpaceFit& fit) {
  return fit.best.score - std::log(fit.best.probability);
}

SpaceFit with_missed_walls(const RuleSet& rules, const SpaceProblem& problem, const FitOptions& options,
                           SpaceFit fit) {
  for (const int scan : doubtful(problem, fit)) {
    const RoomEvidence& read = problem.rooms[static_cast<std::size_t>(scan)];
    SpaceProblem without = problem;
    without.rooms.erase(without.rooms.begin() + scan);
    SpaceFit two = fit_space(rules, without, options);
    const std::optional<Pair> pair = best_pair(two.best, read);
    if (!pair) continue;
    const double share = (1 - options.outlier_share) * options.missed_wall_share;
    if (two.best.score + std::log(share) + pair->log_density <= evidence_score(fit)) continue;
    put_back(two, scan);
    for (const std::size_t room : {pair->first, pair->first + 1}) {
      std::vector<int>& evidence = two.best.rooms[room].evidence;
      evidence.insert(std::lower_bound(evidence.begin(), evidence.end(), scan), scan);
    }
    two.best.score += std::log(share) + pair->log_density;
    two.reinterpreted.push_back(
        {scan, "read as one room of " + said_metres(read.width_m) + ", but it is two: a wall was missed"});
    return two;  // one missed wall a space; a second scan like it stays as it was read
  }
  return fit;
}

}  // namespace gramap
