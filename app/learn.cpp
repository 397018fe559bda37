#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "app/read_known_floors.h"
#include "app/verbs.h"
#include "floor/known_rows.h"
#include "geometry/file.h"
#include "geometry/say.h"
#include "grammar/learn.h"
#include "grammar/learn_update.h"

namespace gramap {
namespace {

struct LearnArguments {
  std::vector<std::string> floors;
  std::string output = "-";
  double wall_m = 0.2;
  LearnOptions options;
  std::string update;
  UpdateOptions updating;
};

/// Refines a rule file that is there.
int update(const LearnArguments& arguments, const LearnData& data, bool set_aside) {
  const UpdatedRules updated =
      update_rules(read_file(arguments.update), arguments.update, data, arguments.updating);
  write_file(arguments.output, updated.text);
  for (const std::string& row : updated.unfilled)
    std::fprintf(stderr, "gramap: warning: the rules cannot make the row of %s; nothing is learned from it\n",
                 row.c_str());
  for (const std::string& rule : updated.left_alone)
    std::fprintf(stderr, "gramap: note: the probability of %s is no plain number and stays as it is\n",
                 rule.c_str());
  std::fprintf(
      stderr, "gramap: wrote %s and %s anew\n",
      said_count(static_cast<std::size_t>(updated.probabilities), "probability", "probabilities").c_str(),
      said_count(static_cast<std::size_t>(updated.widths), "number of widths", "numbers of widths").c_str());
  return updated.unfilled.empty() && !set_aside ? kDone : kSetAside;
}

int learn(const LearnArguments& arguments) {
  KnownFloors known;
  for (const std::string& path : arguments.floors) read_known_floors(path, arguments.wall_m, known);
  const bool set_aside = report_on_reading(known);
  const LearnData data = learn_data(known.floors, known.truths, known.unseen);
  if (!arguments.update.empty()) return update(arguments, data, set_aside);
  const LearnedRules rules = learn_rules(data, arguments.options);
  write_file(arguments.output, to_text(rules));
  std::size_t rooms = 0;
  for (const KnownRow& row : rules.data.rows) rooms += row.rooms.size();
  std::fprintf(stderr, "gramap: learned %s for %s from %s in %s\n",
               said_count(rules.rules.size(), "rule").c_str(),
               said_count(rules.types.size(), "room type").c_str(), said_count(rooms, "room").c_str(),
               said_count(rules.data.rows.size(), "space").c_str());
  return set_aside ? kSetAside : kDone;
}

}  // namespace

Verb declare_learn(CLI::App& gramap) {
  auto arguments = std::make_shared<LearnArguments>();
  CLI::App* verb = gramap.add_subcommand("learn", "Learn a rule file from floors whose rooms are known");
  verb->add_option(
          "floors", arguments->floors,
          "Floor folders with their truth, GeoJSON files that hold it, OpenStreetMap indoor plans, IMDF "
          "archives, zipped or not (every level is a floor; FILE#LEVEL takes one), or fitted models (.glb, "
          ".gltf: what was "
          "scanned counts, derived rooms do not)")
      ->required();
  verb->add_option("-o,--output", arguments->output, "The rule file to write; - is standard output")
      ->capture_default_str();
  verb->add_option("--name", arguments->options.name, "Name of the grammar")->capture_default_str();
  verb->add_option(
      "--update", arguments->update,
      "Refine this rule file instead: the probabilities of its rules and the widths of its rooms "
      "are re-estimated with the floors where they are plain numbers; everything else in it "
      "stays as it is");
  verb->add_option(
          "--weight", arguments->updating.weight,
          "With --update: how many uses of each symbol, and rooms of each type, the file's own numbers "
          "are worth")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  verb->add_option("--wall", arguments->wall_m,
                   "Thickness in metres of inner walls that a plan draws as lines")
      ->check(CLI::Range(0.01, 1.0))
      ->capture_default_str();
  verb->add_option("--resolution", arguments->options.resolution_m,
                   "How exactly the plans are drawn, in metres: no spread is taken to be smaller")
      ->check(CLI::Range(0.001, 1.0))
      ->capture_default_str();
  verb->add_flag(
      "--types-by-width", arguments->options.types_by_width,
      "Rooms that the plan gives no type: a type for each width, instead of one in several widths");
  verb->add_flag("--uniform", arguments->options.uniform,
                 "Give all rules of a symbol the same probability: a baseline for comparisons");
  return [arguments] { return learn(*arguments); };
}

}  // namespace gramap
