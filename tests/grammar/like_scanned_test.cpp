#include "grammar/like_scanned.h"

#include <doctest/doctest.h>

#include <cmath>
#include <random>
#include <string>

#include "grammar/derive.h"
#include "grammar/language.h"

using namespace gramap;

namespace {

const std::string kOffices = R"(
grammar offices;
wall inner 0.10 m, outer 0.30 m;
height 2.70 m;
room Office { width 2.50 m +- 20 cm : 80 % or 4.00 m +- 50 cm : 20 %; }
room Hall   { width 10.00 m +- 200 cm; }
start Space;
background 1 % width 1.00 m .. 21.00 m;
office: Space -> Office Space : 90 %;
hall:   Space -> Hall Space   : 10 %;
)";

RuleSet rules_of(const std::string& text) {
  const CheckedRules checked = check_rules(text, "test");
  for (const Diagnostic& diagnostic : checked.diagnostics) MESSAGE(diagnostic.message);
  REQUIRE(checked.rules);
  return *checked.rules;
}

SpaceProblem bare(double length_m) {
  SpaceProblem problem;
  problem.id = "S";
  problem.length_m = length_m;
  problem.depth_m = 5;
  return problem;
}

RoomEvidence scan(double start_m, double width_m, double sigma_m = 0.01) {
  RoomEvidence room;
  room.id = "scan" + std::to_string(start_m);
  room.width_m = width_m;
  room.width_sigma_m = sigma_m;
  room.centre_m = start_m + width_m / 2;
  room.centre_sigma_m = 0.1;
  return room;
}

Row row_of(const RuleSet& rules, const SpaceProblem& problem) {
  CompiledRow compiled = compile_row(rules, {problem.depth_m, problem.hallway, problem.facade},
                                     make_grid(problem.length_m, rules.inner_wall_m, 0.05));
  REQUIRE(!compiled.fault);
  return compiled.row;
}

double normal_density(double value, double mean, double sd) {
  return std::exp(-0.5 * std::pow((value - mean) / sd, 2)) / (sd * std::sqrt(2 * std::acos(-1.0)));
}

/// Density of the first room's width.
double first_width(const Row& row, double width_m) {
  double sum = 0;
  for (const Arc& arc : row.arcs[0][0]) {
    const Element& element = row.elements[static_cast<std::size_t>(arc.element)];
    if (element.kind == Element::Width::uniform) {
      const bool within = width_m >= element.least_m && width_m <= element.most_m;
      sum += within ? arc.probability / (element.most_m - element.least_m) : 0;
      continue;
    }
    for (const Mixture::Component& c : element.mixture.components)
      sum += arc.probability * c.weight * normal_density(width_m, c.normal.mean_m, c.normal.sd_m);
  }
  return sum;
}

std::vector<double> widths(const SpaceFit& fit) {
  std::vector<double> result;
  for (const PlacedRoom& room : fit.best.rooms) result.push_back(room.width_m);
  return result;
}

}  // namespace

TEST_CASE(
    "the rules, the rooms of the floor and those of the space foretell the next room as their worth says") {
  const RuleSet rules = rules_of(kOffices);
  SpaceProblem problem = bare(60);
  problem.rooms = {scan(0, 3.1), scan(20, 9.0), scan(40, 16.0)};
  SpaceProblem elsewhere = bare(60);
  elsewhere.rooms = {scan(0, 5.0), scan(20, 5.0), scan(40, 7.0)};
  const Row before = row_of(rules, problem);
  for (const bool floor : {false, true}) {
    for (const double worth : {1.0, 4.0}) {
      INFO("floor ", floor, ", rules worth ", worth);
      Likeness likeness{0.02, worth, 0, 1, {}};
      if (floor) likeness = {0.02, worth, 0.1, 5, alike_rooms({problem, elsewhere})};
      Row after = before;
      const std::vector<double> ratios = expect_as_scanned(rules, problem, likeness, after);

      for (double width_m = 1.5; width_m < 20.5; width_m += 0.01) {
        double anywhere = first_width(before, width_m);
        if (floor) {
          anywhere *= 5;
          for (const double of : {3.1, 9.0, 16.0, 5.0, 5.0, 7.0})
            anywhere += normal_density(width_m, of, std::hypot(0.01, 0.1 * of));
          anywhere /= 5 + 6;
        }
        double expected = worth * anywhere;
        for (const RoomEvidence& room : problem.rooms)
          expected += normal_density(width_m, room.width_m, std::hypot(0.01, 0.02 * room.width_m));
        INFO(width_m);
        CHECK(first_width(after, width_m) == doctest::Approx(expected / (worth + 3)).epsilon(0.005));
      }
      for (std::size_t state = 0; state < after.arcs.size(); ++state) {
        double sum_before = 0, sum_after = 0;
        for (const Arc& arc : before.arcs[state][0]) sum_before += arc.probability;
        for (const Arc& arc : after.arcs[state][0]) sum_after += arc.probability;
        CHECK(sum_after == doctest::Approx(sum_before));
      }
      for (const Element& element : after.elements) {
        if (element.kind != Element::Width::mixture) continue;
        double sum = 0;
        for (const Mixture::Component& c : element.mixture.components) sum += c.weight;
        CHECK(sum == doctest::Approx(1));
      }

      // The prior of each scan's own width x its ratio: what the others and the rules foretell of it.
      REQUIRE(ratios.size() == 3);
      for (std::size_t i = 0; i < 3; ++i) {
        const double width_m = problem.rooms[i].width_m;
        SpaceProblem others = problem;
        others.rooms.erase(others.rooms.begin() + static_cast<std::ptrdiff_t>(i));
        Likeness from_others = likeness;
        if (floor) from_others.on_floor = alike_rooms({others, elsewhere});
        Row without = before;
        (void)expect_as_scanned(rules, others, from_others, without);
        CHECK(ratios[i] * first_width(after, width_m) ==
              doctest::Approx(first_width(without, width_m)).epsilon(0.01));
      }
    }
  }
}

TEST_CASE("a space without scans takes after those of its floor") {
  const RuleSet rules = rules_of(kOffices);
  SpaceProblem scanned = bare(60);
  for (int i = 0; i < 6; ++i) scanned.rooms.push_back(scan(9.1 * i, 9.0));
  const Likeness likeness{0.02, 2, 0.05, 4, alike_rooms({scanned})};
  const SpaceProblem unseen = bare(60);
  const Row before = row_of(rules, unseen);
  Row after = before;
  CHECK(expect_as_scanned(rules, unseen, likeness, after).empty());
  CHECK(first_width(after, 9.0) > 5 * first_width(before, 9.0));
}

TEST_CASE("scanned rooms of a floor are grouped by type and width, in linear numbers") {
  std::vector<SpaceProblem> problems;
  for (int space = 0; space < 100; ++space) {
    problems.push_back(bare(60));
    for (int i = 0; i < 10; ++i)
      problems.back().rooms.push_back(scan(5 * i, 3 + 0.001 * ((7 * space + i) % 3)));
    problems.back().rooms.push_back(scan(55, 4, 0.02));
  }
  problems[0].rooms[0].type = "Office";
  problems[1].rooms[0].other_width_m = 4;  // which of the two is not known
  const std::vector<AlikeRooms> groups = alike_rooms(problems);
  REQUIRE(groups.size() == 3);
  CHECK(groups[0].count == 998);
  CHECK(groups[0].width_m == doctest::Approx(3.001).epsilon(1e-4));
  CHECK(groups[0].sigma_m == doctest::Approx(0.01));
  CHECK(groups[1].count == 100);
  CHECK(groups[1].width_m == doctest::Approx(4));
  CHECK(groups[1].sigma_m == doctest::Approx(0.02));
  CHECK(groups[2].type == "Office");
}

TEST_CASE("a likeness of zero, and scans whose dimension along the line is not known, change nothing") {
  const RuleSet rules = rules_of(kOffices);
  SpaceProblem problem = bare(60);
  problem.rooms = {scan(0, 3.1)};
  Row row = row_of(rules, problem);
  CHECK(expect_as_scanned(rules, problem, {}, row).empty());
  problem.rooms[0].other_width_m = 5;
  problem.rooms[0].other_sigma_m = 0.01;
  CHECK(expect_as_scanned(rules, problem, {0.04, 1, 0, 1, {}}, row).empty());
  CHECK(first_width(row, 3.1) == first_width(row_of(rules, problem), 3.1));
}

TEST_CASE("what the rules rule out stays ruled out") {
  const RuleSet rules =
      rules_of("grammar g; wall inner 0.10 m; room A { width 4.00 m +- 1 cm; } start S; a: S -> A S : 1;\n");
  SpaceProblem problem = bare(60);
  problem.rooms = {scan(0, 5.25), scan(10, 5.25), scan(20, 5.25)};
  Row row = row_of(rules, problem);
  CHECK(expect_as_scanned(rules, problem, {0.08, 1, 0, 1, {}}, row).empty());
  CHECK(likeness_of(rules, {problem}).deviation == 0);
}

TEST_CASE("the scan's type says whose width it is") {
  const RuleSet rules = rules_of(kOffices);
  SpaceProblem problem = bare(60);
  problem.rooms = {scan(0, 5.2)};  // a very wide office or a very narrow hall
  problem.rooms[0].type_confidence = 0.99;
  const auto share_of = [&](const std::string& type, const std::string& wanted) {
    problem.rooms[0].type = type;
    Row row = row_of(rules, problem);
    (void)expect_as_scanned(rules, problem, {0.02, 1, 0, 1, {}}, row);
    double share = 0;
    for (const Arc& arc : row.arcs[0][0]) {
      const int placed = row.elements[static_cast<std::size_t>(arc.element)].first_type();
      if (placed >= 0 && rules.rooms[static_cast<std::size_t>(placed)].name == wanted)
        share += arc.probability;
    }
    return share;
  };
  CHECK(share_of("Hall", "Hall") > 0.5);
  CHECK(share_of("Office", "Hall") < 0.1);
}

TEST_CASE(
    "a gap among halls is filled with halls where rooms are alike, with offices as the rules say else") {
  const RuleSet rules = rules_of(kOffices);
  SpaceProblem problem = bare(5 * 9.0 + 4 * 0.1);
  problem.rooms = {scan(0, 9.0), scan(9.1, 9.0), scan(36.4, 9.0)};
  FitOptions options;
  options.grid_m = 0.05;
  CHECK(widths(fit_space(rules, problem, options)).size() > 5);
  options.likeness.deviation = 0.02;
  const SpaceFit fit = fit_space(rules, problem, options);
  REQUIRE(fit.best.rooms.size() == 5);
  for (const PlacedRoom& room : fit.best.rooms) {
    CHECK(room.width_m == doctest::Approx(9).epsilon(0.02));
    CHECK(room.type == "Hall");
  }
  CHECK(fit.set_aside.empty());
}

TEST_CASE("one scan that is wrong is found out as readily as without likeness: it does not foretell itself") {
  const RuleSet rules = rules_of(kOffices);
  // A wall too many was read in a space that offices fill to the centimetre.
  SpaceProblem problem = bare(6 * 2.5 + 5 * 0.1);
  problem.rooms = {scan(5.2, 1.3)};
  FitOptions options;
  options.grid_m = 0.05;
  for (const double likeness : {0.0, 0.02}) {
    options.likeness.deviation = likeness;
    const SpaceFit fit = fit_space(rules, problem, options);
    INFO("likeness ", likeness);
    CHECK(fit.best.rooms.size() == 6);
    CHECK(fit.set_aside.size() + fit.reinterpreted.size() == 1);
  }
}

TEST_CASE("floors drawn from the rules are as the rules say; floors of rows that are alike are not") {
  const RuleSet rules = rules_of(kOffices);
  std::mt19937_64 generator(5);
  std::uniform_real_distribution<double> any(0, 1);
  int drawn_alike = 0, rows_alike = 0;
  for (std::uint64_t floor = 1; floor <= 10; ++floor) {
    std::vector<SpaceProblem> drawn, alike;
    for (std::uint64_t space = 0; space < 4; ++space) {
      drawn.push_back(bare(40));
      const auto layouts = SpaceDeriver(rules, drawn.back(), 0.05).draw(1, 10 * floor + space);
      for (const PlacedRoom& room : layouts.front().rooms)
        if (any(generator) < 0.5) drawn.back().rooms.push_back(scan(room.start_m, room.width_m));
      alike.push_back(bare(40));
      const double usual_m = 3 + 6 * any(generator);
      for (int room = 0; room < 4; ++room)
        alike.back().rooms.push_back(scan(9 * room, usual_m * (0.98 + 0.04 * any(generator))));
    }
    drawn_alike += likeness_of(rules, drawn).deviation > 0;
    rows_alike += likeness_of(rules, alike).deviation > 0;
  }
  CHECK(drawn_alike <= 1);
  CHECK(rows_alike == 10);
}
