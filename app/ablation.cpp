#include "app/ablation.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstdio>

namespace gramap {
namespace {

/// Samples in which the named features say nothing: a forest never splits by a constant.
std::vector<Sample> without(const Task& task, const std::vector<std::string>& group,
                            std::vector<Sample> samples) {
  for (std::size_t i = 0; i < task.features.size(); ++i)
    if (std::find(group.begin(), group.end(), task.features[i]) != group.end())
      for (Sample& sample : samples) sample.features[i] = 0;
  return samples;
}

void print_row(const std::string& variant, const Scores& scores) {
  std::printf("%-24s", variant.c_str());
  for (const auto& [kind, score] : scores) std::printf("  %.3f / %.3f  ", score.recall(), score.precision());
  std::printf("\n");
  std::fflush(stdout);
}

}  // namespace

Scores scores_of(const std::vector<ForestEvidence>& rooms, const Forest& forest) {
  std::vector<Scores> each(rooms.size());
  tbb::parallel_for(std::size_t{0}, rooms.size(), [&](std::size_t i) { each[i] = rooms[i].score(forest); });
  Scores total;
  for (std::size_t i = 0; i < rooms.size(); ++i)
    for (auto& [kind, score] : each[i]) {
      for (std::string& mistake : score.mistakes) mistake.insert(0, "room " + rooms[i].room + ": ");
      total[kind].add(score);
    }
  return total;
}

Scores reach_of(const std::vector<ForestEvidence>& rooms) {
  Scores total;
  for (const ForestEvidence& room : rooms)
    for (auto [kind, score] : room.reach) {
      for (std::string& mistake : score.mistakes) mistake.insert(0, "room " + room.room + ": ");
      total[kind].add(score);
    }
  return total;
}

void print_ablation(const Task& task, const std::vector<Sample>& train, const ForestOptions& options,
                    const std::vector<std::pair<std::string, std::vector<ForestEvidence>>>& sets,
                    const std::vector<Condition>& conditions) {
  std::vector<std::pair<std::string, Forest>> forests;
  const auto add = [&](const std::string& name, const std::vector<std::string>& left_out) {
    std::fprintf(stderr, "training: %s\n", name.c_str());
    forests.emplace_back(
        name, train_forest(task.name, task.features, task.classes, without(task, left_out, train), options));
  };
  add("everything", {});
  for (const auto& [name, group] : task.feature_groups) add("without " + name, group);
  const auto head = [&](const std::string& what, const Scores& kinds) {
    std::printf("\nablation on %s: recall / precision\n%-24s", what.c_str(), "");
    for (const auto& [kind, score] : kinds) std::printf("  %-15s", kind.c_str());
    std::printf("\n");
  };
  for (const auto& [what, rooms] : sets) {
    head(what, scores_of(rooms, forests[0].second));
    for (const auto& [name, forest] : forests) print_row(name, scores_of(rooms, forest));
    if (&rooms != &sets[0].second) continue;
    for (const Condition& condition : conditions) {
      std::fprintf(stderr, "judging: %s\n", condition.name.c_str());
      print_row(condition.name, scores_of(condition.rooms(), forests[0].second));
    }
  }
}

}  // namespace gramap
