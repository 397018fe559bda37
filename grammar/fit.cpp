// The fit of one space: row automaton, lattice, sums and optimum, then widths off the grid.
#include <algorithm>
#include <cmath>

#include "geometry/error.h"
#include "geometry/say.h"
#include "grammar/coarse.h"
#include "grammar/coverage.h"
#include "grammar/explanation.h"
#include "grammar/fillable.h"
#include "grammar/inference.h"
#include "grammar/lattice.h"
#include "grammar/least_error.h"
#include "grammar/like_scanned.h"
#include "grammar/placed_rooms.h"
#include "grammar/sequence.h"
#include "grammar/space.h"

namespace gramap {
namespace {

void check(const RuleSet& rules, const SpaceProblem& problem, const FitOptions& options) {
  const auto fail = [&](const std::string& message) {
    throw InputError({}, "space " + problem.id + ": " + message);
  };
  if (rules.symbols.empty()) fail("the rules have no start symbol");
  if (!(problem.length_m > 0) || !std::isfinite(problem.length_m)) fail("its length is not positive");
  if (!(options.grid_m > 0)) fail("the grid step is not positive");
  for (const RoomEvidence& e : problem.rooms) {
    const bool width = std::isfinite(e.width_m) && e.width_m > 0 && e.width_sigma_m > 0;
    const bool other = !e.other_width_m || (*e.other_width_m > 0 && e.other_sigma_m > 0);
    const bool centre = !e.centre_m || (std::isfinite(*e.centre_m) && e.centre_sigma_m > 0);
    if (!width || !other || !centre)
      fail("the observation of " + e.id +
           " has a width, position or standard deviation that is not positive");
  }
  for (const DoorEvidence& door : problem.doors)
    if (!std::isfinite(door.centre_m) || !(door.sigma_m > 0))
      fail("a door has a position or standard deviation that makes no sense");
}

/// The rooms of a sequence's best layout. Inside a unit a room's walls follow the unit's: their deviations
/// do, too.
std::vector<PlacedRoom> place_rooms(const RuleSet& rules, const Lattice& lattice,
                                    const SequencePosterior& posterior, const std::vector<double>& starts,
                                    const std::vector<std::vector<Explained>>& explained, double length_m) {
  const std::vector<PathStep>& path = posterior.best;
  std::vector<PlacedRoom> placed = placed_rooms(rules, lattice, path, starts, length_m);
  std::size_t next = 0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const Element& element = placed_element(lattice, path[i]);
    const SequencePosterior::Place& place = posterior.places[i];
    const auto deviation = [&](double slope) {  // of start + slope * width
      const double variance = place.start_sd_m * place.start_sd_m +
                              slope * slope * place.width_sd_m * place.width_sd_m +
                              2 * slope * place.covariance_m2;
      return std::sqrt(std::max(0.0, variance));
    };
    for (std::size_t r = 0; r < element.rooms.size(); ++r) {
      const ElementRoom& inner = element.rooms[r];
      PlacedRoom& room = placed[next++];
      room.width_sigma_m = inner.width.slope * place.width_sd_m;
      room.start_sigma_m = deviation(inner.start.slope);
      room.end_sigma_m = is_whole(inner) ? place.end_sd_m : deviation(inner.start.slope + inner.width.slope);
      for (const Explained& e : explained[i]) {
        if (e.room != static_cast<int>(r)) continue;
        room.evidence.push_back(lattice.evidence().rooms()[static_cast<std::size_t>(e.evidence)].original);
        if (e.how == Reading::swapped) room.swapped = true;
      }
    }
  }
  return placed;
}

/// The sequence may be another one altogether: a wall is no better known than the walls of all layouts are
/// near to it.
void hold_walls_to_all_layouts(const std::vector<SameWall>& walls, SequencePosterior& best) {
  for (std::size_t i = 0; i < walls.size(); ++i) {
    double& start = best.places[i + 1].start_sd_m;
    start = std::max(start, walls[i].deviation_m);
    best.places[i].end_sd_m = start;
  }
}

void report_evidence(const SpaceProblem& problem, const Lattice& lattice,
                     const std::vector<std::vector<Explained>>& explained, SpaceFit& fit) {
  std::vector<bool> used(problem.rooms.size(), false);
  for (const std::vector<Explained>& of_element : explained) {
    for (const Explained& e : of_element) {
      const int original = lattice.evidence().rooms()[static_cast<std::size_t>(e.evidence)].original;
      used[static_cast<std::size_t>(original)] = true;
      const std::string width = said_metres(problem.rooms[static_cast<std::size_t>(original)].width_m);
      if (e.how == Reading::opens)
        fit.reinterpreted.push_back(
            {original, "read as one room of " + width + ", but it is two: a wall was missed"});
      if (e.how == Reading::start_only || e.how == Reading::end_only)
        fit.reinterpreted.push_back(
            {original, "only the wall at its " + std::string(e.how == Reading::start_only ? "start" : "end") +
                           " is right: what was read as the other one, " + width +
                           " from it, stands inside the room"});
    }
  }
  for (std::size_t i = 0; i < used.size(); ++i)
    if (!used[i])
      fit.set_aside.push_back(
          {static_cast<int>(i), "no room of the most probable layout explains its width of " +
                                    said_metres(problem.rooms[i].width_m) +
                                    (problem.rooms[i].centre_m ? " at its place" : " in its order")});
}

/// Layouts drawn to judge the expected error by.
constexpr int kLeastErrorDraws = 100;

using Sequences = std::vector<std::shared_ptr<const Prefix>>;

std::vector<double> mean_starts(const SequencePosterior& posterior) {
  std::vector<double> starts;
  for (const SequencePosterior::Place& place : posterior.places) starts.push_back(place.start_mean_m);
  return starts;
}

std::vector<int> looks_along(const Prefix& whole) {
  std::vector<int> looks;
  for (const Prefix* prefix = &whole; prefix->before != nullptr; prefix = prefix->before.get())
    looks.push_back(prefix->look);
  std::reverse(looks.begin(), looks.end());
  return looks;
}

/// The sequence of least expected error, in front of the others: that of the layout drawn which is nearest to
/// all drawn, unless the most probable one does as well.
void put_least_error_first(const Lattice& lattice, const NodeTable& before, const NodeTable& behind,
                           const std::vector<double>& posteriors, double length_m, Sequences& sequences) {
  const std::vector<DrawnLayout> drawn = draw_layouts(lattice, behind, kLeastErrorDraws, 1);
  std::vector<Stretches> rooms;
  for (const DrawnLayout& layout : drawn) rooms.push_back(layout.rooms);
  const std::vector<int> looks = looks_of(lattice.row());
  std::vector<int> nearest;
  for (const int element : drawn[least_error(rooms, drawn)].elements)
    nearest.push_back(looks[static_cast<std::size_t>(element)]);
  const auto sequence = sequence_of(lattice, before, behind, posteriors, nearest);
  if (sequence == nullptr) return;
  std::vector<Stretches> candidates;
  for (const auto& candidate : {sequences.front(), sequence}) {
    const SequencePosterior posterior = sequence_posterior(lattice, *candidate);
    candidates.push_back(stretches_of(lattice, posterior.best, mean_starts(posterior), length_m));
  }
  if (least_error(candidates, drawn) == 0) return;
  const auto same = [&](const auto& other) { return looks_along(*other) == nearest; };
  std::erase_if(sequences, same);
  sequences.insert(sequences.begin(), sequence);
}

}  // namespace

SpaceFit fit_space(const RuleSet& rules, const SpaceProblem& problem, const FitOptions& options) {
  check(rules, problem, options);
  const Grid grid = make_grid(problem.length_m, rules.inner_wall_m, options.grid_m);
  CompiledRow compiled = compile_row(rules, {problem.depth_m, problem.hallway, problem.facade}, grid);
  refuse_fault(rules, problem, compiled);
  const Evidence evidence(rules, problem, options, grid,
                          expect_as_scanned(rules, problem, options.likeness, compiled.row));
  Lattice lattice(compiled.row, grid, evidence);
  lattice.restrict(coarse_mask(rules, problem, options, lattice));
  const NodeTable before = forward(lattice);
  const double total = log_total(lattice, before);
  if (!std::isfinite(total)) refuse_unfillable(rules, problem, options);
  const NodeTable behind = backward(lattice, before);
  const std::vector<double> posteriors = node_posteriors(lattice, before, behind);
  const int reported = std::max(0, options.alternatives) + 1;
  Sequences sequences =
      most_probable_sequences(lattice, before, behind, posteriors, {reported, options.beam});
  if (options.least_error)
    put_least_error_first(lattice, before, behind, posteriors, problem.length_m, sequences);
  sequences.resize(std::min(sequences.size(), static_cast<std::size_t>(reported)));
  std::vector<SequencePosterior> found;
  for (const auto& sequence : sequences) found.push_back(sequence_posterior(lattice, *sequence));
  std::vector<SameRoom> same = rooms_of(lattice, found.front().best);
  std::vector<SameWall> walls = walls_of(found.front().best);
  const Coverage coverage = cover(lattice, before, behind, posteriors, same, walls);
  hold_walls_to_all_layouts(walls, found.front());
  SpaceFit fit;
  for (std::size_t s = 0; s < sequences.size(); ++s) {
    const auto explained = explain(lattice, found[s].best);
    const std::vector<double> starts =
        options.least_error ? mean_starts(found[s]) : refine(lattice, found[s].best, explained);
    Layout layout;
    layout.rooms = place_rooms(rules, lattice, found[s], starts, explained, problem.length_m);
    layout.score = sequences[s]->log_weight;
    layout.probability = std::min(1.0, std::exp(sequences[s]->log_posterior));
    const std::vector<double> probabilities = type_probabilities(lattice, coverage, found[s].best);
    for (std::size_t i = 0; i < layout.rooms.size(); ++i) layout.rooms[i].type_probability = probabilities[i];
    if (s > 0) {
      fit.alternatives.push_back(std::move(layout));
      continue;
    }
    for (std::size_t i = 0; i < layout.rooms.size(); ++i) {
      layout.rooms[i].room_probability = std::clamp(same[i].probability, 0.0, 1.0);
      // The room may be another one altogether.
      layout.rooms[i].width_sigma_m = std::max(layout.rooms[i].width_sigma_m, same[i].width_deviation_m);
    }
    fit.best = std::move(layout);
    report_evidence(problem, lattice, explained, fit);
  }
  return fit;
}

}  // namespace gramap
