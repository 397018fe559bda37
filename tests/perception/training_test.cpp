#include "perception/training.h"

#include <doctest/doctest.h>

#include "perception/random_building.h"

using namespace gramap;

namespace {

SimulateOptions sparse() {
  SimulateOptions options;
  options.points_per_room = 15000;
  return options;
}

std::vector<Sample> samples_of(const Task& task) {
  std::vector<Sample> samples;
  for (const TrainingRoom& known : known_rooms(random_building(5, 1), sparse(), 0)) {
    const std::vector<Sample> more = task.evidence(known).samples;
    samples.insert(samples.end(), more.begin(), more.end());
  }
  return samples;
}

Forest tiny_forest(const Task& task) {
  ForestOptions options;
  options.trees = 10;
  return train_forest(task.name, task.features, task.classes, samples_of(task), options);
}

}  // namespace

TEST_CASE("training twice from the same seed makes the same model, byte for byte") {
  for (const Task& task : {opening_task(), furniture_task()}) {
    INFO(task.name);
    const std::string model = to_text(tiny_forest(task));
    CHECK(model.size() > 200);
    CHECK(model == to_text(tiny_forest(task)));
  }
}

TEST_CASE("a room's evidence serves any forest, and no forest finds more than there are candidates for") {
  for (const Task& task : {opening_task(), furniture_task()}) {
    const Forest forest = tiny_forest(task);
    for (const TrainingRoom& known : known_rooms(random_building(6, 1), sparse(), 0)) {
      const ForestEvidence evidence = task.evidence(known);
      const Scores scores = evidence.score(forest), again = evidence.score(forest);
      int there = 0, reached = 0, right = 0;
      for (const auto& [kind, score] : evidence.reach) there += score.truth, reached += score.right;
      for (const auto& [kind, score] : scores) {
        CHECK(score.right == again.at(kind).right);
        if (kind == "door" || kind == "window" || kind == "furniture") right += score.right;
      }
      CHECK(reached <= there);
      CHECK(right <= reached);
    }
  }
}
