#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "app/derive_svg.h"
#include "app/rules_file.h"
#include "app/verbs.h"
#include "floor/complete_floor.h"
#include "floor/fit_floor.h"
#include "floor/spaces.h"
#include "geometry/error.h"
#include "geometry/file.h"
#include "grammar/derive.h"

namespace gramap {
namespace {

struct Options {
  std::string rules, floor, svg;
  double length_m = 0;
  double depth_m = 5;
  std::string hallway;
  bool no_facade = false;
  std::uint64_t seed = 1;
  int samples = 1;
  bool text = false;
  bool stats = false;
};

constexpr double kBetweenSamples_m = 2;  // in the picture

/// A rectangle of the length and depth asked for, to stand for a space without a floor.
Space bare_space(const Options& options) {
  Space space;
  space.id = "space";
  space.hallway = options.hallway;
  space.end = {options.length_m, 0};
  space.outline = {{0, 0}, {options.length_m, 0}, {options.length_m, options.depth_m}, {0, options.depth_m}};
  return space;
}

/// The space again, as the i-th sample, farther up in the picture.
Space numbered(Space space, std::size_t i, double up_m) {
  space.id += std::to_string(i + 1);
  for (Vec2& point : space.outline) point.y() += up_m;
  space.start.y() += up_m;
  space.end.y() += up_m;
  return space;
}

void print_tree(const RuleSet& rules, const Derivation& derivation) {
  std::vector<bool> printed(derivation.tree.uses.size(), false);
  std::vector<int> made_by;
  for (const std::vector<int>& element : derivation.tree.rooms)
    made_by.insert(made_by.end(), element.begin(), element.end());
  for (std::size_t room = 0; room < derivation.rooms.size(); ++room) {
    std::vector<int> chain;
    for (int use = made_by[room]; use >= 0; use = derivation.tree.uses[static_cast<std::size_t>(use)].parent)
      chain.insert(chain.begin(), use);
    for (std::size_t depth = 0; depth < chain.size(); ++depth) {
      const auto use = static_cast<std::size_t>(chain[depth]);
      if (printed[use]) continue;
      printed[use] = true;
      const Rule& rule = rules.rules[static_cast<std::size_t>(derivation.tree.uses[use].rule)];
      std::printf("%*s%s: %s\n", static_cast<int>(2 * depth), "", rule.name.c_str(),
                  rules.symbols[static_cast<std::size_t>(rule.symbol)].c_str());
    }
    const PlacedRoom& placed = derivation.rooms[room];
    std::printf("%*s%s at %.3f m, %.3f m wide", static_cast<int>(2 * chain.size()), "", placed.type.c_str(),
                placed.start_m, placed.width_m);
    if (placed.depth_m >= 0)
      std::printf(", %.3f m to %.3f m deep", placed.depth_start_m, placed.depth_start_m + placed.depth_m);
    std::printf("\n");
  }
}

/// Mean and its standard error.
struct Average {
  double sum = 0, squares = 0;
  int count = 0;
  void add(double value) {
    sum += value;
    squares += value * value;
    ++count;
  }
  double mean() const { return count > 0 ? sum / count : 0; }
  double sd() const { return count > 0 ? std::sqrt(std::max(0.0, squares / count - mean() * mean())) : 0; }
  double error() const { return count > 0 ? sd() / std::sqrt(count) : 0; }
};

void print_statistics(const RuleSet& rules, const SpaceDeriver& deriver,
                      const std::vector<Derivation>& drawn) {
  const DerivationStatistics exact = exact_statistics(rules, deriver);
  std::vector<std::string> names;
  for (const RoomType& type : rules.rooms) names.push_back(type.name);
  names.push_back("Unknown");
  std::printf("%-20s %10s %20s %18s %18s\n", "room", "expected", "drawn", "width m", "drawn");
  for (std::size_t type = 0; type < names.size(); ++type) {
    if (type + 1 == names.size() && exact.rooms[type] <= 0) continue;
    Average counts;
    Average widths;
    for (const Derivation& derivation : drawn) {
      int count = 0;
      for (const PlacedRoom& room : derivation.rooms) {
        if (room.type != names[type]) continue;
        ++count;
        widths.add(room.width_m);
      }
      counts.add(count);
    }
    std::printf("%-20s %10.4f %10.4f +- %6.4f %8.3f +- %6.3f %8.3f +- %6.3f\n", names[type].c_str(),
                exact.rooms[type], counts.mean(), counts.error(), exact.width_mean_m[type],
                exact.width_sd_m[type], widths.mean(), widths.sd());
  }
  std::printf("%-20s %10s %20s %18s\n", "rule", "expected", "drawn", "in the file");
  for (std::size_t r = 0; r < rules.rules.size(); ++r) {
    Average uses;
    for (const Derivation& derivation : drawn)
      uses.add(static_cast<double>(
          std::count_if(derivation.tree.uses.begin(), derivation.tree.uses.end(),
                        [&](const RuleUse& use) { return use.rule == static_cast<int>(r); })));
    std::printf("%-20s %10.4f %10.4f +- %6.4f %18.4f\n", rules.rules[r].name.c_str(), exact.rules[r],
                uses.mean(), uses.error(), rules.rules[r].probability);
  }
  std::printf("probability that a derivation fills this length to a grid step: %.3g\n",
              std::exp(exact.log_probability));
}

int run(const Options& options) {
  const RuleSet file_rules = read_rules(options.rules);
  FloorGroundTruth floor;
  std::vector<SpaceProblem> problems;
  RuleSet rules = file_rules;
  if (!options.floor.empty()) {
    floor = read_floor(options.floor);
    check_floor(floor, options.floor);
    rules = rules_on_floor(file_rules, floor);
    for (const std::string& sentence : complete_floor(floor, rules, options.seed))
      std::fprintf(stderr, "gramap: %s\n", sentence.c_str());
    std::vector<SetAsideInput> set_aside;
    problems = space_problems(floor, rules, {}, {}, set_aside);
  } else {
    floor.spaces = {bare_space(options)};
    SpaceProblem problem;
    problem.id = "space";
    problem.length_m = options.length_m;
    problem.depth_m = options.depth_m;
    problem.hallway = options.hallway;
    problem.facade = !options.no_facade;
    problems = {problem};
  }

  FILE* const out = options.svg == "-" ? stderr : stdout;
  FloorGroundTruth pictured = floor;  // with a space for each sample of a length
  if (options.floor.empty()) pictured.spaces.clear();
  std::vector<SpaceProblem> pictured_problems;
  std::vector<SpaceFit> pictured_layouts;
  double height_m = kBetweenSamples_m;
  for (const Space& space : floor.spaces)
    for (const Vec2& p : space.outline)
      for (const Vec2& q : space.outline) height_m = std::max(height_m, p.y() - q.y() + kBetweenSamples_m);
  for (std::size_t s = 0; s < problems.size(); ++s) {
    const SpaceDeriver deriver(rules, problems[s]);
    // Each space draws from a stream of its own.
    const std::vector<Derivation> drawn = deriver.draw(options.samples, options.seed + 0x9e37 * s);
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      if (options.text) {
        std::printf("%s%s, sample %zu\n", i + s == 0 ? "" : "\n", problems[s].id.c_str(), i + 1);
        print_tree(rules, drawn[i]);
      } else if (!options.stats) {
        std::fprintf(out, "%s:", problems[s].id.c_str());
        for (const PlacedRoom& room : drawn[i].rooms)
          std::fprintf(out, " %s %.2f", room.type.c_str(), room.width_m);
        std::fprintf(out, "\n");
      }
      if (options.svg.empty() || (!options.floor.empty() && i > 0)) continue;
      if (options.floor.empty())
        pictured.spaces.push_back(numbered(floor.spaces[s], i, -height_m * static_cast<double>(i)));
      pictured_problems.push_back(problems[s]);
      pictured_layouts.emplace_back().best.rooms = drawn[i].rooms;
    }
    if (options.stats) {
      if (problems.size() > 1) std::printf("%s\n", problems[s].id.c_str());
      print_statistics(rules, deriver, drawn);
    }
  }
  if (!options.svg.empty()) {
    FittedFloor fitted = floor_of_layouts(pictured, rules, pictured_problems, pictured_layouts);
    if (options.no_facade)
      for (FittedRoom& room : fitted.rooms)
        std::erase_if(room.openings, [](const FittedOpening& opening) { return opening.kind == "window"; });
    write_file(options.svg, derivation_svg(fitted));
  }
  return kDone;
}

}  // namespace

Verb declare_derive(CLI::App& gramap) {
  auto options = std::make_shared<Options>();
  CLI::App* verb = gramap.add_subcommand("derive", "Draw layouts from a rule file's distribution");
  verb->add_option("rules", options->rules, "The rule file")->required();
  CLI::Option* length =
      verb->add_option("--length", options->length_m, "Clear length of a space to derive, metres");
  length->check(CLI::PositiveNumber);
  CLI::Option* floor = verb->add_option(
      "--floor", options->floor,
      "A floor whose spaces to derive; with an outline alone its hallways grow from the rules");
  floor->excludes(length);
  verb->add_option("--depth", options->depth_m, "Clear depth of the space of --length, metres")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  verb->add_option("--hallway", options->hallway, "The hallway that the space of --length lies on");
  verb->add_flag("--no-facade", options->no_facade, "The space of --length has no façade");
  verb->add_option("--seed", options->seed, "The same seed draws the same layouts")->capture_default_str();
  verb->add_option("--samples", options->samples, "How many layouts to draw for each space")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  verb->add_option("--svg", options->svg,
                   "Draw a picture into this file (- for standard output): all samples of a length one below "
                   "the other, the first sample of a floor");
  verb->add_flag("--text", options->text, "Print every layout as its derivation tree");
  verb->add_flag("--stats", options->stats,
                 "Print room counts, widths and uses of rules over the samples beside what the rules promise "
                 "exactly for this length");
  return [options] {
    if (options->length_m <= 0 && options->floor.empty())
      throw InputError({}, "nothing to derive", "give --length METRES or --floor FLOOR");
    return run(*options);
  };
}

}  // namespace gramap
