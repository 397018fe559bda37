#include "floor/grow_hallways.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <deque>
#include <random>
#include <string>

#include "floor/clear_area.h"
#include "geometry/error.h"
#include "geometry/polygon.h"
#include "geometry/random.h"
#include "grammar/condition.h"

namespace gramap {
namespace {

constexpr double kLeastStep_m = 0.5;  ///< a shorter straight is none
constexpr std::size_t kMostRuns = 2000;
constexpr double kTouch_m = 1e-6;
constexpr double kInside_m = 0.01;
constexpr double kMostSigmas = 2;

/// Draws that are the same on every machine.
class Draws {
 public:
  explicit Draws(std::uint64_t seed) : engine_(seed) {}

  double uniform() { return unit_interval(engine_()); }

  /// Cut off so that no length comes out as nothing.
  double normal(const Normal& of) {
    const double u = 1 - uniform();
    const double z = box_muller(u, uniform());
    return of.mean_m + of.sd_m * std::clamp(z, -kMostSigmas, kMostSigmas);
  }

 private:
  std::mt19937_64 engine_;
};

/// A straight hallway with what branches off it.
struct Run {
  Heading start;  ///< the middle of its beginning: at its parent's side, or at an outer wall
  double width_m = 0;
  double right_m = 0;  ///< clear depth that it leaves to outer walls, with the wall before the rooms
  double left_m = 0;
  double length_m = 0;
  double reserved_m = 0;  ///< kept free for it before it has grown
  int parent = -1;
  double at_m = 0;  ///< along its parent
  bool to_left = false;
  std::vector<int> branches;
  const std::vector<HallwayModule>* body = nullptr;  ///< what it is to become

  Heading head() const { return {start.point(length_m, 0), start.heading}; }
};

class Grower {
 public:
  Grower(const FloorGroundTruth& floor, const HallwayGrammar& grammar, double inner_wall_m,
         double outer_wall_m, std::uint64_t seed)
      : grammar_(grammar), wall_m_(inner_wall_m), area_(floor, inner_wall_m, outer_wall_m), draws_(seed) {}

  Polygon grow() {
    const std::vector<HallwayModule> axiom{{HallwayModule::Kind::symbol, {}, false, 0, {}}};
    plant(&axiom);
    for (std::size_t i = 0; i < waiting_.size(); ++i) walk(waiting_[i]);
    if (runs_[0].length_m < kLeastStep_m)
      throw InputError({}, "the hallways' rules make no hallway in this outline",
                       "let a production of the axiom `" + grammar_.symbols[0] +
                           "` begin with `straight` and have no condition");
    Polygon ring;
    contour(0, ring);
    ring = simplified(ring, 1e-6);
    for (Vec2& point : ring) point = area_.to_plan(point);
    return ring;
  }

 private:
  double room_m() const { return grammar_.depth_m + wall_m_; }

  // ---- places

  /// Where across a free breadth a hallway runs: as near to `wish_m` as rooms on both sides allow, in the
  /// middle where no second hallway fits beside it.
  struct Lane {
    double at_m = 0;
    double before_m = 0, behind_m = 0;  ///< clear breadth left on either side
  };
  std::optional<Lane> lane(double from_m, double to_m, double width_m, double wish_m) const {
    const double rest_m = to_m - from_m - width_m;
    const double middle_m = (from_m + to_m) / 2, half_m = width_m / 2;
    if (rest_m >= 2 * room_m() - kTouch_m) {
      const bool room_for_two = rest_m >= 4 * room_m() + width_m + wall_m_;
      const double at_m =
          room_for_two ? std::clamp(wish_m, from_m + room_m() + half_m, to_m - room_m() - half_m) : middle_m;
      return Lane{at_m, room_m(), room_m()};
    }
    if (rest_m < room_m()) return std::nullopt;
    if (wish_m < middle_m) return Lane{from_m + half_m, 0, room_m()};
    return Lane{to_m - half_m, room_m(), 0};
  }

  void plant(const std::vector<HallwayModule>* axiom) {
    const double width_m = draws_.normal(grammar_.width);
    const std::optional<Strip> strip = area_.best_strip([&](double breadth_m) {
      const double rest_m = breadth_m - width_m;
      return rest_m >= 2 * room_m() - kTouch_m ? 2.0 : rest_m >= room_m() ? 1.0 : 0.0;
    });
    if (!strip) {
      char text[200];
      std::snprintf(
          text, sizeof text,
          "the outline is nowhere broad enough for a hallway %.2f m wide with rooms %.2f m deep beside it",
          width_m, grammar_.depth_m);
      throw InputError({}, text,
                       "make `width` or `depth` of the rule file's hallways smaller, or draw the hallways");
    }
    const double half_m = strip->breadth_m / 2;
    const Lane place = *lane(-half_m, half_m, width_m, 0);
    const bool both = place.before_m > 0 && place.behind_m > 0;
    // The middle, or as near to it as leaves fixed rooms on its side, if that leads farther.
    std::vector<double> offsets{place.at_m};
    if (both)
      for (const double beside_m : area_.beside_fixed(strip->begin, width_m))
        if (std::abs(beside_m) + width_m / 2 < half_m) offsets.push_back(beside_m);
    std::sort(offsets.begin() + 1, offsets.end(),
              [](double a, double b) { return std::pair(std::abs(a), a) < std::pair(std::abs(b), b); });
    double offset_m = place.at_m, farthest_m = -1;
    for (const double candidate_m : offsets) {
      const Heading from{strip->begin.point(0, candidate_m), strip->begin.heading};
      const double free_m = std::min(strip->length_m, area_.free_of_fixed(from, width_m / 2, width_m / 2));
      if (free_m > farthest_m + 0.01) farthest_m = free_m, offset_m = candidate_m;
    }
    Run run;
    run.width_m = width_m;
    run.start = {strip->begin.point(0, offset_m), strip->begin.heading};
    run.right_m = std::min(room_m(), half_m + offset_m - width_m / 2);
    run.left_m = std::min(room_m(), half_m - offset_m - width_m / 2);
    Run reverse = run;
    reverse.start = {strip->begin.point(strip->length_m, offset_m), (strip->begin.heading + 2) & 3};
    std::swap(reverse.left_m, reverse.right_m);
    const double sides_m = sides_at(run), other_m = sides_at(reverse);
    const bool by_lot = std::abs(sides_m - other_m) < room_m();
    if (by_lot ? draws_.uniform() < 0.5 : other_m < sides_m) run = reverse;
    run.body = axiom;
    runs_ = {run};
    waiting_.push_back(0);
  }

  /// How far the longer of the branches at the beginning of a first run could go.
  double sides_at(const Run& first) {
    runs_ = {first};
    double most_m = 0;
    for (const bool to_left : {false, true})
      if (const auto found = plan(0, to_left, grammar_.width.mean_m))
        most_m = std::max(most_m, found->free_m);
    return most_m;
  }

  /// How far a run can go on from its head.
  double ahead_m(const Run& run, int self) const {
    const double half_m = run.width_m / 2;
    const Heading head = run.head();
    // From the start: the wall at a head that has reached it would lie neither before nor behind it.
    double free_m = std::min(area_.free_of_walls(run.start, half_m + run.right_m, half_m + run.left_m),
                             area_.free_of_fixed(run.start, half_m, half_m)) -
                    run.length_m;
    const double beside_m = half_m + 2 * room_m() + wall_m_;
    for (int i = 0; i < static_cast<int>(runs_.size()); ++i) {
      const Run& other = runs_[static_cast<std::size_t>(i)];
      if (i == self || i == run.parent || (self >= 0 && other.parent == self)) continue;
      const double reach_m = std::max(other.length_m, other.reserved_m);
      if (reach_m <= 0) continue;
      const Vec2 a = head.local(other.start.point(0, -other.width_m / 2));
      const Vec2 b = head.local(other.start.point(reach_m, other.width_m / 2));
      const bool is_beside =
          std::max(a.y(), b.y()) > -beside_m + kTouch_m && std::min(a.y(), b.y()) < beside_m - kTouch_m;
      if (!is_beside || std::max(a.x(), b.x()) <= kTouch_m) continue;
      free_m = std::min(free_m, std::min(a.x(), b.x()) - room_m() - wall_m_);
    }
    return std::max(0.0, free_m);
  }

  struct Plan {
    Run run;
    double free_m = 0;
  };

  /// The branch that leads farthest from about a run's head to one side; none when it would not even pass the
  /// rooms along its parent.
  std::optional<Plan> plan(int parent, bool to_left, double width_m) const {
    const Run& from = runs_[static_cast<std::size_t>(parent)];
    const double reach_m = from.length_m + ahead_m(from, parent);
    // Bays lie to the left of the line that they are asked for: for the right side it runs backward.
    const Heading side = to_left
                             ? Heading{from.start.point(0, from.width_m / 2), from.start.heading}
                             : Heading{from.start.point(0, -from.width_m / 2), (from.start.heading + 2) & 3};
    const double sign = to_left ? 1 : -1;
    std::optional<Plan> best;
    const double inside_m = std::max(from.length_m - kInside_m, kInside_m);
    for (const Bay& bay : area_.bays(side, sign * inside_m)) {
      const std::optional<Lane> place = lane(bay.from_m, bay.to_m, width_m, sign * from.length_m);
      if (!place) continue;
      Plan plan;
      plan.run.at_m = sign * place->at_m;
      if (plan.run.at_m < width_m / 2 - kTouch_m || plan.run.at_m + width_m / 2 > reach_m + kTouch_m)
        continue;
      plan.run.start = {side.point(place->at_m, 0), (side.heading + 1) & 3};
      plan.run.width_m = width_m;
      plan.run.left_m = place->before_m;  // looking away from the parent, the line's beginning is to the left
      plan.run.right_m = place->behind_m;
      plan.run.parent = parent;
      plan.run.to_left = to_left;
      plan.free_m = ahead_m(plan.run, -1);
      if (plan.free_m >= room_m() && (!best || plan.free_m > best->free_m + 0.01)) best = plan;
    }
    return best;
  }

  // ---- productions

  const HallwayProduction* choose(int symbol, int run) {
    const double length_m = ahead_m(runs_[static_cast<std::size_t>(run)], run);
    const auto side_m = [&](bool to_left) {
      const auto found = plan(run, to_left, grammar_.width.mean_m);
      return found ? found->free_m : 0;
    };
    SpaceAttributes here;
    here.left_m = side_m(true);
    here.right_m = side_m(false);
    const auto has_place = [&](const HallwayModule& first) {
      switch (first.kind) {
        case HallwayModule::Kind::straight:
          return length_m >= kLeastStep_m;
        case HallwayModule::Kind::left:
          return here.left_m > 0;
        case HallwayModule::Kind::right:
          return here.right_m > 0;
        default:
          return true;
      }
    };
    std::vector<const HallwayProduction*> competing;
    double sum = 0;
    for (const HallwayProduction& production : grammar_.productions) {
      if (production.symbol != symbol || !has_place(production.body.front()) ||
          !holds(production.condition, here, length_m))
        continue;
      competing.push_back(&production);
      sum += production.probability;
    }
    double left = draws_.uniform() * sum;
    for (const HallwayProduction* production : competing)
      if ((left -= production->probability) < 0) return production;
    return nullptr;
  }

  /// Rewrites and walks a run until it ends.
  void walk(int index) {
    runs_[static_cast<std::size_t>(index)].reserved_m = 0;
    std::deque<const HallwayModule*> rest;
    for (const HallwayModule& module : *runs_[static_cast<std::size_t>(index)].body) rest.push_back(&module);
    while (!rest.empty()) {
      const HallwayModule& module = *rest.front();
      rest.pop_front();
      if (module.kind == HallwayModule::Kind::straight) {
        if (!go_straight(index, module)) return;
      } else if (module.kind == HallwayModule::Kind::symbol) {
        const HallwayProduction* production = choose(module.symbol, index);
        if (production == nullptr) return;
        for (auto it = production->body.rbegin(); it != production->body.rend(); ++it) rest.push_front(&*it);
      } else {
        branch_off(index, module, rest.empty());
      }
    }
  }

  bool go_straight(int index, const HallwayModule& module) {
    Run& run = runs_[static_cast<std::size_t>(index)];
    const double wish_m = module.to_end ? 0 : std::max(kLeastStep_m, draws_.normal(module.length));
    const double free_m = ahead_m(run, index);
    if (free_m < kLeastStep_m) return false;
    const bool leaves_a_row = free_m - wish_m >= room_m() + wall_m_;
    run.length_m += module.to_end || !leaves_a_row ? free_m : wish_m;
    return true;
  }

  void branch_off(int index, const HallwayModule& module, bool is_last) {
    const bool to_left = module.kind == HallwayModule::Kind::left;
    std::optional<Plan> planned = plan(index, to_left, draws_.normal(grammar_.width));
    if (!planned) return;
    if (runs_.size() >= kMostRuns)
      throw InputError({},
                       "the hallways' rules grow more than " + std::to_string(kMostRuns) + " hallways here",
                       "let them branch less often, or make `width` and `depth` of the hallways larger");
    planned->run.body = &module.branch;
    planned->run.reserved_m = room_m();
    Run& parent = runs_[static_cast<std::size_t>(index)];
    double corner_m = planned->run.at_m + planned->run.width_m / 2;
    if (is_last)
      for (const int other : parent.branches) {
        const Run& branch = runs_[static_cast<std::size_t>(other)];
        corner_m = std::max(corner_m, branch.at_m + branch.width_m / 2);
      }
    parent.length_m = is_last ? corner_m : std::max(parent.length_m, corner_m);
    const int child = static_cast<int>(runs_.size());
    parent.branches.push_back(child);
    waiting_.push_back(child);
    runs_.push_back(std::move(planned->run));
  }

  // ---- the network's outline

  /// Around a run and all that branches off it, with the hallway on the left.
  void contour(int index, Polygon& ring) const {
    const Run& run = runs_[static_cast<std::size_t>(index)];
    if (run.length_m < kLeastStep_m) return;
    const double half_m = run.width_m / 2;
    std::vector<int> rights, lefts;
    for (const int branch : run.branches)
      (runs_[static_cast<std::size_t>(branch)].to_left ? lefts : rights).push_back(branch);
    const auto nearer = [&](int a, int b) {
      return runs_[static_cast<std::size_t>(a)].at_m < runs_[static_cast<std::size_t>(b)].at_m;
    };
    std::sort(rights.begin(), rights.end(), nearer);
    std::sort(lefts.begin(), lefts.end(), nearer);
    ring.push_back(run.start.point(0, -half_m));
    for (const int branch : rights) contour(branch, ring);
    ring.push_back(run.start.point(run.length_m, -half_m));
    ring.push_back(run.start.point(run.length_m, half_m));
    for (auto branch = lefts.rbegin(); branch != lefts.rend(); ++branch) contour(*branch, ring);
    ring.push_back(run.start.point(0, half_m));
  }

  const HallwayGrammar& grammar_;
  double wall_m_;
  ClearArea area_;
  Draws draws_;
  std::vector<Run> runs_;
  std::vector<int> waiting_;  ///< runs in the order in which they are walked
};

}  // namespace

Polygon grow_hallways(const FloorGroundTruth& floor, const HallwayGrammar& grammar, double inner_wall_m,
                      double outer_wall_m, std::uint64_t seed) {
  return Grower(floor, grammar, inner_wall_m, outer_wall_m, seed).grow();
}

}  // namespace gramap
