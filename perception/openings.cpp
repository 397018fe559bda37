#include "perception/openings.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

namespace gramap {
namespace {

constexpr double kMostShared = 0.15;  // of the smaller of two openings

struct Accepted {
  const OpeningCandidate* candidate;
  OpeningClass kind;
  double confidence;
};

/// Starts of the clusters: the most confident first, then each that hardly overlaps those before.
std::vector<int> first_labels(const std::vector<Accepted>& accepted, int& clusters) {
  std::vector<std::size_t> seeds;
  for (std::size_t i = 0; i < accepted.size(); ++i) {
    const bool apart = std::none_of(seeds.begin(), seeds.end(), [&](std::size_t seed) {
      return overlap(accepted[i].candidate->box, accepted[seed].candidate->box) > 0.2;
    });
    if (apart) seeds.push_back(i);
  }
  std::vector<int> labels;
  for (const Accepted& one : accepted) {
    std::size_t best = 0;
    for (std::size_t s = 1; s < seeds.size(); ++s)
      if (overlap(one.candidate->box, accepted[seeds[s]].candidate->box) >
          overlap(one.candidate->box, accepted[seeds[best]].candidate->box))
        best = s;
    labels.push_back(static_cast<int>(best));
  }
  clusters = static_cast<int>(seeds.size());
  return labels;
}

/// k-means over centre and (square root of) area, in pixels, from the given start.
std::vector<int> clustered(const std::vector<Accepted>& accepted, std::vector<int> labels, int clusters) {
  if (clusters < 2) return labels;
  cv::Mat data(static_cast<int>(accepted.size()), 3, CV_32F), assigned(data.rows, 1, CV_32S);
  for (int i = 0; i < data.rows; ++i) {
    const PixelBox& box = accepted[static_cast<std::size_t>(i)].candidate->box;
    data.at<float>(i, 0) = 0.5F * static_cast<float>(box.left + box.right);
    data.at<float>(i, 1) = 0.5F * static_cast<float>(box.bottom + box.top);
    data.at<float>(i, 2) = static_cast<float>(std::sqrt(box.area()));
    assigned.at<int>(i) = labels[static_cast<std::size_t>(i)];
  }
  cv::theRNG().state = 1;
  cv::kmeans(data, clusters, assigned, {cv::TermCriteria::MAX_ITER + cv::TermCriteria::EPS, 20, 0.1}, 1,
             cv::KMEANS_USE_INITIAL_LABELS);
  for (int i = 0; i < data.rows; ++i) labels[static_cast<std::size_t>(i)] = assigned.at<int>(i);
  return labels;
}

OpeningObservation observed(const Accepted& best, const WallCandidates& image, int wall) {
  const PixelBox& box = best.candidate->box;
  OpeningObservation opening;
  opening.kind = opening_class_names()[best.kind];
  opening.wall = wall;
  opening.start_m = box.left * image.pixel_m;
  opening.width_m = box.width() * image.pixel_m;
  opening.sill_m = box.bottom * image.pixel_m;
  opening.head_m = std::min(box.top * image.pixel_m, image.height_m);
  if (best.kind == kDoor && opening.sill_m < 0.12)
    opening.sill_m = 0;  // the lowest patches are hidden by the floor
  opening.confidence = best.confidence;
  return opening;
}

/// What the forest takes for a door or a window, the most confident first.
std::vector<Accepted> accepted_of(const WallCandidates& wall, const Forest& forest, double least_confidence) {
  std::vector<Accepted> accepted;
  for (const OpeningCandidate& candidate : wall.all) {
    const std::vector<double> votes = forest.votes(candidate.features);
    const OpeningClass kind = votes[kDoor] >= votes[kWindow] ? kDoor : kWindow;
    if (votes[kDoor] + votes[kWindow] >= least_confidence)
      accepted.push_back({&candidate, kind, votes[kind]});
  }
  std::stable_sort(accepted.begin(), accepted.end(),
                   [](const Accepted& a, const Accepted& b) { return a.confidence > b.confidence; });
  return accepted;
}

/// The best of each cluster, the most confident first.
std::vector<Accepted> best_of_clusters(const std::vector<Accepted>& accepted) {
  int clusters = 0;
  std::vector<int> labels = first_labels(accepted, clusters);
  labels = clustered(accepted, std::move(labels), clusters);
  std::vector<Accepted> kept;
  for (int cluster = 0; cluster < clusters; ++cluster) {
    const Accepted* best = nullptr;
    const auto merit = [](const Accepted& one) { return one.confidence * one.candidate->openness; };
    for (std::size_t i = 0; i < accepted.size(); ++i)
      if (labels[i] == cluster && (best == nullptr || merit(accepted[i]) > merit(*best))) best = &accepted[i];
    if (best != nullptr) kept.push_back(*best);
  }
  std::stable_sort(kept.begin(), kept.end(),
                   [](const Accepted& a, const Accepted& b) { return a.confidence > b.confidence; });
  return kept;
}

bool in_the_way(const PixelBox& a, const PixelBox& b) {
  const int width = std::min(a.right, b.right) - std::max(a.left, b.left);
  const int height = std::min(a.top, b.top) - std::max(a.bottom, b.bottom);
  return width > 0 && height > 0 &&
         static_cast<double>(width) * height > kMostShared * std::min(a.area(), b.area());
}

std::vector<OpeningObservation> judged(const WallCandidates& image, const Forest& forest, int wall,
                                       double least_confidence) {
  std::vector<Accepted> left = accepted_of(image, forest, least_confidence);
  std::vector<OpeningObservation> openings;
  // A box over two openings may have drawn both of them into its cluster: what no chosen one covers is looked
  // at again.
  while (!left.empty()) {
    std::vector<PixelBox> taken;
    const auto is_free = [&](const Accepted& one) {
      return std::none_of(taken.begin(), taken.end(),
                          [&](const PixelBox& box) { return in_the_way(box, one.candidate->box); });
    };
    for (const Accepted& one : best_of_clusters(left)) {
      if (!is_free(one)) continue;
      taken.push_back(one.candidate->box);
      openings.push_back(observed(one, image, wall));
    }
    std::erase_if(left, [&](const Accepted& one) { return !is_free(one); });
  }
  std::sort(openings.begin(), openings.end(),
            [](const auto& a, const auto& b) { return a.start_m < b.start_m; });
  return openings;
}

}  // namespace

const std::vector<std::string>& opening_class_names() {
  static const std::vector<std::string> names = {"none", "door", "window"};
  return names;
}

std::vector<WallCandidates> wall_candidates(const RegisteredCloud& cloud, const RoomObservation& room,
                                            const OpeningOptions& options) {
  std::vector<WallCandidates> walls;
  for (const WallImage& image : label_images(cloud, room, options.labels))
    walls.push_back({image.pixel_m, image.height_m, opening_candidates(image, options.candidates)});
  return walls;
}

std::vector<OpeningObservation> judge_openings(const std::vector<WallCandidates>& walls, const Forest& forest,
                                               double least_confidence) {
  std::vector<OpeningObservation> openings;
  for (std::size_t i = 0; i < walls.size(); ++i) {
    const auto found = judged(walls[i], forest, static_cast<int>(i), least_confidence);
    openings.insert(openings.end(), found.begin(), found.end());
  }
  return openings;
}

std::vector<OpeningObservation> find_openings(const RegisteredCloud& cloud, const RoomObservation& room,
                                              const Forest& forest, const OpeningOptions& options) {
  return judge_openings(wall_candidates(cloud, room, options), forest, options.least_confidence);
}

}  // namespace gramap
