#include "perception/openings.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

namespace gramap {
namespace {

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

OpeningObservation observed(const Accepted& best, const WallImage& image, int wall) {
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

}  // namespace

const std::vector<std::string>& opening_class_names() {
  static const std::vector<std::string> names = {"none", "door", "window"};
  return names;
}

std::vector<OpeningObservation> judge_openings(const WallImage& image,
                                               const std::vector<OpeningCandidate>& candidates,
                                               const Forest& forest, int wall, double least_confidence) {
  std::vector<Accepted> accepted;
  for (const OpeningCandidate& candidate : candidates) {
    const std::vector<double> votes = forest.votes(candidate.features);
    const OpeningClass kind = votes[kDoor] >= votes[kWindow] ? kDoor : kWindow;
    if (votes[kind] >= least_confidence) accepted.push_back({&candidate, kind, votes[kind]});
  }
  std::stable_sort(accepted.begin(), accepted.end(),
                   [](const Accepted& a, const Accepted& b) { return a.confidence > b.confidence; });
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
  // Two clusters may have met in one opening; the more confident stays.
  std::stable_sort(kept.begin(), kept.end(),
                   [](const Accepted& a, const Accepted& b) { return a.confidence > b.confidence; });
  std::vector<OpeningObservation> openings;
  std::vector<PixelBox> taken;
  for (const Accepted& one : kept) {
    if (std::any_of(taken.begin(), taken.end(),
                    [&](const PixelBox& box) { return overlap(box, one.candidate->box) > 0.1; }))
      continue;
    taken.push_back(one.candidate->box);
    openings.push_back(observed(one, image, wall));
  }
  std::sort(openings.begin(), openings.end(),
            [](const auto& a, const auto& b) { return a.start_m < b.start_m; });
  return openings;
}

std::vector<OpeningObservation> find_openings(const RegisteredCloud& cloud, const RoomObservation& room,
                                              const Forest& forest, const OpeningOptions& options) {
  std::vector<OpeningObservation> openings;
  const std::vector<WallImage> images = label_images(cloud, room, options.labels);
  for (std::size_t i = 0; i < images.size(); ++i) {
    const auto found = judge_openings(images[i], opening_candidates(images[i], options.candidates), forest,
                                      static_cast<int>(i), options.least_confidence);
    openings.insert(openings.end(), found.begin(), found.end());
  }
  return openings;
}

}  // namespace gramap
