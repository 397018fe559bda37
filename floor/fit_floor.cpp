#include "floor/fit_floor.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <map>
#include <set>

#include "floor/furnish.h"
#include "floor/fuse.h"
#include "floor/missed_wall.h"
#include "geometry/error.h"
#include "geometry/polygon.h"
#include "grammar/like_scanned.h"
#include "grammar/likelihood.h"

namespace gramap {
namespace {

/// Rooms that a space's shape leaves less of are left out.
constexpr double kLeastDepth_m = 0.1;

/// The part of a ring on the side of a line where (p - at)·normal >= 0 (Sutherland–Hodgman).
Polygon clipped(const Polygon& ring, const Vec2& at, const Vec2& normal) {
  Polygon kept;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 &a = ring[i], &b = ring[(i + 1) % ring.size()];
    const double da = (a - at).dot(normal), db = (b - at).dot(normal);
    if (da >= 0) kept.push_back(a);
    if ((da > 0 && db < 0) || (da < 0 && db > 0)) kept.push_back(a + (b - a) * (da / (da - db)));
  }
  return kept;
}

double storey_height(const FloorGroundTruth& floor, const RuleSet& rules,
                     const std::vector<RoomObservation>& observations) {
  if (floor.ceiling_height_m) return *floor.ceiling_height_m;
  std::vector<double> heights;
  for (const RoomObservation& room : observations)
    if (room.height.value_m > 0) heights.push_back(room.height.value_m);
  if (heights.empty()) return rules.height_m;
  std::nth_element(heights.begin(), heights.begin() + static_cast<std::ptrdiff_t>(heights.size() / 2),
                   heights.end());
  return heights[heights.size() / 2];
}

FittedRoom given_room(const std::string& id, const std::string& name, const std::string& type,
                      const Polygon& outline, double height) {
  FittedRoom room;
  room.id = id;
  room.name = name.empty() ? id : name;
  room.type = type;
  room.origin = Origin::given;
  room.outline = outline;
  const OrientedBox box = oriented_box(outline);
  room.width_m = box.length_m;
  room.depth_m = box.breadth_m;
  room.height_m = height;
  return room;
}

/// Names that are taken, so that every room gets one of its own.
std::string unique_id(const std::string& wanted, std::set<std::string>& taken) {
  std::string id = wanted;
  for (int suffix = 2; !taken.insert(id).second; ++suffix) id = wanted + "_" + std::to_string(suffix);
  return id;
}

/// Says which scans of a space, whose rooms begin at `first_room`, can't be what their folders' names say:
/// one room scanned under two names, and one name's scans in two rooms.
void name_misfiled(FittedFloor& fitted, std::size_t first_room, const SpaceProblem& problem,
                   const SpaceFit& fit) {
  std::set<int> reread;  // a scan of two rooms at once lies in both
  for (const Reinterpreted& note : fit.reinterpreted) reread.insert(note.evidence);
  std::map<std::string, std::size_t> room_of;
  for (std::size_t r = 0; r < fit.best.rooms.size(); ++r) {
    std::set<std::string> names;
    for (const int evidence : fit.best.rooms[r].evidence)
      if (!reread.count(evidence)) names.insert(problem.rooms[static_cast<std::size_t>(evidence)].id);
    for (const std::string& name : names) {
      if (name != *names.begin())
        fitted.floor.remarks.push_back(*names.begin() + " and " + name +
                                       " are scans of one room: one is filed under the wrong name");
      const auto [first, is_new] = room_of.emplace(name, r);
      if (!is_new)
        fitted.floor.remarks.push_back(
            name + ": its scans are of two rooms, " + fitted.rooms[first_room + first->second].id + " and " +
            fitted.rooms[first_room + r].id + ": some are filed under the wrong name");
    }
  }
}

void add_space(FittedFloor& fitted, const Space& space, const SpaceProblem& problem, const SpaceFit& fit,
               std::set<std::string>& taken) {
  FittedSpace summary;
  summary.id = space.id;
  summary.length_m = problem.length_m;
  summary.score = fit.best.score;
  summary.probability = fit.best.probability;
  for (const Layout& layout : fit.alternatives) {
    FittedSpace::Alternative alternative{layout.score, layout.probability, {}, {}};
    for (const PlacedRoom& room : layout.rooms) {
      alternative.types.push_back(room.type);
      alternative.widths_m.push_back(room.width_m);
    }
    summary.alternatives.push_back(alternative);
  }
  fitted.spaces.push_back(summary);

  const std::size_t first_room = fitted.rooms.size();
  int number = 0;
  for (const PlacedRoom& placed : fit.best.rooms) {
    ++number;
    FittedRoom room;
    room.space = space.id;
    room.type = placed.type;
    room.start_m = placed.start_m;
    room.width_m = placed.width_m;
    room.width_sigma_m = placed.width_sigma_m;
    room.start_sigma_m = placed.start_sigma_m;
    room.end_sigma_m = placed.end_sigma_m;
    room.type_probability = placed.type_probability;
    room.room_probability = placed.room_probability;
    room.rule = placed.rule;
    room.rule_path = placed.rule_path;
    room.height_m = fitted.height_m;
    // The last cut is the space's own end, the very same number.
    const bool last = &placed == &fit.best.rooms.back();
    room.outline = slab(space, placed.start_m, last ? problem.length_m : placed.start_m + placed.width_m);
    const Vec2 along = (space.end - space.start).normalized(), left(-along.y(), along.x());
    if (placed.depth_m >= 0) {  // one of several rooms one behind the other
      const Vec2 near = space.start + placed.depth_start_m * left;
      room.outline = clipped(clipped(room.outline, near, left), near + placed.depth_m * left, -left);
    }
    if (room.outline.size() < 3 || oriented_box(room.outline).breadth_m < kLeastDepth_m) {
      const std::string what = "room " + std::to_string(number) + " of space '" + space.id + "' (" +
                               room.type + ") has no place: the space is not deep enough there";
      fitted.floor.remarks.push_back(what);
      for (const int index : placed.evidence)
        fitted.set_aside.push_back({problem.rooms[static_cast<std::size_t>(index)].id, what});
      continue;
    }
    for (const Vec2& point : room.outline)
      room.depth_m = std::max(room.depth_m, (point - space.start).dot(left) - placed.depth_start_m);
    for (const int index : placed.evidence) {
      const RoomEvidence& evidence = problem.rooms[static_cast<std::size_t>(index)];
      room.origin = Origin::observed;
      room.scans.push_back(evidence.id);
      if (room.extracted_width_m) continue;
      room.extracted_width_m =
          placed.swapped && evidence.other_width_m ? *evidence.other_width_m : evidence.width_m;
      room.extracted_sigma_m =
          placed.swapped && evidence.other_width_m ? evidence.other_sigma_m : evidence.width_sigma_m;
    }
    room.id =
        unique_id(room.scans.empty() ? space.id + "_" + std::to_string(number) : room.scans.front(), taken);
    room.name = room.id;
    fitted.rooms.push_back(room);
  }
  name_misfiled(fitted, first_room, problem, fit);
  for (const Reinterpreted& note : fit.reinterpreted)
    fitted.floor.remarks.push_back(problem.rooms[static_cast<std::size_t>(note.evidence)].id + ": " +
                                   note.how);
  for (const SetAside& aside : fit.set_aside)
    fitted.set_aside.push_back({problem.rooms[static_cast<std::size_t>(aside.evidence)].id, aside.reason});
}

/// What of the floor is known before any space is fitted.
FittedFloor given_floor(const FloorGroundTruth& floor, const RuleSet& rules, double height_m) {
  FittedFloor fitted;
  fitted.floor = floor;
  const RuleSet here = rules_on_floor(rules, floor);
  fitted.inner_wall_m = here.inner_wall_m;
  fitted.outer_wall_m = here.outer_wall_m;
  fitted.height_m = height_m;
  for (const Hallway& hallway : floor.hallways)
    fitted.hallways.push_back(given_room(hallway.id, hallway.name, "Hallway", hallway.outline, height_m));
  for (const FixedRoom& fixed : floor.fixed)
    fitted.fixed.push_back(given_room(fixed.id, fixed.name, fixed.type, fixed.outline, height_m));
  return fitted;
}

/// The fit of a space; when it has to set scans aside or read them unusually, also under the assumption that
/// the building is not as exact as the rules (walls of unequal thickness, rooms askew), so that the widths of
/// a row of scanned rooms need not add up to its length to the centimetre. The more probable of the readings
/// is taken (type II maximum likelihood over the misfit, with what is thought of each beforehand).
SpaceFit fit_forgiving(const RuleSet& rules, const SpaceProblem& problem, const FitOptions& options) {
  struct Misfit {
    double sigma_m, prior;
  };
  constexpr Misfit kMisfits[] = {{0.02, 0.1}, {0.06, 0.02}};
  SpaceFit best = with_missed_walls(rules, problem, options, fit_space(rules, problem, options));
  if (best.set_aside.empty() && best.reinterpreted.empty()) return best;
  double best_score = evidence_score(best);
  for (const Misfit& misfit : kMisfits) {
    SpaceProblem loose = problem;
    for (RoomEvidence& room : loose.rooms) {
      room.width_sigma_m = std::hypot(room.width_sigma_m, misfit.sigma_m);
      room.other_sigma_m = std::hypot(room.other_sigma_m, misfit.sigma_m);
    }
    SpaceFit fit = fit_space(rules, loose, options);
    const double score = evidence_score(fit) + std::log(misfit.prior);
    if (score <= best_score) continue;
    best = std::move(fit);
    best_score = score;
  }
  return best;
}

void add_spaces(FittedFloor& fitted, const std::vector<SpaceProblem>& problems,
                const std::vector<SpaceFit>& fits) {
  std::set<std::string> taken;
  for (const FittedRoom& room : fitted.hallways) taken.insert(room.id);
  for (const FittedRoom& room : fitted.fixed) taken.insert(room.id);
  for (std::size_t i = 0; i < problems.size(); ++i)
    add_space(fitted, fitted.floor.spaces[i], problems[i], fits[i], taken);
}

void fit_spaces(FittedFloor& fitted, const RuleSet& rules, const std::vector<SpaceProblem>& problems,
                const FitOptions& options) {
  std::vector<SpaceFit> fits(problems.size());
  std::vector<std::exception_ptr> faults(problems.size());
  tbb::parallel_for(std::size_t{0}, problems.size(), [&](std::size_t i) {
    try {
      fits[i] = fit_forgiving(rules, problems[i], options);
    } catch (...) {
      faults[i] = std::current_exception();
    }
  });
  for (const std::exception_ptr& fault : faults)
    if (fault) std::rethrow_exception(fault);  // the first space in file order, whichever thread was first

  add_spaces(fitted, problems, fits);
}

/// ln p(evidence, length | rules) on a grid no finer than `grid_m`, which is enough to choose between
/// readings of a hallway; minus infinity when the space can't be filled.
double quick_likelihood(const RuleSet& rules, const SpaceProblem& problem, FitOptions options,
                        double grid_m) {
  options.grid_m = std::max(options.grid_m, grid_m);
  try {
    return log_joint(rules, problem, options);
  } catch (const InputError&) {
    return -std::numeric_limits<double>::infinity();
  }
}

/// The problem with what a hallway shows of its space.
SpaceProblem with_shown(SpaceProblem problem, const SpaceProblem& shown) {
  problem.doors.insert(problem.doors.end(), shown.doors.begin(), shown.doors.end());
  problem.doors_visible.insert(problem.doors_visible.end(), shown.doors_visible.begin(),
                               shown.doors_visible.end());
  return problem;
}

/// The same of all spaces that the hallway shows the wall of.
double score_of(const RuleSet& rules, const std::vector<SpaceProblem>& problems,
                const std::vector<SpaceProblem>& shown, const FitOptions& options) {
  constexpr double grid_m = 0.05;
  double score = 0;
  for (std::size_t i = 0; i < problems.size(); ++i)
    if (!shown[i].doors_visible.empty())
      score += quick_likelihood(rules, with_shown(problems[i], shown[i]), options, grid_m);
  return score;
}

/// Doors from every scanned hallway and fixed room. One in a frame of its own may fit its given outline two
/// ways round: the way is taken that the rules and the rooms beside it make more probable.
void add_doors(const FloorGroundTruth& floor, const RuleSet& rules,
               const std::vector<RoomObservation>& observations, const Placement& placement,
               std::vector<SpaceProblem>& problems, const FloorFitOptions& options) {
  for (const PlacedObservation& placed : placement.placed) {
    if (placed.on == PlacedObservation::On::space) continue;
    const RoomObservation& hallway = observations[static_cast<std::size_t>(placed.observation)];
    const auto index = static_cast<std::size_t>(placed.index);
    const Polygon& given = placed.on == PlacedObservation::On::hallway ? floor.hallways[index].outline
                                                                       : floor.fixed[index].outline;
    const std::vector<PlanMotion> motions =
        hallway_motions(hallway, given, !lies_on(hallway.outline, given, options.placement));
    std::vector<SpaceProblem> best;
    double best_score = -std::numeric_limits<double>::infinity();
    for (const PlanMotion& motion : motions) {
      std::vector<SpaceProblem> shown(problems.size());
      add_door_evidence(floor, hallway, motion, shown, options.doors);
      const double score = motions.size() > 1 ? score_of(rules, problems, shown, options.space) : 0;
      if (score <= best_score && !best.empty()) continue;
      best_score = score;
      best = std::move(shown);
    }
    for (std::size_t i = 0; i < best.size(); ++i)
      if (!best[i].doors_visible.empty()) problems[i] = with_shown(std::move(problems[i]), best[i]);
  }
}

/// How many rooms show no door to a hallway depends on the walk: who passes closed doors flush with the wall
/// sees few. Of three shares, with what is thought of each beforehand, the one is taken under which the floor
/// is most probable. A share that the spaces so far make a thousand times less probable than the best is out
/// of the race (Wald's sequential test), so that a large floor is not asked as a whole.
FitOptions with_doorless_share(const RuleSet& rules, const std::vector<SpaceProblem>& problems,
                               FitOptions options) {
  struct Share {
    double doorless, score;
  };
  std::vector<Share> shares = {{0.003, std::log(0.80)}, {0.03, std::log(0.16)}, {0.2, std::log(0.04)}};
  const double sure = std::log(1000);
  constexpr std::size_t kBatch = 8;  // spaces, whatever the threads
  constexpr double grid_m = 0.1;     // what counts is which rooms show a door, not just where
  std::vector<const SpaceProblem*> shown;
  for (const SpaceProblem& problem : problems)
    if (!problem.doors_visible.empty()) shown.push_back(&problem);
  if (shown.empty()) return options;
  const auto likelier = [](const Share& a, const Share& b) { return a.score < b.score; };
  for (std::size_t begin = 0; begin < shown.size() && shares.size() > 1; begin += kBatch) {
    const std::size_t count = shares.size();
    // Each space by itself, so that the sum does not depend on the threads.
    std::vector<double> likelihoods(count * std::min(kBatch, shown.size() - begin), 0);
    tbb::parallel_for(std::size_t{0}, likelihoods.size(), [&](std::size_t i) {
      FitOptions tried = options;
      tried.doorless_share = shares[i % count].doorless;
      likelihoods[i] = quick_likelihood(rules, *shown[begin + i / count], tried, grid_m);
    });
    for (std::size_t i = 0; i < likelihoods.size(); ++i)
      if (std::isfinite(likelihoods[i]))
        shares[i % count].score += likelihoods[i];  // else the fit itself will say so
    const double best = std::max_element(shares.begin(), shares.end(), likelier)->score;
    std::erase_if(shares, [&](const Share& share) { return share.score < best - sure; });
  }
  options.doorless_share = std::max_element(shares.begin(), shares.end(), likelier)->doorless;
  return options;
}

}  // namespace

Polygon slab(const Space& space, double start_m, double end_m) {
  const Vec2 along = (space.end - space.start).normalized();
  const double length = clear_length_m(space);
  Polygon piece = space.outline;
  // At the space's own ends nothing is cut, so that its border is kept to the last digit.
  if (start_m > 0) piece = clipped(piece, space.start + along * start_m, along);
  if (end_m < length) piece = clipped(piece, space.start + along * end_m, -along);
  return piece;
}

RuleSet rules_on_floor(const RuleSet& rules, const FloorGroundTruth& floor) {
  RuleSet result = rules;
  result.inner_wall_m = floor.inner_wall_m.value_or(rules.inner_wall_m);
  result.outer_wall_m = floor.outer_wall_m.value_or(rules.outer_wall_m);
  result.height_m = floor.ceiling_height_m.value_or(rules.height_m);
  return result;
}

std::vector<SpaceProblem> space_problems(const FloorGroundTruth& floor, const RuleSet& rules,
                                         const std::vector<RoomObservation>& observations,
                                         const FloorFitOptions& options,
                                         std::vector<SetAsideInput>& set_aside) {
  const Placement placement = place_observations(floor, observations, options.placement);
  set_aside.insert(set_aside.end(), placement.set_aside.begin(), placement.set_aside.end());
  std::vector<SpaceProblem> problems;
  const double outer_wall_m = rules_on_floor(rules, floor).outer_wall_m;
  for (const Space& space : floor.spaces) problems.push_back(bare_problem(floor, outer_wall_m, space));
  for (const PlacedObservation& placed : placement.placed)
    if (placed.on == PlacedObservation::On::space)
      problems[static_cast<std::size_t>(placed.index)].rooms.push_back(placed.evidence);
  for (SpaceProblem& problem : problems) problem.rooms = fused(problem.rooms, set_aside);
  add_doors(floor, rules_on_floor(rules, floor), observations, placement, problems, options);
  return problems;
}

FitOptions space_options(const RuleSet& rules, const std::vector<SpaceProblem>& problems,
                         const FloorFitOptions& options) {
  FitOptions fitting = with_doorless_share(rules, problems, options.space);
  fitting.likeness = likeness_of(rules, problems, options.likeness);
  return fitting;
}

FittedFloor floor_of_layouts(const FloorGroundTruth& floor, const RuleSet& rules,
                             const std::vector<SpaceProblem>& problems,
                             const std::vector<SpaceFit>& layouts) {
  FittedFloor fitted = given_floor(floor, rules, storey_height(floor, rules, {}));
  add_spaces(fitted, problems, layouts);
  furnish(fitted, rules, problems, {});
  return fitted;
}

FittedFloor fit_floor(const FloorGroundTruth& floor, const RuleSet& rules,
                      const std::vector<SpaceProblem>& problems,
                      const std::vector<RoomObservation>& observations, const FloorFitOptions& options) {
  FittedFloor fitted = given_floor(floor, rules, storey_height(floor, rules, observations));
  const RuleSet here = rules_on_floor(rules, floor);
  const FitOptions fitting = space_options(here, problems, options);
  fitted.likeness = fitting.likeness.deviation;
  fit_spaces(fitted, here, problems, fitting);
  for (const PlacedObservation& placed : place_observations(floor, observations, options.placement).placed) {
    if (placed.on == PlacedObservation::On::space) continue;
    const RoomObservation& observation = observations[static_cast<std::size_t>(placed.observation)];
    const auto index = static_cast<std::size_t>(placed.index);
    FittedRoom& room =
        placed.on == PlacedObservation::On::hallway ? fitted.hallways[index] : fitted.fixed[index];
    room.scans.push_back(observation.room);
    const OrientedBox seen = oriented_box(observation.outline);
    room.extracted_width_m = seen.length_m;
    room.extracted_sigma_m = std::max(observation.width.sigma_m, observation.depth.sigma_m);
  }
  furnish(fitted, rules, problems, observations);
  return fitted;
}

}  // namespace gramap
