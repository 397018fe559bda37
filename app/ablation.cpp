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

std::vector<TrainingRoom> first_positions(std::vector<TrainingRoom> rooms) {
  for (TrainingRoom& room : rooms) {
    if (room.cloud.parts.empty()) continue;
    room.cloud.parts.resize(1);
    room.cloud.points_m.resize(room.cloud.parts[0].end);
  }
  return rooms;
}

void print_row(const std::string& variant, const Scores& scores) {
  std::printf("%-32s", variant.c_str());
  for (const auto& [kind, score] : scores) std::printf("  %.3f / %.3f  ", score.recall(), score.precision());
  std::printf("\n");
}

}  // namespace

Scores score_rooms(const Task& task, const Forest& forest, const std::vector<TrainingRoom>& rooms) {
  std::vector<std::vector<std::pair<std::string, Score>>> each(rooms.size());
  tbb::parallel_for(std::size_t{0}, rooms.size(),
                    [&](std::size_t i) { each[i] = task.score(rooms[i], forest); });
  Scores total;
  for (std::size_t i = 0; i < rooms.size(); ++i)
    for (auto& [kind, score] : each[i]) {
      for (std::string& mistake : score.mistakes) mistake.insert(0, "room " + rooms[i].truth.id + ": ");
      total[kind].add(score);
    }
  return total;
}

void print_scores(const std::string& what, const Scores& scores, bool mistakes) {
  std::printf("\n%s\n%-14s %6s %6s %6s  %-22s %-22s\n", what.c_str(), "kind", "truth", "found", "right",
              "recall (95 %)", "precision (95 %)");
  for (const auto& [kind, score] : scores) {
    const Interval r = wilson(score.right, score.truth), p = wilson(score.right, score.found);
    std::printf("%-14s %6d %6d %6d  %.3f (%.3f to %.3f) %.3f (%.3f to %.3f)\n", kind.c_str(), score.truth,
                score.found, score.right, score.recall(), r.low, r.high, score.precision(), p.low, p.high);
  }
  if (!mistakes) return;
  for (const auto& [kind, score] : scores)
    for (const std::string& mistake : score.mistakes) std::printf("  %s\n", mistake.c_str());
}

void print_ablation(const Task& task, const std::vector<Sample>& train, const ForestOptions& options,
                    const std::vector<TrainingRoom>& held_out,
                    const std::function<std::vector<TrainingRoom>(double noise)>& held_out_at,
                    const std::vector<std::pair<std::string, std::vector<TrainingRoom>>>& floors) {
  std::vector<std::pair<std::string, Forest>> forests;
  forests.emplace_back("everything", train_forest(task.name, task.features, task.classes, train, options));
  for (const auto& [name, group] : task.feature_groups)
    forests.emplace_back("without " + name, train_forest(task.name, task.features, task.classes,
                                                         without(task, group, train), options));
  const auto table = [&](const std::string& what, const std::vector<TrainingRoom>& rooms) {
    std::printf("\nablation on %s: recall / precision\n%-32s", what.c_str(), "");
    for (const auto& [kind, score] : score_rooms(task, forests[0].second, rooms))
      std::printf("  %-15s", kind.c_str());
    std::printf("\n");
    for (const auto& [name, forest] : forests) print_row(name, score_rooms(task, forest, rooms));
    print_row("one scanner position", score_rooms(task, forests[0].second, first_positions(rooms)));
  };
  table("held-out simulated buildings", held_out);
  for (const double noise : {2.0, 3.0})
    print_row("noise x" + std::to_string(static_cast<int>(noise)),
              score_rooms(task, forests[0].second, held_out_at(noise)));
  for (const auto& [name, rooms] : floors) table(name, rooms);
}

}  // namespace gramap
