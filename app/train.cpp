// `gramap train`: the forests that tell doors, windows and furniture apart, made again from simulated scans.
#include <tbb/parallel_for.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/ablation.h"
#include "app/verbs.h"
#include "floor/building.h"
#include "geometry/error.h"
#include "geometry/file.h"
#include "perception/perceive.h"
#include "perception/random_building.h"
#include "perception/training.h"
#include "perception/truth_match.h"

namespace gramap {
namespace {

namespace fs = std::filesystem;

struct Arguments {
  std::string task = "openings";
  std::string output, model;
  std::vector<std::string> test_floors;
  int buildings = 60;
  int trees = 100;
  double held_out = 0.25;
  std::uint64_t seed = 1;
  bool mistakes = false;
  bool ablation = false;
};

Task task_named(const std::string& name) {
  return name == "openings" ? opening_task() : furniture_task();
}

/// Whole buildings go to one side or the other.
bool is_held_out(const Arguments& arguments, int building) {
  Random random(seed_for(arguments.seed, "split " + std::to_string(building)));
  return random.chance(arguments.held_out);
}

std::vector<TrainingRoom> simulated_building(const Arguments& arguments, int building, double noise = 1) {
  const std::uint64_t seed = seed_for(arguments.seed, "building " + std::to_string(building));
  SimulateOptions options = random_conditions(seed);
  options.noise_m *= noise;
  options.noise_growth_per_m *= noise;
  return known_rooms(random_building(seed), options, building);
}

std::vector<TrainingRoom> noisy_held_out(const Arguments& arguments, double noise) {
  std::vector<TrainingRoom> rooms;
  for (int building = 0; building < arguments.buildings; ++building) {
    if (!is_held_out(arguments, building)) continue;
    std::vector<TrainingRoom> more = simulated_building(arguments, building, noise);
    std::move(more.begin(), more.end(), std::back_inserter(rooms));
  }
  return rooms;
}

using KnownFloors = std::vector<std::pair<std::string, std::vector<TrainingRoom>>>;

void print_confusion(const Forest& forest, const std::vector<Sample>& samples) {
  std::printf("\nheld-out samples, rows: truth, columns: the forest's answer\n%-10s", "");
  for (const std::string& name : forest.classes) std::printf(" %8s", name.c_str());
  std::printf("\n");
  const auto counts = confusion(forest, samples);
  for (std::size_t row = 0; row < counts.size(); ++row) {
    std::printf("%-10s", forest.classes[row].c_str());
    for (const int count : counts[row]) std::printf(" %8d", count);
    std::printf("\n");
  }
}

void print_importance(const Forest& forest, const std::vector<Sample>& samples, std::uint64_t seed) {
  std::printf("\naccuracy lost without the feature (its values shuffled)\n");
  const std::vector<double> lost = feature_importance(forest, samples, seed);
  for (std::size_t i = 0; i < lost.size(); ++i)
    std::printf("%-16s %7.4f\n", forest.features[i].c_str(), lost[i]);
}

Forest trained(const Task& task, const Arguments& arguments, const KnownFloors& floors) {
  std::vector<Sample> train, held_out;
  Scores scores;
  std::vector<TrainingRoom> held_out_rooms;
  for (int building = 0; building < arguments.buildings; ++building) {
    std::vector<TrainingRoom> rooms = simulated_building(arguments, building);
    std::vector<std::vector<Sample>> each(rooms.size());
    tbb::parallel_for(std::size_t{0}, rooms.size(), [&](std::size_t i) { each[i] = task.samples(rooms[i]); });
    const bool apart = is_held_out(arguments, building);
    for (const auto& samples : each)
      (apart ? held_out : train).insert((apart ? held_out : train).end(), samples.begin(), samples.end());
    if (apart) std::move(rooms.begin(), rooms.end(), std::back_inserter(held_out_rooms));
    std::fprintf(stderr, "building %d of %d\n", building + 1, arguments.buildings);
  }
  ForestOptions options;
  options.seed = arguments.seed;
  options.trees = arguments.trees;
  if (train.empty()) throw InputError({}, "there is nothing to train on", "ask for more buildings");
  Forest forest = train_forest(task.name, task.features, task.classes, train, options);
  std::printf("%zu samples to train on, %zu held out\n", train.size(), held_out.size());
  print_confusion(forest, held_out);
  print_importance(forest, held_out, arguments.seed);
  print_scores("held-out simulated buildings", score_rooms(task, forest, held_out_rooms), arguments.mistakes);
  if (arguments.ablation)
    print_ablation(
        task, train, options, held_out_rooms, [&](double noise) { return noisy_held_out(arguments, noise); },
        floors);
  return forest;
}

/// The scans of a floor whose truth is known, perceived as any other; rooms that cannot be perceived count as
/// rooms in which nothing was found.
std::vector<TrainingRoom> perceived_floor(const fs::path& floor) {
  const Building building = building_of(read_truth(floor));
  std::vector<TrainingRoom> rooms(building.rooms.size());
  tbb::parallel_for(std::size_t{0}, rooms.size(), [&](std::size_t i) {
    const BuildingRoom& room = building.rooms[i];
    if (!fs::exists(floor / "scans" / room.id)) return;
    rooms[i].truth = room;
    try {
      PerceptionOptions options;
      options.find_furniture = false;  // the openings tell which way round the room is
      Perception found = perceive(registered(read_room_scans(floor / "scans" / room.id)), room.id, options);
      rooms[i].cloud = std::move(found.cloud);
      rooms[i].room = std::move(found.observation);
      rooms[i].truth = aligned_truth(room, rooms[i].room);
    } catch (const InputError& error) {
      std::fprintf(stderr, "%s: %s\n", room.id.c_str(), error.what());
    }
  });
  std::erase_if(rooms, [](const TrainingRoom& known) { return known.truth.id.empty(); });
  return rooms;
}

int train(const Arguments& arguments) {
  const Task task = task_named(arguments.task);
  KnownFloors floors;
  for (const std::string& floor : arguments.test_floors) floors.emplace_back(floor, perceived_floor(floor));
  const Forest forest = arguments.model.empty()
                            ? trained(task, arguments, floors)
                            : forest_from_text(read_file(arguments.model), task.name, task.features,
                                               task.classes, arguments.model);
  for (const auto& [name, rooms] : floors)
    print_scores(name, score_rooms(task, forest, rooms), arguments.mistakes);
  if (!arguments.output.empty()) {
    const std::string text = to_text(forest);
    write_file(arguments.output, text);
    std::fprintf(stderr, "%s: %zu trees, %zu bytes, hash %s\n", arguments.output.c_str(), forest.roots.size(),
                 text.size(), hash_hex(text).c_str());
  }
  return kDone;
}

}  // namespace

Verb declare_train(CLI::App& gramap) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* verb = gramap.add_subcommand(
      "train", "Make the forest that tells doors and windows, or furniture, apart, and say how good it is");
  verb->add_option("task", arguments->task, "What to train for")
      ->required()
      ->check(CLI::IsMember({"openings", "furniture"}));
  verb->add_option("-o,--output", arguments->output, "Model file to write");
  verb->add_option("--buildings", arguments->buildings, "Buildings made up at random, scanned and trained on")
      ->check(CLI::Range(2, 10000))
      ->capture_default_str();
  verb->add_option("--held-out", arguments->held_out,
                   "Share of the buildings kept apart to score the forest on")
      ->check(CLI::Range(0.05, 0.9))
      ->capture_default_str();
  verb->add_option("--trees", arguments->trees, "Trees of the forest")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  verb->add_option("--seed", arguments->seed, "Everything random comes from it: same seed, same model")
      ->capture_default_str();
  verb->add_option("--model", arguments->model, "Score this model file instead of training one");
  verb->add_option("--test", arguments->test_floors,
                   "Floor folders with scans and truth.geojson to score on as well; never trained on");
  verb->add_flag("--mistakes", arguments->mistakes, "List everything missed and everything found in vain");
  verb->add_flag("--ablation", arguments->ablation,
                 "Also print recall and precision without each group of features, with a single scanner "
                 "position, and at two and three times the noise")
      ->excludes(verb->get_option("--model"));
  return [arguments] { return train(*arguments); };
}

}  // namespace gramap
