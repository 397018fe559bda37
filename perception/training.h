// Samples with known answers for the forests, and what a forest gets right.
#pragma once

#include <functional>
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

/// One of the two things that forests are trained for.
struct Task {
  std::string name;
  std::vector<std::string> features, classes;
  /// Features that say something of one kind, by name.
  std::vector<std::pair<std::string, std::vector<std::string>>> feature_groups;
  std::function<std::vector<Sample>(const TrainingRoom&)> samples;
  /// Scores by kind of what the whole chain finds in a room with a forest.
  std::function<std::vector<std::pair<std::string, struct Score>>(const TrainingRoom&, const Forest&)> score;
};
Task opening_task(const OpeningOptions& options = {});
Task furniture_task(const FurnitureOptions& options = {});

/// The candidates on a room's walls, labelled door or window where they overlap a true opening by at least
/// 0.7, none below 0.5; those in between teach nothing and are left out.
std::vector<Sample> opening_samples(const TrainingRoom& known, const OpeningOptions& options);

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

/// Found openings of one kind against the true ones: matched when they overlap by at least half.
Score score_openings(const std::vector<OpeningObservation>& found,
                     const std::vector<OpeningObservation>& truth, const std::string& kind);

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
