// `gramap train`: the forests that tell doors, windows and furniture apart, made again from simulated scans.
#include <tbb/parallel_for.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/ablation.h"
#include "app/png.h"
#include "app/score_table.h"
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
  std::string output, model, pictures;
  std::vector<std::string> test_floors;
  std::optional<int> buildings;  ///< to score a given model on none, unless asked for
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

std::vector<ForestEvidence> evidence_of(const Task& task, const std::vector<TrainingRoom>& rooms) {
  std::vector<ForestEvidence> evidence(rooms.size());
  tbb::parallel_for(std::size_t{0}, rooms.size(),
                    [&](std::size_t i) { evidence[i] = task.evidence(rooms[i]); });
  return evidence;
}

TrainingRoom with_first_position(TrainingRoom room) {
  if (room.cloud.parts.size() < 2) return room;
  room.cloud.parts.resize(1);
  room.cloud.points_m.resize(room.cloud.parts[0].end);
  return room;
}

/// The held-out buildings scanned again, under other conditions.
std::vector<ForestEvidence> held_out_again(const Task& task, const Arguments& arguments, double noise,
                                           bool one_position) {
  std::vector<ForestEvidence> evidence;
  for (int building = 0; building < *arguments.buildings; ++building) {
    if (!is_held_out(arguments, building)) continue;
    std::vector<TrainingRoom> rooms = simulated_building(arguments, building, noise);
    if (one_position)
      for (TrainingRoom& room : rooms) room = with_first_position(std::move(room));
    std::vector<ForestEvidence> more = evidence_of(task, rooms);
    std::move(more.begin(), more.end(), std::back_inserter(evidence));
  }
  return evidence;
}

using Floors = std::vector<std::pair<std::string, std::vector<ForestEvidence>>>;

/// Walls as the scanners saw them: what is there framed green, what was found blue.
void write_pictures(const fs::path& folder, const std::vector<TrainingRoom>& rooms, const Forest& forest) {
  make_folder(folder);
  for (const TrainingRoom& known : rooms) {
    const std::vector<WallImage> walls = label_images(known.cloud, known.room);
    const auto truth = true_openings(known.truth, known.room);
    const auto found = find_openings(known.cloud, known.room, forest);
    for (std::size_t i = 0; i < walls.size(); ++i) {
      Picture picture = wall_picture(walls[i]);
      for (const OpeningObservation& one : truth)
        if (one.wall == static_cast<int>(i)) frame_opening(picture, walls[i], one, {0, 160, 0});
      for (const OpeningObservation& one : found)
        if (one.wall == static_cast<int>(i)) frame_opening(picture, walls[i], one, {0, 60, 255});
      const std::string name =
          std::to_string(known.group) + "_" + known.truth.id + "_wall" + std::to_string(i);
      write_file(folder / (name + ".png"), png_bytes(picture.width, picture.height, picture.rgb));
    }
  }
}

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

/// What the forests learn from, and what they are judged by.
struct Material {
  std::vector<Sample> train;
  std::vector<ForestEvidence> held_out;
  std::vector<TrainingRoom> to_picture;  ///< held-out rooms, when pictures are asked for
};

Material made_up(const Task& task, const Arguments& arguments) {
  Material material;
  const bool only_judged = !arguments.model.empty();
  for (int building = 0; building < *arguments.buildings; ++building) {
    std::fprintf(stderr, "building %d of %d\n", building + 1, *arguments.buildings);
    std::vector<TrainingRoom> rooms = simulated_building(arguments, building);
    std::vector<ForestEvidence> evidence = evidence_of(task, rooms);
    if (only_judged || is_held_out(arguments, building)) {
      for (ForestEvidence& room : evidence) room.room.insert(0, "building " + std::to_string(building) + " ");
      std::move(evidence.begin(), evidence.end(), std::back_inserter(material.held_out));
      if (!arguments.pictures.empty())
        std::move(rooms.begin(), rooms.end(), std::back_inserter(material.to_picture));
    } else {
      for (const ForestEvidence& room : evidence)
        material.train.insert(material.train.end(), room.samples.begin(), room.samples.end());
    }
  }
  return material;
}

void print_quality(const std::string& what, const std::vector<ForestEvidence>& rooms, const Forest& forest,
                   bool mistakes) {
  std::fputs(reach_table(what, reach_of(rooms), mistakes).c_str(), stdout);
  std::fputs(score_table(what, scores_of(rooms, forest), mistakes).c_str(), stdout);
}

void print_ablation(const Task& task, const Arguments& arguments, const Material& material,
                    const ForestOptions& options, const Floors& floors) {
  Floors sets = {{"held-out made-up buildings", material.held_out}};
  sets.insert(sets.end(), floors.begin(), floors.end());
  print_ablation(task, material.train, options, sets,
                 {{"one scanner position", [&] { return held_out_again(task, arguments, 1, true); }},
                  {"noise x2", [&] { return held_out_again(task, arguments, 2, false); }},
                  {"noise x3", [&] { return held_out_again(task, arguments, 3, false); }}});
}

Forest trained(const Task& task, const Arguments& arguments, const Material& material, const Floors& floors) {
  ForestOptions options;
  options.seed = arguments.seed;
  options.trees = arguments.trees;
  if (material.train.empty()) throw InputError({}, "there is nothing to train on", "ask for more buildings");
  Forest forest = train_forest(task.name, task.features, task.classes, material.train, options);
  std::vector<Sample> held_out;
  for (const ForestEvidence& room : material.held_out)
    held_out.insert(held_out.end(), room.samples.begin(), room.samples.end());
  std::printf("%zu samples to train on, %zu held out\n", material.train.size(), held_out.size());
  print_confusion(forest, held_out);
  print_importance(forest, held_out, arguments.seed);
  if (arguments.ablation) print_ablation(task, arguments, material, options, floors);
  return forest;
}

/// The scans of a floor whose truth is known, perceived as any other; rooms that cannot be perceived count as
/// rooms in which nothing was found.
std::vector<TrainingRoom> perceived_floor(const fs::path& floor) {
  const Building building = building_of(read_truth(floor), floor);
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

int train(Arguments arguments) {
  const Task task = task_named(arguments.task);
  if (!arguments.buildings) arguments.buildings = arguments.model.empty() ? 60 : 0;
  Floors floors;
  for (const std::string& floor : arguments.test_floors)
    floors.emplace_back(floor, evidence_of(task, perceived_floor(floor)));
  const Material material = made_up(task, arguments);
  const Forest forest = arguments.model.empty()
                            ? trained(task, arguments, material, floors)
                            : forest_from_text(read_file(arguments.model), task.name, task.features,
                                               task.classes, arguments.model);
  if (!material.held_out.empty())
    print_quality("held-out made-up buildings", material.held_out, forest, arguments.mistakes);
  for (const auto& [name, rooms] : floors) print_quality(name, rooms, forest, arguments.mistakes);
  if (!arguments.pictures.empty() && task.name == "openings")
    write_pictures(arguments.pictures, material.to_picture, forest);
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
  verb->add_option(
          "--buildings", arguments->buildings,
          "Buildings made up at random, scanned and trained on (default: 60); with --model all of them are "
          "scored on (default: none)")
      ->check(CLI::Range(2, 10000));
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
  verb->add_option(
      "--pictures", arguments->pictures,
      "Folder for a picture of every held-out wall (openings only): above, labels as in perceive "
      "--wall-images, framed green what is there, blue what was found");
  verb->add_flag("--ablation", arguments->ablation,
                 "Also print recall and precision without each group of features, with a single scanner "
                 "position, and at two and three times the noise")
      ->excludes(verb->get_option("--model"));
  return [arguments] { return train(*arguments); };
}

}  // namespace gramap
