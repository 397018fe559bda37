// Furniture's side of training: labelled candidates and scores.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

#include "geometry/overlap.h"
#include "geometry/polygon.h"
#include "perception/training.h"
#include "perception/truth_match.h"

namespace gramap {
namespace {

int label_of(const std::string& type) {
  return type == "table" ? kTable : type == "chair" ? kChair : kOther;
}

/// Of the boxes that cuts make and that hold no piece, so many stand for each that is trained on: there are a
/// hundred of them for every piece, and they resemble each other.
constexpr int kCutsForEach = 5;

/// Candidates labelled by the true piece that they overlap by at least 0.7, none below 0.5.
std::vector<Sample> furniture_samples(const TrainingRoom& known, const FurnitureCandidates& candidates) {
  std::vector<Sample> samples;
  int cuts = 0;
  for (std::size_t i = 0; i < candidates.all.size(); ++i) {
    const FurnitureCandidate& candidate = candidates.all[i];
    double best = 0;
    int label = kNoFurniture;
    Polygon footprint = candidate.footprint;
    for (Vec2& p : footprint) p += known.cloud.origin_m.head<2>();
    for (const BuildingFurniture& piece : known.truth.furniture) {
      if (!piece.counts() || (centroid(piece.outline) - centroid(footprint)).norm() > 1) continue;
      const bool has_seat = piece.type == "chair" || piece.type == kSofa;
      if (std::abs(piece.top_m - candidate.top_m) > 0.25 && !has_seat) continue;

      const double share = intersection_over_union(piece.outline, footprint);
      if (share > best) best = share, label = label_of(piece.type);
    }
    if (best >= 0.5 && best < 0.7) continue;
    if (best < 0.5) label = kNoFurniture;
    const bool whole = std::find(candidates.roots.begin(), candidates.roots.end(), static_cast<int>(i)) !=
                       candidates.roots.end();
    if (best < 0.5 && !whole && ++cuts % kCutsForEach != 0) continue;
    samples.push_back({candidate.features, label, known.group});
  }
  return samples;
}

std::string described(const char* fault, const std::string& type, const Polygon& outline, double top_m) {
  char text[160];
  const OrientedBox box = oriented_box(outline);
  const Vec2 middle = centroid(outline);
  std::snprintf(text, sizeof text, "%s %s of %.2f x %.2f m, %.2f m high, at (%.2f, %.2f)", fault,
                type.c_str(), box.length_m, box.breadth_m, top_m, middle.x(), middle.y());
  return text;
}

/// The pieces that one candidate at least overlaps by half, by their true class.
Scores furniture_reach(const TrainingRoom& known, const FurnitureCandidates& candidates) {
  Scores reach;
  for (const BuildingFurniture& piece : known.truth.furniture) {
    if (!piece.counts()) continue;
    Score& score = reach[furniture_class_names()[static_cast<std::size_t>(label_of(piece.type))]];
    ++score.truth;
    Polygon outline = piece.outline;
    for (Vec2& p : outline) p -= known.cloud.origin_m.head<2>();
    const bool reached =
        std::any_of(candidates.all.begin(), candidates.all.end(), [&](const FurnitureCandidate& candidate) {
          return (centroid(outline) - centroid(candidate.footprint)).norm() < 1 &&
                 intersection_over_union(outline, candidate.footprint) >= 0.5;
        });
    score.right += reached;
    if (!reached)
      score.mistakes.push_back(described("no candidate for", piece.type, piece.outline, piece.top_m));
  }
  return reach;
}

}  // namespace

Scores score_furniture(const std::vector<FurnitureObservation>& found, BuildingRoom truth) {
  std::erase_if(truth.furniture, [](const BuildingFurniture& piece) { return !piece.counts(); });
  Scores scores;
  Score& any = scores["furniture"];
  Score& named = scores["class right"];
  std::vector<bool> taken(truth.furniture.size());
  any.found = static_cast<int>(found.size());
  any.truth = static_cast<int>(truth.furniture.size());
  for (const BuildingFurniture& piece : truth.furniture)
    ++scores[furniture_class_names()[static_cast<std::size_t>(label_of(piece.type))]].truth;
  for (const FurnitureObservation& one : found) {
    ++scores[one.type].found;
    bool right = false;
    for (std::size_t i = 0; i < truth.furniture.size() && !right; ++i) {
      const BuildingFurniture& piece = truth.furniture[i];
      if (taken[i] || intersection_over_union(one.footprint, piece.outline) < 0.5) continue;
      right = taken[i] = true;
      ++any.right, ++named.truth, ++named.found;
      const bool same = furniture_class_names()[static_cast<std::size_t>(label_of(piece.type))] == one.type;
      named.right += same, scores[one.type].right += same;
      if (!same)
        named.mistakes.push_back(
            described(("called " + one.type + ":").c_str(), piece.type, piece.outline, piece.top_m));
    }
    if (!right) any.mistakes.push_back(described("false", one.type, one.footprint, one.top_m));
  }
  for (std::size_t i = 0; i < truth.furniture.size(); ++i)
    if (!taken[i])
      any.mistakes.push_back(
          described("missed", truth.furniture[i].type, truth.furniture[i].outline, truth.furniture[i].top_m));
  return scores;
}

Task furniture_task(const FurnitureOptions& options) {
  return {"furniture",
          furniture_feature_names(),
          furniture_class_names(),
          {{"height", {"height"}},
           {"size", {"area", "length", "breadth", "aspect"}},
           {"fill", {"hull fill", "cell fill", "density"}},
           {"faces", {"faces below", "top seen", "upright share", "floor below"}},
           {"surroundings",
            {"to wall", "goes on", "floor beside", "wall beside", "higher beside", "step beside"}},
           {"whole", {"whole"}}},
          [options](const TrainingRoom& known) -> ForestEvidence {
            const auto candidates = std::make_shared<const FurnitureCandidates>(
                furniture_candidates(known.cloud, known.room, options));
            const auto score = [candidates, origin_m = known.cloud.origin_m, truth = known.truth,
                                least = options.least_confidence](const Forest& forest) {
              return score_furniture(judge_furniture(*candidates, origin_m, forest, least), truth);
            };
            return {known.truth.id, furniture_samples(known, *candidates),
                    furniture_reach(known, *candidates), score};
          }};
}

}  // namespace gramap
