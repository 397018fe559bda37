#include "floor/evaluate.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "floor/evaluate_walls.h"
#include "geometry/overlap.h"
#include "geometry/polygon.h"

namespace gramap {
namespace {

double extent_along(const Polygon& ring, const Vec2& direction) {
  double least = 1e300, most = -1e300;
  for (const Vec2& point : ring) {
    least = std::min(least, direction.dot(point));
    most = std::max(most, direction.dot(point));
  }
  return ring.empty() ? 0 : most - least;
}

/// The direction that the room's width is measured along.
Vec2 width_direction(const FittedRoom& room, const FittedFloor& fitted, const FloorGroundTruth& floor) {
  for (const std::vector<Space>* spaces : {&floor.spaces, &fitted.floor.spaces})
    for (const Space& space : *spaces)
      if (space.id == room.space && space.start != space.end) return (space.end - space.start).normalized();
  Vec2 best = Vec2::UnitX();
  double least = 1e300;
  for (std::size_t i = 0; i < room.outline.size(); ++i) {
    const Vec2 edge = room.outline[(i + 1) % room.outline.size()] - room.outline[i];
    if (edge.norm() == 0) continue;
    const double misfit = std::abs(extent_along(room.outline, edge.normalized()) - room.width_m);
    if (misfit >= least) continue;
    least = misfit;
    best = edge.normalized();
  }
  return best;
}

/// For each of `count` things the other's that it matches (-1: none): best score first, each used once.
template <class Score>
std::vector<int> match(std::size_t count, std::size_t others, double least, Score score) {
  struct Pair {
    double score;
    int one, other;
  };
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = 0; j < others; ++j)
      if (const double value = score(i, j); value >= least)
        pairs.push_back({value, static_cast<int>(i), static_cast<int>(j)});
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const Pair& a, const Pair& b) { return a.score > b.score; });
  std::vector<int> matched(count, -1);
  std::vector<bool> used(others, false);
  for (const Pair& pair : pairs) {
    if (matched[static_cast<std::size_t>(pair.one)] >= 0 || used[static_cast<std::size_t>(pair.other)])
      continue;
    matched[static_cast<std::size_t>(pair.one)] = pair.other;
    used[static_cast<std::size_t>(pair.other)] = true;
  }
  return matched;
}

/// The true rooms that rules were to find: not the hallways and fixed rooms, which were given.
std::vector<const TrueRoom*> rooms_to_find(const FittedFloor& fitted, const FloorTruth& truth,
                                           const FloorGroundTruth& floor) {
  std::set<std::string> given;
  for (const FittedRoom& room : fitted.hallways) given.insert(room.id);
  for (const FittedRoom& room : fitted.fixed) given.insert(room.id);
  for (const Hallway& hallway : floor.hallways) given.insert(hallway.id);
  for (const FixedRoom& room : floor.fixed) given.insert(room.id);
  std::vector<const TrueRoom*> rooms;
  for (const TrueRoom& room : truth.rooms)
    if (!given.contains(room.id) && room.type != "Hallway") rooms.push_back(&room);
  return rooms;
}

ErrorSummary summarise(std::vector<double> errors) {
  ErrorSummary summary;
  summary.count = static_cast<int>(errors.size());
  if (errors.empty()) return summary;
  for (double& error : errors) error = std::abs(error);
  std::sort(errors.begin(), errors.end());
  const double n = static_cast<double>(errors.size());
  for (const double error : errors) {
    summary.mean_abs_m += error / n;
    summary.rms_m += error * error / n;
    summary.within_2cm += (error <= 0.02 + 1e-9) / n;
    summary.within_10cm += (error <= 0.1 + 1e-9) / n;
  }
  summary.rms_m = std::sqrt(summary.rms_m);
  summary.median_abs_m = (errors[(errors.size() - 1) / 2] + errors[errors.size() / 2]) / 2;
  summary.worst_m = errors.back();
  return summary;
}

// ---- openings and furniture
// ------------------------------------------------------------------------------------

struct Rectangle {
  Vec2 a, b;
  double low = 0, high = 0;
};

/// Intersection over union of two openings on one wall face; 0 when they are on different walls.
double opening_iou(const Rectangle& one, const Rectangle& other) {
  const double length = (one.b - one.a).norm(), other_length = (other.b - other.a).norm();
  if (length == 0 || other_length == 0) return 0;
  const Vec2 along = (one.b - one.a) / length, across(-along.y(), along.x());
  const Vec2 c = other.a - one.a, d = other.b - one.a;
  constexpr double most_apart_m = 0.5;  // the two faces of a thick wall
  if (std::abs(across.dot(c)) > most_apart_m || std::abs(across.dot(d)) > most_apart_m) return 0;
  const double shared = std::max(0.0, std::min(length, std::max(along.dot(c), along.dot(d))) -
                                          std::max(0.0, std::min(along.dot(c), along.dot(d))));
  const double height = one.high - one.low, other_height = other.high - other.low;
  if (height <= 0 || other_height <= 0) return shared / (length + other_length - shared);
  const double shared_height = std::max(0.0, std::min(one.high, other.high) - std::max(one.low, other.low));
  const double area = shared * shared_height;
  return area / (length * height + other_length * other_height - area);
}

DetectionScore score_openings(const std::string& kind, const std::vector<const FittedRoom*>& rooms,
                              const std::set<std::string>& true_rooms, const FloorTruth& truth,
                              bool observed_only) {
  std::vector<Rectangle> model, real;
  for (const FittedRoom* room : rooms)
    for (const FittedOpening& opening : room->openings)
      if (opening.kind == kind && (!observed_only || opening.origin == Origin::observed))
        model.push_back({opening.a, opening.b, opening.sill_m, opening.head_m});
  for (const TrueOpening& opening : truth.openings)
    if (opening.kind == kind && true_rooms.contains(opening.room))
      real.push_back({opening.a, opening.b, opening.sill_m, opening.head_m});
  const std::vector<int> matched = match(model.size(), real.size(), 0.5, [&](std::size_t i, std::size_t j) {
    return opening_iou(model[i], real[j]);
  });
  DetectionScore score{kind, 0, static_cast<int>(real.size()), static_cast<int>(model.size())};
  for (const int other : matched) score.matched += other >= 0;
  return score;
}

void score_furniture(const std::vector<const FittedRoom*>& rooms, const std::set<std::string>& true_rooms,
                     const FloorTruth& truth, Evaluation& evaluation) {
  std::vector<const FittedFurniture*> model;
  std::vector<const TrueFurniture*> real;
  for (const FittedRoom* room : rooms)
    for (const FittedFurniture& piece : room->furniture)
      if (piece.origin == Origin::observed) model.push_back(&piece);
  for (const TrueFurniture& piece : truth.furniture)
    if (true_rooms.contains(piece.room)) real.push_back(&piece);
  const std::vector<int> matched = match(model.size(), real.size(), 0.5, [&](std::size_t i, std::size_t j) {
    if ((centroid(model[i]->outline) - centroid(real[j]->outline)).norm() > 5) return 0.0;
    return intersection_over_union(model[i]->outline, real[j]->outline);
  });
  std::map<std::string, DetectionScore> scores;
  DetectionScore all{"all", 0, static_cast<int>(real.size()), static_cast<int>(model.size())};
  for (const FittedFurniture* piece : model) ++scores[piece->type].model;
  for (const TrueFurniture* piece : real) ++scores[piece->type].truth;
  int right = 0;
  for (std::size_t i = 0; i < matched.size(); ++i) {
    if (matched[i] < 0) continue;
    ++all.matched;
    const bool same = model[i]->type == real[static_cast<std::size_t>(matched[i])]->type;
    right += same;
    if (same) ++scores[model[i]->type].matched;
  }
  for (auto& [kind, score] : scores) {
    score.kind = kind;
    evaluation.furniture.push_back(score);
  }
  evaluation.furniture.push_back(all);
  evaluation.furniture_class_right = all.matched == 0 ? 1 : static_cast<double>(right) / all.matched;
}

// ---- rooms
// -----------------------------------------------------------------------------------------------------

void score_rooms(const FittedFloor& fitted, const std::vector<const TrueRoom*>& real,
                 const FloorGroundTruth& floor, Evaluation& evaluation) {
  const std::vector<int> matched =
      match(fitted.rooms.size(), real.size(), 0.2, [&](std::size_t i, std::size_t j) {
        return intersection_over_union(fitted.rooms[i].outline, real[j]->outline);
      });
  std::vector<bool> found(real.size(), false);
  for (std::size_t i = 0; i < fitted.rooms.size(); ++i) {
    const FittedRoom& room = fitted.rooms[i];
    RoomScore score;
    score.id = room.id;
    score.space = room.space;
    score.type = room.type;
    score.origin = room.origin;
    score.extracted_width_m = room.extracted_width_m;
    score.width_m = room.width_m;
    score.sigma_m = room.width_sigma_m;
    score.type_probability = room.type_probability;
    score.outline = room.outline;
    if (matched[i] >= 0) {
      const TrueRoom& other = *real[static_cast<std::size_t>(matched[i])];
      found[static_cast<std::size_t>(matched[i])] = true;
      score.true_id = other.id;
      score.true_type = other.type;
      score.true_width_m = extent_along(other.outline, width_direction(room, fitted, floor));
      score.iou = intersection_over_union(room.outline, other.outline);
    }
    evaluation.rooms.push_back(std::move(score));
  }
  for (std::size_t j = 0; j < real.size(); ++j) {
    if (found[j]) continue;
    RoomScore score;
    score.true_id = real[j]->id;
    score.true_type = real[j]->type;
    score.outline = real[j]->outline;
    for (const Space& space : floor.spaces.empty() ? fitted.floor.spaces : floor.spaces) {
      if (!contains(space.outline, centroid(real[j]->outline))) continue;
      score.space = space.id;
      score.true_width_m = extent_along(real[j]->outline, (space.end - space.start).normalized());
    }
    evaluation.rooms.push_back(std::move(score));
  }
}

void score_spaces(Evaluation& evaluation) {
  std::vector<std::string> order;
  std::map<std::string, SpaceScore> spaces;
  for (const RoomScore& room : evaluation.rooms) {
    if (spaces.try_emplace(room.space).second) order.push_back(room.space);
    SpaceScore& space = spaces[room.space];
    space.id = room.space;
    space.rooms += !room.id.empty();
    space.true_rooms += !room.true_id.empty();
  }
  for (auto& [id, space] : spaces) {
    space.in_order = true;
    for (const RoomScore& room : evaluation.rooms)
      if (room.space == id) space.in_order = space.in_order && room.matched() && room.iou >= 0.5;
  }
  for (const std::string& id : order) evaluation.spaces.push_back(spaces[id]);
}

void score_errors(Evaluation& evaluation) {
  std::vector<double> extracted, observed, derived;
  int with_sigma = 0;
  double one = 0, two = 0, three = 0;
  evaluation.reliability = {{0, 0.5}, {0.5, 0.8}, {0.8, 0.95}, {0.95, 1.0}};
  for (const RoomScore& room : evaluation.rooms) {
    if (!room.id.empty()) {
      for (ReliabilityBin& bin : evaluation.reliability) {
        const bool last = bin.most == 1.0;
        if (room.type_probability < bin.least || (!last && room.type_probability >= bin.most)) continue;
        ++bin.count;
        bin.mean_probability += room.type_probability;
        bin.right +=
            room.matched() && room.iou >= 0.5 && (room.true_type.empty() || room.type == room.true_type);
        break;
      }
    }
    if (!room.matched()) continue;
    if (room.extracted_width_m) extracted.push_back(*room.extracted_width_m - room.true_width_m);
    (room.origin == Origin::observed ? observed : derived).push_back(room.error_m());
    if (room.sigma_m <= 0) continue;
    ++with_sigma;
    const double z = std::abs(room.error_m()) / room.sigma_m;
    one += z <= 1, two += z <= 2, three += z <= 3;
  }
  for (ReliabilityBin& bin : evaluation.reliability)
    if (bin.count > 0) bin.mean_probability /= bin.count;
  evaluation.extracted = summarise(extracted);
  evaluation.observed = summarise(observed);
  evaluation.derived = summarise(derived);
  if (with_sigma == 0) return;
  evaluation.within_1_sigma = one / with_sigma;
  evaluation.within_2_sigma = two / with_sigma;
  evaluation.within_3_sigma = three / with_sigma;
}

void score_walls(const FittedFloor& fitted, const std::vector<const TrueRoom*>& real,
                 Evaluation& evaluation) {
  std::map<std::string, const TrueRoom*> by_id;
  for (const TrueRoom* room : real) by_id[room->id] = room;
  std::vector<Polygon> model, truth, observed, observed_truth;
  for (const TrueRoom* room : real) truth.push_back(room->outline);
  for (std::size_t i = 0; i < fitted.rooms.size(); ++i) {
    const RoomScore& score = evaluation.rooms[i];
    model.push_back(score.outline);
    if (score.origin != Origin::observed) continue;
    observed.push_back(score.outline);
    if (score.matched()) observed_truth.push_back(by_id.at(score.true_id)->outline);
  }
  const WallDistances forth = wall_distances(truth, model), back = wall_distances(model, truth);
  const WallDistances observed_forth = wall_distances(observed_truth, observed);
  const WallDistances observed_back = wall_distances(observed, truth);
  for (const double buffer_m : {0.05, 0.10}) {
    evaluation.walls.push_back({buffer_m, forth.share_within(buffer_m), back.share_within(buffer_m)});
    evaluation.observed_walls.push_back(
        {buffer_m, observed_forth.share_within(buffer_m), observed_back.share_within(buffer_m)});
  }
  evaluation.wall_median_m = forth.median_within(0.10);
}

}  // namespace

Evaluation evaluate(const FittedFloor& fitted, const FloorTruth& truth, const FloorGroundTruth& floor) {
  Evaluation evaluation;
  const std::vector<const TrueRoom*> real = rooms_to_find(fitted, truth, floor);
  score_rooms(fitted, real, floor, evaluation);
  score_spaces(evaluation);
  score_errors(evaluation);
  score_walls(fitted, real, evaluation);

  std::vector<const FittedRoom*> all, observed;
  std::set<std::string> true_all, true_observed;
  for (const TrueRoom* room : real) true_all.insert(room->id);
  for (std::size_t i = 0; i < fitted.rooms.size(); ++i) {
    all.push_back(&fitted.rooms[i]);
    if (fitted.rooms[i].origin != Origin::observed) continue;
    observed.push_back(&fitted.rooms[i]);
    if (evaluation.rooms[i].matched()) true_observed.insert(evaluation.rooms[i].true_id);
  }
  for (const char* kind : {"door", "window"}) {
    evaluation.openings.push_back(score_openings(kind, all, true_all, truth, false));
    evaluation.observed_openings.push_back(score_openings(kind, observed, true_observed, truth, true));
  }
  score_furniture(observed, true_observed, truth, evaluation);
  return evaluation;
}

}  // namespace gramap
