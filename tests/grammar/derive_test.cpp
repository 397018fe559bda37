// What derive draws against what the rules mean: for every shipped rule file, how often rules and neighbours
// show in samples, beside their exact probabilities from the sums over all layouts. GRAMAP_DERIVE_SAMPLES
// sets how many (100,000 unless set).
#include "grammar/derive.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>

#include "golden.h"
#include "grammar/inference.h"
#include "grammar/language.h"

using namespace gramap;

namespace {

constexpr int kEnd = -2;             // as the neighbour: the end of the space
constexpr double kMostSigmas = 4.5;  // with fixed seeds: a defect, not chance

using Pair = std::pair<int, int>;  // the rules that placed two neighbouring elements

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

class Exact {
 public:
  explicit Exact(const SpaceDeriver& deriver)
      : lattice_(deriver.lattice()),
        forward_(deriver.forward_sums()),
        backward_(deriver.backward_sums()),
        edges_(lattice_) {}

  int rule(const Arc& arc) const { return lattice_.row().elements[at(arc.element)].rooms.front().rule; }

  /// Probabilities of the rules of the element over a cell and of the one behind it.
  std::map<Pair, double> neighbours(int middle) {
    std::map<std::pair<int, std::pair<int, int>>, double> arrivals;  // rule; cell and state behind it
    const double total = log_total(lattice_, forward_);
    for (int cell = 0; cell <= middle; ++cell) {
      for_each_node(lattice_, cell, [&](int e, int state, std::size_t node) {
        if (forward_.value[node] <= 0) return;
        for_each_edge(cell, state, e, [&](const Arc& arc, int target, double log_scale, double weight) {
          if (target > middle)
            arrivals[{rule(arc), {target, arc.target}}] +=
                forward_.value[node] * weight * std::exp(forward_.log_scale[at(cell)] + log_scale - total);
        });
      });
    }
    std::map<Pair, double> pairs;
    std::map<std::pair<int, int>, std::map<int, double>> behind;
    for (const auto& [arrival, probability] : arrivals) {
      auto [place, fresh] = behind.try_emplace(arrival.second);
      if (fresh) place->second = next(arrival.second.first, arrival.second.second);
      for (const auto& [rule, share] : place->second) pairs[{arrival.first, rule}] += probability * share;
    }
    return pairs;
  }

 private:
  template <class Visit>
  void for_each_edge(int cell, int state, int e, Visit visit) {
    for (const Arc& arc : lattice_.arcs(state, cell))
      for (const Move& move : edges_.moves(cell, arc.element, e))
        for (int i = 0; i < move.count; ++i) {
          const int target = move.first_cell + i * move.stride;
          const double weight = arc.probability * move.sum[i] *
                                backward_.value[lattice_.node(target, arc.target, move.target_evidence)];
          if (weight > 0) visit(arc, target, backward_.log_scale[at(target)], weight);
        }
  }

  std::map<int, double> next(int cell, int state) {
    if (cell == lattice_.grid().cells) return {{kEnd, 1}};
    std::map<int, double> shares;
    double sum = 0;
    const double here = backward_.log_scale[at(cell)];
    for_each_edge(cell, state, 0, [&](const Arc& arc, int, double log_scale, double weight) {
      const double w = weight * std::exp(log_scale - here);
      shares[rule(arc)] += w;
      sum += w;
    });
    for (auto& [rule, share] : shares) share /= sum;
    return shares;
  }

  const Lattice& lattice_;
  const NodeTable& forward_;
  const NodeTable& backward_;
  Edges edges_;
};

/// How many standard deviations a chi-square lies above its mean (Wilson and Hilferty 1931).
double sigmas(double chi_square, int freedom) {
  const double k = freedom;
  return (std::cbrt(chi_square / k) - (1 - 2 / (9 * k))) / std::sqrt(2 / (9 * k));
}

struct Sums {
  double sum = 0, squares = 0;
};

void compare(const RuleSet& rules, double length_m, int samples) {
  CAPTURE(length_m);
  SpaceProblem space;
  space.id = "space";
  space.length_m = length_m;
  space.depth_m = 7;
  const SpaceDeriver deriver(rules, space, 0.02);
  const Lattice& lattice = deriver.lattice();
  Exact exact(deriver);
  const int middle = lattice.grid().cells / 2;

  std::map<Pair, int> seen;
  std::vector<Sums> uses(rules.rules.size());
  constexpr int kAtOnce = 5000;
  for (int done = 0, seed = 1; done < samples; done += kAtOnce, ++seed) {
    for (const Derivation& drawn : deriver.draw(std::min(kAtOnce, samples - done), at(seed))) {
      int cells = 0;
      Pair pair{kEnd, kEnd};
      for (const PathStep& step : drawn.path) {
        const int rule = exact.rule(lattice.arcs(step.state, step.cell)[at(step.arc)]);
        if (step.cell <= middle) pair.first = rule;
        if (step.cell > middle && pair.second == kEnd) pair.second = rule;
        cells += step.width;
      }
      REQUIRE(cells == lattice.grid().cells);
      double end_m = -rules.inner_wall_m;  // of the rooms at the hallway and the walls between them
      for (const PlacedRoom& room : drawn.rooms) {
        if (room.depth_m >= 0 && room.depth_start_m > 0) continue;
        REQUIRE(std::abs(room.start_m - (end_m + rules.inner_wall_m)) < 1e-9);
        end_m = room.start_m + room.width_m;
      }
      REQUIRE(std::abs(end_m - length_m) < 1e-9);
      ++seen[pair];
      std::vector<int> count(uses.size());
      for (const RuleUse& use : drawn.tree.uses)
        if (use.rule >= 0) ++count[at(use.rule)];
      for (std::size_t r = 0; r < uses.size(); ++r)
        uses[r].sum += count[r], uses[r].squares += static_cast<double>(count[r]) * count[r];
    }
  }

  double chi_square = 0, rare_seen = 0, rare_expected = 0, total = 0;
  int classes = 0;
  for (const auto& [pair, probability] : exact.neighbours(middle)) {
    const double expected = probability * samples;
    const double found = seen.contains(pair) ? seen.at(pair) : 0;
    total += probability;
    seen.erase(pair);
    if (expected < 10) {
      rare_seen += found, rare_expected += expected;
      continue;
    }
    chi_square += (found - expected) * (found - expected) / expected;
    ++classes;
  }
  CHECK(seen.empty());  // nothing is drawn that cannot be
  CHECK(total == doctest::Approx(1));
  if (rare_expected >= 10)
    chi_square += (rare_seen - rare_expected) * (rare_seen - rare_expected) / rare_expected, ++classes;
  REQUIRE(classes > (rules.rules.size() > 1 ? 1 : 0));  // a single rule has itself for a neighbour
  MESSAGE(rules.name << " at " << length_m << " m: chi-square " << chi_square << " of " << classes
                     << " classes of neighbours");
  if (classes > 1) CHECK(sigmas(chi_square, classes - 1) < kMostSigmas);

  const DerivationStatistics expected = exact_statistics(rules, deriver);
  for (std::size_t r = 0; r < uses.size(); ++r) {
    CAPTURE(rules.rules[r].name);
    const double mean = uses[r].sum / samples;
    const double error = std::sqrt(std::max(0.0, uses[r].squares / samples - mean * mean) / samples);
    CHECK(std::abs(mean - expected.rules[r]) < kMostSigmas * error + 10.0 / samples);
  }
}

}  // namespace

TEST_CASE("a symbol with a size is a unit whose rules compete for it") {
  const CheckedRules checked = check_rules(
      "grammar inn; wall inner 0.20 m, outer 0.30 m; room Bed { } room Bath { } room Hall { }\n"
      "start Row;\n"
      "row: Row -> split x { 3.60 m +- 5 cm : Unit, ~ : Row };\n"
      "unit: Unit -> split y { 2 m : Front, ~ : Bed } : 0.75;\n"
      "plain: Unit -> split x { ~ : Bed } : 0.25;\n"
      "front: Front -> split x { 1.50 m : Bath, ~ : Hall };\n",
      "inn");
  REQUIRE(checked.rules);
  SpaceProblem space;
  space.id = "space";
  space.length_m = 4 * 3.60 + 3 * 0.20;
  space.depth_m = 6;
  const SpaceDeriver deriver(*checked.rules, space, 0.01);
  const DerivationStatistics exact = exact_statistics(*checked.rules, deriver);
  const std::vector<double> uses{4, 3, 1, 3}, rooms{4, 3, 3};
  for (std::size_t i = 0; i < uses.size(); ++i) CHECK(exact.rules[i] == doctest::Approx(uses[i]));
  for (std::size_t i = 0; i < rooms.size(); ++i) CHECK(exact.rooms[i] == doctest::Approx(rooms[i]));
  const auto drawn = deriver.draw(4000, 1);
  std::vector<double> count(4);
  for (const Derivation& one : drawn) {
    for (const RuleUse& use : one.tree.uses) count[at(use.rule)] += 1.0 / 4000;
    for (const PlacedRoom& room : one.rooms) {
      const std::vector<std::string> path = room.type != "Bed"
                                                ? std::vector<std::string>{"row", "unit", "front"}
                                            : room.depth_m < 0 ? std::vector<std::string>{"row", "plain"}
                                                               : std::vector<std::string>{"row", "unit"};
      REQUIRE(room.rule_path == path);
    }
  }
  for (std::size_t i = 0; i < uses.size(); ++i) CHECK(std::abs(count[i] - uses[i]) < 0.06);
}

TEST_CASE("shipped rules fill spaces of any length with rooms that they know") {
  for (const auto& file : test::files_in(GRAMAP_SOURCE_DIR "/rules", ".grammar")) {
    CAPTURE(file.string());
    const RuleSet rules = *check_rules(read_file(file), file.string()).rules;
    for (const bool facade : {true, false}) {
      for (double length_m = 4; length_m < (facade ? 60 : 16); length_m += facade ? 1.93 : 0.77) {
        CAPTURE(facade);
        CAPTURE(length_m);
        SpaceProblem space;
        space.id = "space";
        space.length_m = length_m;
        space.depth_m = 7;
        space.facade = facade;
        const SpaceDeriver deriver(rules, space, 0.02);
        CHECK(exact_statistics(rules, deriver).rooms.back() < 0.15);
      }
    }
  }
}

TEST_CASE("rules and neighbours show in samples as often as they should") {
  const char* wish = std::getenv("GRAMAP_DERIVE_SAMPLES");
  const int samples = wish ? std::max(1000, std::atoi(wish)) : 100000;
  for (const auto& file : test::shipped_rule_files()) {
    CAPTURE(file.string());
    compare(*check_rules(read_file(file), file.string()).rules, 31.40, samples);
  }
}
