#include <doctest/doctest.h>

#include <cmath>

#include "geometry/error.h"
#include "grammar/space.h"
#include "tests/grammar/rule_maker.h"

using namespace gramap;
using namespace gramap::test;

namespace {

std::string types(const Layout& layout) {
  std::string text;
  for (const PlacedRoom& room : layout.rooms) text += (text.empty() ? "" : " ") + room.type;
  return text;
}

/// Rooms and walls fill the space: each room starts where the one before ends, one wall on.
void check_gap_free(const SpaceFit& fit, const SpaceProblem& problem, const RuleSet& rules) {
  double at = 0;
  for (const PlacedRoom& room : fit.best.rooms) {
    CHECK(room.start_m == doctest::Approx(at).epsilon(1e-12));
    CHECK(room.width_m > 0);
    at = room.start_m + room.width_m + rules.inner_wall_m;
  }
  CHECK(at - rules.inner_wall_m == doctest::Approx(problem.length_m).epsilon(1e-12));
}

RoomEvidence scan(const std::string& id, double start_m, double width_m, double sigma_m = 0.01) {
  RoomEvidence e;
  e.id = id;
  e.width_m = width_m;
  e.width_sigma_m = sigma_m;
  e.centre_m = start_m + 0.5 * width_m;
  e.centre_sigma_m = 0.02;
  return e;
}

SpaceProblem space(double length_m) {
  SpaceProblem problem;
  problem.id = "north";
  problem.length_m = length_m;
  problem.depth_m = 5;
  problem.hallway = "H";
  return problem;
}

}  // namespace

TEST_CASE("a space that nobody scanned takes the rooms that fill it") {
  const RuleSet rules = office_rules();
  const SpaceProblem problem = space(2.8 + 0.2 + 5.8 + 0.2 + 1.8);
  const SpaceFit fit = fit_space(rules, problem);
  check_gap_free(fit, problem, rules);
  CHECK(types(fit.best) == "Cell Cell Cell WC");  // a repeat of three is likelier than a pair and a cell
  CHECK(fit.best.probability > 0);
  CHECK(fit.best.probability < 1);
}

TEST_CASE("scanned rooms stand where they were seen, the rest is derived") {
  const RuleSet rules = office_rules();
  SpaceProblem problem = space(2.8 + 0.2 + 5.8 + 0.2 + 1.8 + 0.2 + 2.8);
  problem.rooms = {scan("b", 9.0, 1.83), scan("a", 3.0, 5.81)};
  const SpaceFit fit = fit_space(rules, problem);
  check_gap_free(fit, problem, rules);
  CHECK(types(fit.best) == "Cell Double WC Cell");
  REQUIRE(fit.best.rooms.size() == 4);
  CHECK(fit.best.rooms[1].evidence == std::vector<int>{1});
  CHECK(fit.best.rooms[2].evidence == std::vector<int>{0});
  CHECK(std::abs(fit.best.rooms[1].width_m - 5.81) < 0.01);
  CHECK(std::abs(fit.best.rooms[2].width_m - 1.83) < 0.01);
  CHECK(fit.best.rooms[0].end_sigma_m < 0.03);
  CHECK(fit.best.rooms[0].start_sigma_m == 0);
  CHECK(fit.best.rooms[3].end_sigma_m == 0);
  CHECK(fit.best.probability > 0.9);
  for (const PlacedRoom& room : fit.best.rooms) CHECK(room.type_probability > 0.9);
  CHECK(fit.set_aside.empty());
}

TEST_CASE("an observation 50 cm short leaves the room right and is named") {
  const RuleSet rules = office_rules();
  SpaceProblem problem = space(3 * 2.8 + 2 * 0.2);
  problem.rooms = {scan("a", 0, 2.8), scan("b", 3.0, 2.3), scan("c", 6.0, 2.8)};
  const SpaceFit fit = fit_space(rules, problem);
  CHECK(types(fit.best) == "Cell Cell Cell");
  CHECK(std::abs(fit.best.rooms[1].width_m - 2.8) < 0.02);
  REQUIRE(fit.reinterpreted.size() == 1);
  CHECK(fit.reinterpreted[0].evidence == 1);
}

TEST_CASE("two rooms read as one stay two") {
  const RuleSet rules = office_rules();
  SpaceProblem problem = space(4 * 2.8 + 3 * 0.2);
  problem.rooms = {scan("a", 0, 2.8), scan("b", 3.0, 4.8 + 0.2 + 0.0), scan("d", 9.0, 2.8)};
  problem.rooms[1].width_m = 5.8;
  problem.rooms[1].centre_m = 3.0 + 2.9;
  RuleSet cells = rules;
  cells.rules.erase(cells.rules.begin() + 1);  // no doubles
  const SpaceFit fit = fit_space(cells, problem);
  CHECK(types(fit.best) == "Cell Cell Cell Cell");
  REQUIRE(fit.reinterpreted.size() == 1);
  CHECK(fit.reinterpreted[0].evidence == 1);
}

TEST_CASE("a room that no rule foresees is a background room") {
  const RuleSet rules = office_rules();
  SpaceProblem problem = space(2.8 + 0.2 + 4.2 + 0.2 + 2.8);
  problem.rooms = {scan("hall", 3.0, 4.2)};
  const SpaceFit fit = fit_space(rules, problem);
  CHECK(types(fit.best) == "Cell Unknown Cell");
  CHECK(std::abs(fit.best.rooms[1].width_m - 4.2) < 0.02);
}

TEST_CASE("a background room may be the only one of its space") {
  RuleSet rules = office_rules();
  rules.background.most_m = 10;
  SpaceProblem problem = space(7.9);
  problem.rooms = {scan("hall", 0, 7.9)};
  const SpaceFit fit = fit_space(rules, problem);
  CHECK(types(fit.best) == "Unknown");
  CHECK(fit.best.rooms[0].evidence.size() == 1);
}

TEST_CASE("a length that no derivation fills is refused with the nearest one that works") {
  RuleSet rules = office_rules();
  rules.background.probability = 0;
  rules.rules = {rule("cell", 0, {room(0), symbol(0)}, 1)};
  try {
    fit_space(rules, space(4.3));
    FAIL("no error");
  } catch (const InputError& error) {
    CHECK(std::string(error.what()) ==
          "space north: no layout of the rules of Space (cell) fills its 4.30 m");
    CHECK(error.advice == "the nearest length that they can fill is 5.35 m");
  }
}

TEST_CASE("order-only observations are explained in the order given") {
  const RuleSet rules = office_rules();
  SpaceProblem problem = space(2.8 + 0.2 + 5.8 + 0.2 + 1.8);
  for (const double width : {2.81, 5.79, 1.82}) {
    RoomEvidence e;
    e.id = "r";
    e.width_m = width;
    e.width_sigma_m = 0.01;
    problem.rooms.push_back(e);
  }
  const SpaceFit fit = fit_space(rules, problem);
  CHECK(types(fit.best) == "Cell Double WC");
  check_gap_free(fit, problem, rules);
}
