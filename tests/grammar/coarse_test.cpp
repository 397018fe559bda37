// The coarse look may leave out nothing that matters: sums, optimum and deviations with it equal those of the
// whole lattice.
#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "grammar/coarse.h"
#include "grammar/inference.h"
#include "grammar/lattice.h"
#include "grammar/sequence.h"
#include "grammar/sequence_search.h"
#include "tests/grammar/rule_maker.h"

using namespace gramap;
using namespace gramap::test;

namespace {

struct Draws {
  std::mt19937_64 random;
  double uniform() { return static_cast<double>(random() >> 11) * 0x1p-53; }
  double normal() { return std::sqrt(-2 * std::log(1 - uniform())) * std::cos(2 * M_PI * uniform()); }
};

/// Eight rooms in a row of which some were scanned: well, short by a cupboard, twice, or somewhere else; with
/// the doors that a hallway shows of them, now and then.
SpaceProblem random_space(Draws& draws, double wall_m) {
  SpaceProblem problem;
  problem.id = "north";
  problem.depth_m = 5;
  problem.hallway = "H";
  const bool has_doors = draws.uniform() < 0.5;
  double x = 0;
  for (int i = 0; i < 8; ++i) {
    const double u = draws.uniform();
    const double width = (u < 0.5 ? 2.8 : u < 0.7 ? 5.8 : u < 0.9 ? 1.8 : 1 + 6 * draws.uniform());
    const auto scan = [&](double start_m, double width_m) {
      RoomEvidence e;
      e.id = std::to_string(problem.rooms.size());
      e.width_sigma_m = 0.005 + 0.03 * draws.uniform();
      e.width_m = width_m + e.width_sigma_m * draws.normal();
      e.centre_sigma_m = 0.01 + 0.3 * draws.uniform();
      e.centre_m = start_m + 0.5 * width_m + e.centre_sigma_m * draws.normal();
      problem.rooms.push_back(e);
    };
    if (draws.uniform() < 0.5) scan(x, width);
    if (draws.uniform() < 0.1) scan(x, width);
    if (draws.uniform() < 0.1) scan(x + 0.5, std::max(0.6, width - 0.5));
    if (draws.uniform() < 0.05) scan(20 * draws.uniform(), 3);
    if (has_doors) problem.doors.push_back({x + 0.7 + 0.02 * draws.normal(), 1, 0.02, 0});
    x += width + wall_m;
  }
  problem.length_m = x - wall_m;
  if (has_doors) problem.doors_visible.push_back({0, problem.length_m});
  return problem;
}

}  // namespace

TEST_CASE("the coarse look leaves out nothing that matters") {
  const RuleSet rules = office_rules();
  const FitOptions options;
  Draws draws{std::mt19937_64(1)};
  int restricted = 0;
  for (int i = 0; i < 40; ++i) {
    const SpaceProblem problem = random_space(draws, rules.inner_wall_m);
    CAPTURE(i);
    const Grid grid = make_grid(problem.length_m, rules.inner_wall_m, options.grid_m);
    const CompiledRow compiled = compile_row(rules, {problem.depth_m, problem.hallway, problem.facade}, grid);
    const Evidence evidence(rules, problem, options, grid);
    struct Found {
      double log_total;
      std::vector<SequencePosterior> sequences;
      std::vector<double> log_posteriors;
    };
    const auto find = [&](const Lattice& lattice) {
      const NodeTable before = forward(lattice), behind = backward(lattice, before);
      Found found{log_total(lattice, before), {}, {}};
      const auto posteriors = node_posteriors(lattice, before, behind);
      for (const auto& sequence : most_probable_sequences(lattice, before, behind, posteriors, {2, 24})) {
        found.sequences.push_back(sequence_posterior(lattice, *sequence));
        found.log_posteriors.push_back(sequence->log_posterior);
      }
      return found;
    };
    Lattice lattice(compiled.row, grid, evidence);
    const Found whole = find(lattice);
    NodeMask mask = coarse_mask(rules, problem, options, lattice);
    for (const auto& state : mask.alive)
      for (const bool alive : state) restricted += alive ? 0 : 1;
    lattice.restrict(std::move(mask));
    const Found masked = find(lattice);

    CHECK(std::abs(masked.log_total - whole.log_total) < 1e-4);
    REQUIRE(masked.sequences.size() == whole.sequences.size());
    for (std::size_t s = 0; s < whole.sequences.size(); ++s) {
      CHECK(std::abs(std::exp(masked.log_posteriors[s]) - std::exp(whole.log_posteriors[s])) < 1e-4);
      // Sequences may be alike to the last digit; their order is not held to.
      const auto &of_masked = masked.sequences[s].places, &of_whole = whole.sequences[s].places;
      REQUIRE(of_masked.size() == of_whole.size());
      for (std::size_t k = 0; k < of_whole.size(); ++k)
        CHECK(std::abs(of_masked[k].start_sd_m - of_whole[k].start_sd_m) < 1e-4);
    }
  }
  CHECK(restricted > 1000);
}
