// Samples with known answers for the forests, and what a forest gets right.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "perception/furniture.h"
#include "perception/openings.h"
#include "perception/simulate.h"

namespace gramap {

/// A scanned room whose truth is known, in the frame of its poses.
struct TrainingRoom {
  RegisteredCloud cloud;
  RoomObservation room;
  BuildingRoom truth;  ///< aligned with the observation
  int group = 0;       ///< its building
};

/// Simulates all rooms of a building. Their walls are taken from the truth, so that what is trained does not
/// depend on how planes are found.
std::vector<TrainingRoom> known_rooms(const Building& building, const SimulateOptions& options, int group);

RegisteredCloud registered(const SimulatedRoom& room);

/// How often something was found, missed, or found where there is nothing.
struct Score {
  int truth = 0;                      ///< things there are
  int found = 0;                      ///< things reported
  int right = 0;                      ///< matched one to one
  std::vector<std::string> mistakes;  ///< what was missed and what was found in vain, for people
  void add(const Score& other) {
    truth += other.truth, found += other.found, right += other.right;
    mistakes.insert(mistakes.end(), other.mistakes.begin(), other.mistakes.end());
  }
  double recall() const { return truth > 0 ? static_cast<double>(right) / truth : 1; }
  double precision() const { return found > 0 ? static_cast<double>(right) / found : 1; }
};
using Scores = std::map<std::string, Score>;  ///< by kind of what is found

/// What forests learn from a room and are judged by in it. Its candidates are made once, for many forests;
/// the scans are not needed any more.
struct ForestEvidence {
  std::string room;
  std::vector<Sample> samples;
  /// Of the true things, those that one candidate at least overlaps by half: what no forest can better.
  Scores reach;
  std::function<Scores(const Forest&)> score;  ///< what the whole chain finds with a forest
};

/// One of the two things that forests are trained for.
struct Task {
  std::string name;
  std::vector<std::string> features, classes;
  /// Features that say something of one kind, by name.
  std::vector<std::pair<std::string, std::vector<std::string>>> feature_groups;
  std::function<ForestEvidence(const TrainingRoom&)> evidence;
};
Task opening_task(const OpeningOptions& options = {});
Task furniture_task(const FurnitureOptions& options = {});

/// Found openings of one kind against the true ones: matched when they overlap by at least half.
Score score_openings(const std::vector<OpeningObservation>& found,
                     const std::vector<OpeningObservation>& truth, const std::string& kind);

/// Found furniture against the true pieces: "furniture": found where there is some, of whatever class (plan
/// IoU at least 0.5); "class right": of those, the ones called by their name; and each class for itself.
Scores score_furniture(const std::vector<FurnitureObservation>& found, BuildingRoom truth);

/// 95 % confidence interval of a share (Wilson 1927).
struct Interval {
  double low = 0, high = 1;
};
Interval wilson(int successes, int trials);

/// counts[truth][answer].
std::vector<std::vector<int>> confusion(const Forest& forest, const std::vector<Sample>& samples);

/// For each feature, how much of the accuracy is lost when its values are shuffled among the samples (Breiman
/// 2001).
std::vector<double> feature_importance(const Forest& forest, const std::vector<Sample>& samples,
                                       std::uint64_t seed);

}  // namespace gramap
