#include "floor/missed_wall.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

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

/// What is to be added to the score of a layout whose two neighbours explain the scan by their outer walls,
/// each by itself, to hold them against its width and centre instead; none when no two neighbours do.
std::optional<double> width_for_walls(const Layout& layout, const RoomEvidence& scan, int index) {
  const auto explains = [&](const PlacedRoom& room) {
    return std::find(room.evidence.begin(), room.evidence.end(), index) != room.evidence.end();
  };
  const auto a = std::find_if(layout.rooms.begin(), layout.rooms.end(), explains);
  if (a == layout.rooms.end() || a + 1 == layout.rooms.end() || !explains(*(a + 1))) return std::nullopt;
  const PlacedRoom& b = *(a + 1);
  const double start = a->start_m, end = b.start_m + b.width_m;
  const double sigma = std::hypot(a->start_sigma_m, b.end_sigma_m);
  const double wall_sigma = std::hypot(scan.centre_sigma_m, 0.5 * scan.width_sigma_m);
  return log_gauss(scan.width_m, end - start, std::hypot(scan.width_sigma_m, sigma)) +
         log_gauss(*scan.centre_m, 0.5 * (start + end), std::hypot(scan.centre_sigma_m, 0.5 * sigma)) -
         log_gauss(*scan.centre_m - 0.5 * scan.width_m, start, wall_sigma) -
         log_gauss(*scan.centre_m + 0.5 * scan.width_m, end, wall_sigma);
}

}  // namespace

double evidence_score(const SpaceFit& fit) {
  return fit.best.score - std::log(fit.best.probability);
}

SpaceFit with_missed_walls(const RuleSet& rules, const SpaceProblem& problem, const FitOptions& options,
                           SpaceFit fit) {
  for (const int scan : doubtful(problem, fit)) {
    SpaceProblem supposed = problem;
    RoomEvidence& read = supposed.rooms[static_cast<std::size_t>(scan)];
    read.of_two_rooms = true;
    SpaceFit two = fit_space(rules, supposed, options);
    const std::optional<double> gain = width_for_walls(two.best, read, scan);
    if (!gain || two.best.score + *gain <= evidence_score(fit)) continue;
    two.best.score += *gain;
    return two;  // one missed wall a space; a second scan like it stays as it was read
  }
  return fit;
}

}  // namespace gramap
