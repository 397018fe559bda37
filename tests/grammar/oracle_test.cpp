// The fit against full enumeration, on random rule sets, spaces and evidence of every kind.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "grammar/coverage.h"
#include "grammar/explanation.h"
#include "grammar/sequence.h"
#include "tests/grammar/oracle.h"
#include "tests/grammar/rule_maker.h"

using namespace gramap;
using namespace gramap::test;

namespace {

constexpr int kCases = 500;
constexpr long kMostLayouts = 1200;
constexpr double kClose = 1e-6;
constexpr double kLeastProbability = 1e-9;  // alternatives below it are not asked for

class Dice {
 public:
  explicit Dice(std::uint64_t seed) : engine_(seed) {}
  double real(double least, double most) {
    return least + (most - least) * (static_cast<double>(engine_() >> 11) * 0x1p-53);
  }
  int whole(int least, int most) { return std::min(most, static_cast<int>(real(least, most + 1))); }
  bool chance(double p) { return real(0, 1) < p; }

 private:
  std::mt19937_64 engine_;
};

Condition length_above(double metres) {
  Condition condition;
  Condition::Node length;
  length.op = Condition::Op::attribute;
  length.attribute = Condition::Attribute::length;
  Condition::Node number;
  number.op = Condition::Op::number;
  number.number = metres;
  Condition::Node greater;
  greater.op = Condition::Op::greater;
  greater.left = 0;
  greater.right = 1;
  condition.nodes = {length, number, greater};
  return condition;
}

struct Case {
  RuleSet rules;
  SpaceProblem problem;
  double step_m = 0.25;
};

/// Symbols: 0 the row, recursive; 1 a unit of a few rooms; 2 the end of the row.
Case make_case(std::uint64_t seed) {
  Dice dice(seed);
  Case made;
  RuleSet& rules = made.rules;
  made.step_m = dice.chance(0.5) ? 0.25 : 0.5;
  rules.inner_wall_m = dice.real(0.05, 0.2);
  const int types = dice.whole(2, 4);
  for (int i = 0; i < types; ++i) {
    std::vector<Mixture::Component> width = {{1, {dice.real(0.5, 1.8), dice.real(0.02, 0.15)}}};
    if (dice.chance(0.3))
      width = {{0.6, width[0].normal}, {0.4, {dice.real(0.8, 2.4), dice.real(0.02, 0.1)}}};
    rules.rooms.push_back(room_type(std::string(1, static_cast<char>('A' + i)), width));
    if (dice.chance(0.5))
      rules.rooms.back().door = DoorHabit{0.3, 2, {{1, {dice.real(0.05, 0.4), 0.1}, dice.chance(0.5)}}};
  }
  rules.symbols = {"Row", "Unit", "Tail"};
  const auto any = [&] { return room(dice.whole(0, types - 1)); };
  const auto context = [&]() -> SymbolRef {
    if (dice.chance(0.4)) return {SymbolRef::Kind::end, 0};
    return {SymbolRef::Kind::room, dice.whole(0, types - 1)};
  };

  const int count = dice.whole(2, 5);
  for (int r = 0; r < count; ++r) {
    std::vector<Item> body;
    const std::string name = "r" + std::to_string(r);
    switch (dice.whole(0, 8)) {
      case 0:
        body = {any(), symbol(0)};
        break;
      case 1:
        body = {repeat({any()}, dice.whole(0, 1), dice.whole(2, 3)), any(), symbol(0)};
        break;
      case 2:
        body = {repeat({any()}, 1, -1), symbol(2)};
        break;
      case 3:
        body = {symbol(1), symbol(0)};
        break;
      case 4:
        body = {room(dice.whole(0, types - 1), absolute(dice.real(0.5, 2), 0.05)), symbol(0, floating())};
        break;
      case 5:
        body = {room(dice.whole(0, types - 1), floating(dice.real(0.5, 2))), any(), room(0, floating())};
        break;
      case 6:
        body = {room(dice.whole(0, types - 1), relative(dice.real(0.2, 0.6))), symbol(2, floating())};
        break;
      case 7:
        body = {merge(dice.whole(0, types - 1), {any(), any()}), symbol(0)};
        break;
      default:
        body = {split(Axis::across, {room(0), room(1, floating())}, absolute(dice.real(0.8, 2), 0.1)),
                symbol(0)};
        break;
    }
    rules.rules.push_back(rule(name, 0, body, dice.real(0.1, 1)));
    if (dice.chance(0.25)) rules.rules.back().left = context();
    if (dice.chance(0.25)) rules.rules.back().right = context();
    if (dice.chance(0.2)) rules.rules.back().condition = length_above(dice.real(1, 4));
  }
  rules.rules.push_back(rule("unit", 1, {any(), any()}, 0.7));
  rules.rules.push_back(rule("single", 1, {any()}, 0.3));
  rules.rules.push_back(rule("tail", 2, {any()}, 0.8));
  rules.rules.push_back(rule("tails", 2, {split(Axis::along, {any(), any()})}, 0.2));
  if (dice.chance(0.4)) {
    Rule::After after;
    after.named = {{dice.whole(0, count - 1), dice.real(0.2, 0.8)}};
    after.others = dice.chance(0.8) ? dice.real(0.1, 0.8) : 0;
    rules.rules[static_cast<std::size_t>(dice.whole(0, count - 1))].after = after;
  }
  rules.background = {dice.chance(0.7) ? dice.real(0.01, 0.2) : 0.0, 0.6, dice.real(1.2, 2.0)};

  SpaceProblem& problem = made.problem;
  problem.id = "s";
  problem.length_m = dice.real(2, 6);
  problem.depth_m = dice.real(3, 6);
  const int scans = dice.whole(0, 4);
  const bool in_order = dice.chance(0.2);
  for (int i = 0; i < scans; ++i) {
    RoomEvidence e;
    e.id = "e" + std::to_string(dice.whole(0, 5));
    e.width_m = dice.real(0.5, 2.5);
    e.width_sigma_m = dice.real(0.02, 0.3);
    if (dice.chance(0.3)) {
      e.other_width_m = dice.chance(0.5) ? problem.depth_m + dice.real(-0.1, 0.1) : dice.real(0.5, 4);
      e.other_sigma_m = 0.05;
    }
    if (!in_order || dice.chance(0.3)) {
      e.centre_m = dice.real(-0.5, problem.length_m + 0.5);
      e.centre_sigma_m = dice.real(0.03, 0.4);
    }
    if (dice.chance(0.4)) {
      e.type = rules.rooms[static_cast<std::size_t>(dice.whole(0, types - 1))].name;
      e.type_confidence = dice.real(0.3, 1);
    }
    problem.rooms.push_back(e);
  }
  if (dice.chance(0.4)) {
    problem.doors_visible = {{dice.real(-0.2, 1), dice.real(2, problem.length_m)}};
    for (int i = dice.whole(0, 4); i > 0; --i)
      problem.doors.push_back(
          {dice.real(0, problem.length_m), dice.real(0.02, 0.2), dice.real(0.2, 0.4), dice.real(0, 0.1)});
  }
  return made;
}

double deviation(double weight, double first, double second) {
  return std::sqrt(std::max(0.0, second / weight - first / weight * first / weight));
}

std::string key_of(const Lattice& lattice, const std::vector<PathStep>& path) {
  std::string key;
  for (const PathStep& step : path) {
    for (const ElementRoom& room : placed_element(lattice, step).rooms) {
      char text[64];
      std::snprintf(text, sizeof text, "%d@%.6f+%.6f,", room.type, room.depth_start_m, room.depth_m);
      key += text;
    }
    key += " ";
  }
  return key;
}

/// Whether the case was compared; cases without any layout, and those with too many, are not.
bool compare(std::uint64_t seed, int& longest) {
  const Case test = make_case(seed);
  FitOptions options;
  options.grid_m = test.step_m;
  const Grid grid = make_grid(test.problem.length_m, test.rules.inner_wall_m, options.grid_m);
  const CompiledRow compiled =
      compile_row(test.rules, {test.problem.depth_m, test.problem.hallway, test.problem.facade}, grid);
  if (compiled.fault) return false;
  const Evidence evidence(test.rules, test.problem, options, grid);
  const auto truth = enumerate_layouts(test.rules, test.problem, evidence, grid, kMostLayouts);
  if (!truth) return false;

  INFO("seed ", seed);
  const Lattice lattice(compiled.row, grid, evidence);
  const NodeTable before = forward(lattice);
  const double total = log_total(lattice, before);
  if (truth->total <= 0) {
    CHECK(!std::isfinite(total));
    return false;
  }
  CHECK(std::abs(total - std::log(truth->total)) < kClose);
  const NodeTable behind = backward(lattice, before);
  const std::vector<double> posteriors = node_posteriors(lattice, before, behind);

  std::vector<double> scores;
  for (const auto& [key, sequence] : truth->sequences)
    if (sequence.weight > kLeastProbability * truth->total) scores.push_back(std::log(sequence.weight));
  std::sort(scores.rbegin(), scores.rend());
  const auto found = most_probable_sequences(lattice, before, behind, posteriors, {6, 100000});
  const std::size_t count = std::min<std::size_t>(6, scores.size());
  REQUIRE(found.size() >= count);
  REQUIRE(!found.empty());
  const std::vector<PathStep> best = sequence_posterior(lattice, *found[0]).best;
  std::vector<SameRoom> alike = rooms_of(lattice, best);
  std::vector<SameWall> walls = walls_of(best);
  const Coverage coverage = cover(lattice, before, behind, posteriors, alike, walls);
  OracleQuestions questions;
  std::vector<OracleRoom>& like = questions.rooms;
  for (const SameWall& wall : walls) questions.walls.emplace_back(wall.cell, 0.0);
  const int tolerance = static_cast<int>(std::lround(kSameWidth_m / grid.step_m));
  for (const SameRoom& room : alike)
    like.push_back({room.channel.type, room.middle, room.width, tolerance, 0, 0});
  (void)enumerate_layouts(test.rules, test.problem, evidence, grid, kMostLayouts, &questions);
  const bool any_unit = std::any_of(coverage.begin(), coverage.end(),
                                    [](const auto& channel) { return channel.first.depth_m >= 0; });
  for (std::size_t i = 0; i < alike.size(); ++i) {
    if (alike[i].channel.depth_m >= 0) continue;
    CHECK(std::abs(alike[i].probability - like[i].weight / truth->total) < kClose);
    if (!any_unit)
      CHECK(std::abs(alike[i].width_deviation_m -
                     grid.step_m * std::sqrt(like[i].square_cells / truth->total)) < kClose);
  }
  for (std::size_t i = 0; i < walls.size(); ++i)
    CHECK(std::abs(walls[i].deviation_m - grid.step_m * std::sqrt(questions.walls[i].second / truth->total)) <
          kClose);
  for (std::size_t i = 0; i < count; ++i) {
    CHECK(std::abs(found[i]->log_weight - scores[i]) < kClose);
    CHECK(std::abs(std::exp(found[i]->log_posterior) - std::exp(scores[i]) / truth->total) < kClose);
    const SequencePosterior posterior = sequence_posterior(lattice, *found[i]);
    const auto same = truth->sequences.find(key_of(lattice, posterior.best));
    REQUIRE(same != truth->sequences.end());
    const OracleSequence& sequence = same->second;
    CHECK(std::abs(found[i]->log_weight - std::log(sequence.weight)) < kClose);
    CHECK(std::abs(posterior.log_best - std::log(sequence.best_layout)) < kClose);
    longest = std::max(longest, static_cast<int>(posterior.best.size()));
    for (std::size_t k = 0; k < posterior.places.size(); ++k) {
      CHECK(std::abs(posterior.places[k].start_sd_m -
                     deviation(sequence.weight, sequence.x[k], sequence.xx[k])) < kClose);
      CHECK(std::abs(posterior.places[k].width_sd_m -
                     deviation(sequence.weight, sequence.w[k], sequence.ww[k])) < kClose);
    }
  }
  for (const auto& [channel, probability] : coverage) {
    if (channel.depth_m >= 0) continue;  // rooms in units
    const std::vector<double>& wanted = truth->coverage[static_cast<std::size_t>(channel.type + 1)];
    for (std::size_t cell = 0; cell < wanted.size(); ++cell)
      CHECK(std::abs(probability[cell] - wanted[cell] / truth->total) < kClose);
  }
  return true;
}

}  // namespace

TEST_CASE("optimum, alternatives, deviations and type probabilities are those of full enumeration") {
  int compared = 0;
  int longest = 0;
  for (std::uint64_t seed = 1; compared < kCases && seed < 20 * kCases; ++seed)
    compared += compare(seed, longest) ? 1 : 0;
  CHECK(compared == kCases);
  CHECK(longest >= 7);
}
