// How well forests do, as tables, and how much worse without one thing or another.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "perception/training.h"

namespace gramap {

/// By kind of what is found.
using Scores = std::map<std::string, Score>;

Scores score_rooms(const Task& task, const Forest& forest, const std::vector<TrainingRoom>& rooms);

/// A table of recall and precision with their confidence intervals; with `mistakes` each one of them.
void print_scores(const std::string& what, const Scores& scores, bool mistakes);

/// Recall and precision on the held-out rooms and on known floors: with everything; by forests trained
/// without each group of features; by the whole forest with the scans of one position alone, and at more
/// noise
/// (`held_out_at` simulates the held-out rooms again at a multiple of it; floors that are given cannot be
/// made noisier).
void print_ablation(const Task& task, const std::vector<Sample>& train, const ForestOptions& options,
                    const std::vector<TrainingRoom>& held_out,
                    const std::function<std::vector<TrainingRoom>(double noise)>& held_out_at,
                    const std::vector<std::pair<std::string, std::vector<TrainingRoom>>>& floors);

}  // namespace gramap
