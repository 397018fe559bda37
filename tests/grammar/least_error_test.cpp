#include "grammar/least_error.h"

#include <doctest/doctest.h>

#include <cmath>
#include <random>
#include <string>

#include "grammar/derive.h"
#include "grammar/language.h"

using namespace gramap;

namespace {

/// Two halls of nearly one width are the most probable sequence by far; offices and stores, alike and in any
/// order, are many sequences that are rare one by one and the usual case together.
const std::string kRules = R"(
grammar halls;
wall inner 0.10 m, outer 0.30 m;
height 2.70 m;
room Office { width 2.50 m +- 30 cm; }
room Store  { width 2.60 m +- 30 cm; }
room Hall   { width 10.00 m +- 30 cm; }
start Space;
offices: Space -> Office Space : 40 %;
stores:  Space -> Store Space  : 40 %;
halls:   Space -> Hall Space   : 20 %;
)";

RuleSet rules_of(const std::string& text) {
  const CheckedRules checked = check_rules(text, "test");
  for (const Diagnostic& diagnostic : checked.diagnostics) MESSAGE(diagnostic.message);
  REQUIRE(checked.rules);
  return *checked.rules;
}

SpaceProblem bare() {
  SpaceProblem problem;
  problem.id = "S";
  problem.length_m = 20.1;
  problem.depth_m = 5;
  return problem;
}

template <class Rooms>
Stretches as_stretches(const Rooms& rooms) {
  Stretches stretches;
  for (const PlacedRoom& room : rooms) stretches.push_back({room.start_m, room.start_m + room.width_m});
  return stretches;
}

SpaceFit fitted(const RuleSet& rules, const SpaceProblem& problem, bool least_error) {
  FitOptions options;
  options.grid_m = 0.05;
  options.least_error = least_error;
  options.alternatives = 2;
  return fit_space(rules, problem, options);
}

}  // namespace

TEST_CASE("the width error pairs rooms by overlap and counts rooms that are not there whole") {
  const Stretches truth = {{0, 3}, {3.1, 6}, {6.1, 10}};
  CHECK(width_error_m(truth, truth) == 0);
  CHECK(width_error_m(truth, {}) == doctest::Approx(3 + 2.9 + 3.9));
  CHECK(width_error_m(truth, {{0, 3.2}, {3.3, 6}, {6.1, 10}}) == doctest::Approx(0.2 + 0.2));
  CHECK(width_error_m(truth, {{0, 6}, {6.1, 10}}) == doctest::Approx(3 + 3.1));
  CHECK(width_error_m({{0, 6}}, {{0, 2}, {2.1, 6}}) == doctest::Approx(6 - 3.9));
}

TEST_CASE("on layouts drawn from the rules the layout of least expected error is less wrong") {
  const RuleSet rules = rules_of(kRules);
  const SpaceFit probable = fitted(rules, bare(), false), least = fitted(rules, bare(), true);
  REQUIRE(probable.best.rooms.size() == 2);
  CHECK(least.best.rooms.size() >= 7);
  REQUIRE(!least.alternatives.empty());
  CHECK(least.alternatives.front().rooms.size() == 2);  // the most probable one comes next
  double probable_error = 0, least_error = 0;
  for (const Derivation& drawn : SpaceDeriver(rules, bare(), 0.05).draw(200, 3)) {
    probable_error += width_error_m(as_stretches(drawn.rooms), as_stretches(probable.best.rooms));
    least_error += width_error_m(as_stretches(drawn.rooms), as_stretches(least.best.rooms));
  }
  CHECK(least_error < 0.7 * probable_error);
}

TEST_CASE("the layout of least expected error fills the space, keeps to what was seen, and comes again") {
  const RuleSet rules = rules_of(kRules);
  std::mt19937_64 generator(2);
  for (int round = 0; round < 12; ++round) {
    SpaceProblem problem = bare();
    for (const Derivation& drawn : SpaceDeriver(rules, bare(), 0.05).draw(1, generator()))
      for (const PlacedRoom& room : drawn.rooms) {
        if (generator() % 2 == 0) continue;
        RoomEvidence evidence;
        evidence.id = "R" + std::to_string(problem.rooms.size());
        evidence.width_m = room.width_m;
        evidence.width_sigma_m = 0.02;
        evidence.centre_m = room.start_m + room.width_m / 2;
        evidence.centre_sigma_m = 0.1;
        problem.rooms.push_back(evidence);
      }
    const SpaceFit fit = fitted(rules, problem, true), again = fitted(rules, problem, true);
    double length = -rules.inner_wall_m;
    for (std::size_t i = 0; i < fit.best.rooms.size(); ++i) {
      const PlacedRoom& room = fit.best.rooms[i];
      CHECK(room.width_m > 0);
      CHECK(room.start_m == doctest::Approx(length + rules.inner_wall_m));
      length += room.width_m + rules.inner_wall_m;
      for (const int e : room.evidence)
        CHECK(room.width_m ==
              doctest::Approx(problem.rooms[static_cast<std::size_t>(e)].width_m).epsilon(0.05));
      REQUIRE(again.best.rooms.size() == fit.best.rooms.size());
      CHECK(again.best.rooms[i].start_m == room.start_m);
    }
    CHECK(length == doctest::Approx(problem.length_m));
    std::size_t explained = 0;
    for (const PlacedRoom& room : fit.best.rooms) explained += room.evidence.size();
    CHECK(explained + fit.set_aside.size() == problem.rooms.size());
    CHECK(fit.set_aside.size() <= 1);
  }
}
