// How much worse forests do without one thing or another.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "perception/training.h"

namespace gramap {

/// All rooms together, many at a time.
Scores scores_of(const std::vector<ForestEvidence>& rooms, const Forest& forest);
Scores reach_of(const std::vector<ForestEvidence>& rooms);

/// A condition that rooms are judged under, its evidence made when its turn comes.
struct Condition {
  std::string name;
  std::function<std::vector<ForestEvidence>()> rooms;
};

/// Recall and precision on the held-out rooms and on known floors: with everything; by forests trained
/// without each group of features; and by the whole forest under other conditions. Progress goes to standard
/// error.
void print_ablation(const Task& task, const std::vector<Sample>& train, const ForestOptions& options,
                    const std::vector<std::pair<std::string, std::vector<ForestEvidence>>>& sets,
                    const std::vector<Condition>& conditions);

}  // namespace gramap
