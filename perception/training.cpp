#include "perception/training.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numeric>

#include "perception/random.h"
#include "perception/truth_match.h"

namespace gramap {

RegisteredCloud registered(const SimulatedRoom& room) {
  RoomScans scans;
  for (const SimulatedScan& simulated : room.scans) {
    Scan scan;
    scan.room_from_scanner = simulated.frame_from_scanner;
    for (const Vec3& p : simulated.points) scan.points_m.push_back(p.cast<float>());
    scans.scans.push_back(std::move(scan));
  }
  return registered(scans);
}

std::vector<TrainingRoom> known_rooms(const Building& building, const SimulateOptions& options, int group) {
  std::vector<std::size_t> all(building.rooms.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  const std::vector<SimulatedRoom> simulated = simulate_rooms(building, all, options);
  std::vector<TrainingRoom> known(all.size());
  tbb::parallel_for(std::size_t{0}, all.size(), [&](std::size_t i) {
    known[i].cloud = registered(simulated[i]);
    known[i].room = observation_of_truth(building.rooms[i], simulated[i].frame_from_building);
    known[i].truth = aligned_truth(building.rooms[i], known[i].room);
    known[i].group = group;
  });
  return known;
}

namespace {

PixelBox box_of(const OpeningObservation& opening, double pixel_m) {
  const auto px = [&](double m) { return static_cast<int>(std::lround(m / pixel_m)); };
  return {px(opening.start_m), px(opening.sill_m), px(opening.start_m + opening.width_m), px(opening.head_m)};
}

/// Candidates labelled door or window where they overlap a true opening by at least 0.7, none below 0.5;
/// those in between teach nothing and are left out.
std::vector<Sample> opening_samples(const std::vector<WallCandidates>& walls,
                                    const std::vector<OpeningObservation>& truth, int group) {
  std::vector<Sample> samples;
  for (std::size_t wall = 0; wall < walls.size(); ++wall)
    for (const OpeningCandidate& candidate : walls[wall].all) {
      double best = 0;
      int label = kNoOpening;
      for (const OpeningObservation& opening : truth) {
        if (opening.wall != static_cast<int>(wall)) continue;
        const double share = overlap(box_of(opening, walls[wall].pixel_m), candidate.box);
        if (share <= best) continue;
        best = share;
        label = opening.kind == "door" ? kDoor : kWindow;
      }
      if (best >= 0.5 && best < 0.7) continue;
      samples.push_back({{candidate.features.begin(), candidate.features.end()},
                         best < 0.5 ? static_cast<int>(kNoOpening) : label,
                         group});
    }
  return samples;
}

std::string described(const char* fault, const OpeningObservation& opening) {
  char text[160];
  std::snprintf(text, sizeof text, "%s %s on wall %d at %.2f m, %.2f m wide, from %.2f m to %.2f m", fault,
                opening.kind.c_str(), opening.wall, opening.start_m, opening.width_m, opening.sill_m,
                opening.head_m);
  return text;
}

Scores opening_reach(const std::vector<WallCandidates>& walls, const std::vector<OpeningObservation>& truth) {
  Scores reach;
  for (const OpeningObservation& opening : truth) {
    Score& score = reach[opening.kind];
    ++score.truth;
    const auto wall = static_cast<std::size_t>(opening.wall);
    const bool reached =
        wall < walls.size() &&
        std::any_of(walls[wall].all.begin(), walls[wall].all.end(), [&](const OpeningCandidate& candidate) {
          return overlap(box_of(opening, walls[wall].pixel_m), candidate.box) >= 0.5;
        });
    score.right += reached;
    if (!reached) score.mistakes.push_back(described("no candidate for", opening));
  }
  return reach;
}

}  // namespace

Score score_openings(const std::vector<OpeningObservation>& found,
                     const std::vector<OpeningObservation>& truth, const std::string& kind) {
  Score score;
  std::vector<bool> taken(truth.size());
  for (const OpeningObservation& one : found) {
    if (one.kind != kind) continue;
    ++score.found;
    const int before = score.right;
    for (std::size_t i = 0; i < truth.size() && score.right == before; ++i)
      if (!taken[i] && truth[i].kind == kind && overlap(one, truth[i]) >= 0.5) taken[i] = true, ++score.right;
    if (score.right == before) score.mistakes.push_back(described("false", one));
  }
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (truth[i].kind != kind) continue;
    ++score.truth;
    if (!taken[i]) score.mistakes.push_back(described("missed", truth[i]));
  }
  return score;
}

Interval wilson(int successes, int trials) {
  if (trials == 0) return {};
  const double z = 1.96, n = trials, share = successes / n;
  const double middle = share + z * z / (2 * n),
               spread = z * std::sqrt(share * (1 - share) / n + z * z / (4 * n * n));
  return {std::max(0.0, (middle - spread) / (1 + z * z / n)),
          std::min(1.0, (middle + spread) / (1 + z * z / n))};
}

Task opening_task(const OpeningOptions& options) {
  const auto evidence = [options](const TrainingRoom& known) -> ForestEvidence {
    const auto walls = std::make_shared<const std::vector<WallCandidates>>(
        wall_candidates(known.cloud, known.room, options));
    const std::vector<OpeningObservation> truth = true_openings(known.truth, known.room);
    const auto score = [walls, truth, least = options.least_confidence](const Forest& forest) {
      const auto found = judge_openings(*walls, forest, least);
      Scores scores;
      for (const char* kind : {"door", "window"}) scores[kind] = score_openings(found, truth, kind);
      return scores;
    };
    return {known.truth.id, opening_samples(*walls, truth, known.group), opening_reach(*walls, truth), score};
  };
  return {"openings",
          opening_feature_names(),
          opening_class_names(),
          {{"size", {"area", "width/height", "width/wall", "height/wall"}},
           {"place", {"to top", "to bottom", "to left", "to right"}},
           {"plane fit", {"plane rms"}},
           {"labels", {"empty share", "occupied share", "occluded share"}},
           {"edges", {"interior boxes", "inverted Us"}},
           {"beyond", {"seen beyond"}},
           {"wall around", {"wall beside", "wall over and under", "wall across"}}},
          evidence};
}

namespace {

int answer(const Forest& forest, std::span<const float> sample) {
  const std::vector<double> votes = forest.votes(sample);
  return static_cast<int>(std::max_element(votes.begin(), votes.end()) - votes.begin());
}

}  // namespace

std::vector<std::vector<int>> confusion(const Forest& forest, const std::vector<Sample>& samples) {
  std::vector<std::vector<int>> counts(forest.classes.size(), std::vector<int>(forest.classes.size()));
  for (const Sample& sample : samples)
    ++counts[static_cast<std::size_t>(sample.label)]
            [static_cast<std::size_t>(answer(forest, sample.features))];
  return counts;
}

std::vector<double> feature_importance(const Forest& forest, const std::vector<Sample>& samples,
                                       std::uint64_t seed) {
  const auto accuracy = [&](const std::vector<Sample>& set) {
    int right = 0;
    for (const Sample& sample : set) right += answer(forest, sample.features) == sample.label;
    return set.empty() ? 0.0 : static_cast<double>(right) / static_cast<double>(set.size());
  };
  const double whole = accuracy(samples);
  std::vector<double> lost;
  for (std::size_t feature = 0; feature < forest.features.size(); ++feature) {
    Random random(seed + feature);
    std::vector<Sample> shuffled = samples;
    for (std::size_t i = shuffled.size(); i > 1; --i)
      std::swap(shuffled[i - 1].features[feature],
                shuffled[static_cast<std::size_t>(random.below(static_cast<int>(i)))].features[feature]);
    lost.push_back(whole - accuracy(shuffled));
  }
  return lost;
}

}  // namespace gramap
