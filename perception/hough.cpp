#include "perception/hough.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "perception/accumulator.h"
#include "perception/neighbourhood.h"
#include "perception/plane_fit.h"
#include "perception/plane_refit.h"

namespace gramap {
namespace {

// Triples drawn in vain before giving up, when fewer points are left than that takes: a plane of which every
// point began so many triples does not stand out from the clutter.
constexpr int kTrialsPerPoint = 8, kLeastTrials = 5000;

/// At most `count` points, one at random from each of as many equal stretches of the cloud, relative to
/// `centre`.
std::vector<Point> sampled(std::span<const Point> points, std::size_t count, const Point& centre,
                           Random& random) {
  std::vector<Point> sample;
  if (points.size() <= count) {
    sample.assign(points.begin(), points.end());
  } else {
    sample.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t begin = i * points.size() / count, end = (i + 1) * points.size() / count;
      sample.push_back(points[begin + static_cast<std::size_t>(random.below(static_cast<int>(end - begin)))]);
    }
  }
  for (Point& point : sample) point -= centre;
  return sample;
}

struct Candidate {
  Eigen::Vector3f normal;
  float rho;
};

/// Draws triples and votes until a cell has enough votes; nothing when `trials` comes to the most allowed.
std::optional<Candidate> draw_candidate(const Neighbourhood& near, BallAccumulator& votes, Random& random,
                                        const HoughOptions& options, int& trials) {
  const std::vector<Point>& points = near.points();
  const float min_squared = static_cast<float>(options.min_pair_m * options.min_pair_m);
  const float max_squared = static_cast<float>(options.max_pair_m * options.max_pair_m);
  const int most =
      std::min(options.max_trials, std::max(kLeastTrials, kTrialsPerPoint * static_cast<int>(points.size())));
  for (; trials < most; ++trials) {
    // Half of the triples start anywhere in the cloud, half anywhere in the room.
    const std::uint32_t first =
        trials & 1 ? near.draw_by_place(random)
                   : static_cast<std::uint32_t>(random.below(static_cast<int>(points.size())));
    // Every second triple or so is refused, and no processor can guess which: one question, asked at the end.
    const Point& p = points[first];
    const Eigen::Vector3f a = points[near.draw(first, random)] - p, b = points[near.draw(first, random)] - p;
    const float a2 = a.squaredNorm(), b2 = b.squaredNorm();
    Eigen::Vector3f normal = a.cross(b);
    const float squared = normal.squaredNorm();
    const bool in_band =
        (a2 >= min_squared) & (a2 <= max_squared) & (b2 >= min_squared) & (b2 <= max_squared);
    if (!(in_band & (squared >= 0.15f * a2 * b2))) continue;  // a sliver: less than 23°
    normal /= std::sqrt(squared);
    float rho = normal.dot(p);
    if (rho < 0) {
      normal = -normal;
      rho = -rho;
    }
    BallAccumulator::Cell& cell = votes.vote(normal, rho);
    if (cell.votes >= options.votes && !cell.refused) {
      cell.refused = true;  // if the plane is good the votes are cleared; if not, never try this cell again
      return Candidate{cell.normal_sum.normalized(), cell.rho_sum / static_cast<float>(cell.votes)};
    }
  }
  return std::nullopt;
}

/// The raster of the points on a plane; keeps the patch with most points and marks those in `inside`.
void keep_largest_patch(PlanePatch& patch, const std::vector<Point>& points,
                        const std::vector<std::uint32_t>& near, double cell_m,
                        std::vector<std::uint32_t>& inside) {
  patch.u = std::abs(patch.normal.z()) > 0.7 ? Vec3::UnitX() : Vec3::UnitZ().cross(patch.normal);
  patch.u = (patch.u - patch.normal * patch.normal.dot(patch.u)).normalized();
  patch.v = patch.normal.cross(patch.u);
  const Eigen::Vector3f u = patch.u.cast<float>(), v = patch.v.cast<float>();
  Eigen::Vector2f low(1e30f, 1e30f), high(-1e30f, -1e30f);
  std::vector<Eigen::Vector2f> feet(near.size());
  for (std::size_t i = 0; i < near.size(); ++i) {
    feet[i] = Eigen::Vector2f(u.dot(points[near[i]]), v.dot(points[near[i]]));
    low = low.cwiseMin(feet[i]);
    high = high.cwiseMax(feet[i]);
  }
  const double extent = (high - low).maxCoeff();
  patch.cell_m = std::max(cell_m, extent / 1500);
  const float cell = static_cast<float>(patch.cell_m);
  // One empty cell around, so that `covers` and the search below need no border cases.
  patch.columns = static_cast<int>((high.x() - low.x()) / cell) + 3;
  patch.rows = static_cast<int>((high.y() - low.y()) / cell) + 3;
  patch.corner = patch.normal * patch.rho_m + patch.u * (static_cast<double>(low.x()) - patch.cell_m) +
                 patch.v * (static_cast<double>(low.y()) - patch.cell_m);
  const auto at = [&](const Eigen::Vector2f& foot) {
    return static_cast<std::size_t>((foot.y() - low.y()) / cell + 1) *
               static_cast<std::size_t>(patch.columns) +
           static_cast<std::size_t>((foot.x() - low.x()) / cell + 1);
  };
  std::vector<std::uint32_t> count(static_cast<std::size_t>(patch.columns) *
                                   static_cast<std::size_t>(patch.rows));
  for (const Eigen::Vector2f& foot : feet) ++count[at(foot)];

  std::vector<std::uint32_t> label(count.size());
  std::vector<std::size_t> stack;
  std::uint32_t labels = 0, best = 0;
  std::size_t best_points = 0;
  for (std::size_t start = 0; start < count.size(); ++start) {
    if (!count[start] || label[start]) continue;
    std::size_t sum = 0;
    label[start] = ++labels;
    stack.push_back(start);
    while (!stack.empty()) {
      const std::size_t here = stack.back();
      stack.pop_back();
      sum += count[here];
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
          const std::size_t next = here + static_cast<std::size_t>(dy * patch.columns + dx);
          if (count[next] && !label[next]) {
            label[next] = labels;
            stack.push_back(next);
          }
        }
    }
    if (sum > best_points) {
      best_points = sum;
      best = labels;
    }
  }
  patch.occupied.assign(count.size(), 0);
  std::size_t cells = 0;
  for (std::size_t i = 0; i < count.size(); ++i)
    if (label[i] == best) {
      patch.occupied[i] = 1;
      ++cells;
    }
  patch.area_m2 = static_cast<double>(cells) * patch.cell_m * patch.cell_m;
  inside.clear();
  for (std::size_t i = 0; i < near.size(); ++i)
    if (label[at(feet[i])] == best) inside.push_back(near[i]);
}

/// Indices of the points within `band` of the plane.
void collect(const std::vector<Point>& points, const FittedPlane& plane, double band,
             std::vector<std::uint32_t>& near) {
  const Eigen::Vector3f normal = plane.normal.cast<float>();
  const float rho = static_cast<float>(plane.rho_m), limit = static_cast<float>(band);
  near.clear();
  for (std::uint32_t i = 0; i < points.size(); ++i)
    if (std::abs(normal.dot(points[i]) - rho) <= limit) near.push_back(i);
}

FittedPlane fit(const std::vector<Point>& points, const std::vector<std::uint32_t>& chosen) {
  Moments moments;
  for (const std::uint32_t i : chosen) moments.add(points[i].cast<double>());
  return fit_plane(moments);
}

/// Three robust standard deviations of the points' distances, from their median.
double trimmed_band(const std::vector<Point>& points, const std::vector<std::uint32_t>& chosen,
                    const FittedPlane& plane, double limit) {
  const Eigen::Vector3f normal = plane.normal.cast<float>();
  const float rho = static_cast<float>(plane.rho_m);
  std::vector<float> distances(chosen.size());
  for (std::size_t i = 0; i < chosen.size(); ++i)
    distances[i] = std::abs(normal.dot(points[chosen[i]]) - rho);
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  return std::clamp(3 * 1.4826 * static_cast<double>(*middle), 0.01, limit);
}

/// What became of a candidate.
enum class Grown {
  kPlane,
  kTooSmall,
  kRim,  ///< it does not stand out from the points around it: the rim of another plane's noise, or clutter
};

/// Grows a candidate into a plane patch.
Grown grow(const std::vector<Point>& points, const std::vector<Point>& all, const Candidate& candidate,
           const std::vector<PlanePatch>& known, const HoughOptions& options, PlanePatch& patch) {
  FittedPlane plane{candidate.normal.cast<double>().normalized(), candidate.rho, 0};
  std::vector<std::uint32_t> near, inside;
  double band = options.max_distance_m;
  const auto minimum = static_cast<std::size_t>(options.min_support);
  for (int round = 0; round < 4; ++round) {
    collect(points, plane, band, near);
    if (near.size() < minimum) return Grown::kTooSmall;
    patch.normal = plane.normal;
    patch.rho_m = plane.rho_m;
    // A raster finer than the points are dense falls to pieces: coarser until its cells hold several.
    for (double cell = options.patch_cell_m;; cell *= 1.5) {
      keep_largest_patch(patch, points, near, cell, inside);
      const double cells = patch.area_m2 / (patch.cell_m * patch.cell_m);
      if (cell >= 0.6 || static_cast<double>(inside.size()) >= 2.5 * cells) break;
    }
    if (inside.size() < minimum || patch.area_m2 < options.min_area_m2) return Grown::kTooSmall;
    plane = fit(points, inside);
    if (round > 0) band = trimmed_band(points, inside, plane, options.max_distance_m);
  }
  patch.normal = plane.normal;
  patch.rho_m = plane.rho_m;
  patch.rms_m = plane.rms_m;
  patch.band_m = band;
  patch.support = inside.size();
  // A plane stands out: as much space beside it holds far fewer points, those of parallel planes found before
  // included. Planes that stand across it say nothing: every narrow face has them at its edges.
  const auto across = [&](const Vec3& p) {
    return std::any_of(known.begin(), known.end(), [&](const PlanePatch& other) {
      return std::abs(other.normal.dot(patch.normal)) < 0.9 &&
             std::abs(other.distance(p)) <= 1.5 * other.band_m && other.covers(p);
    });
  };
  std::size_t beside = 0;
  const Eigen::Vector3f normal = patch.normal.cast<float>();
  const float rho = static_cast<float>(patch.rho_m), nearest = static_cast<float>(1.5 * band),
              farthest = static_cast<float>(3.5 * band);
  for (const Point& point : all) {
    const float distance = std::abs(normal.dot(point) - rho);
    if (!((distance > nearest) & (distance <= farthest))) continue;
    const Vec3 p = point.cast<double>();
    beside += patch.covers(p) && !across(p);
  }
  return static_cast<double>(beside) > 0.8 * static_cast<double>(inside.size()) ? Grown::kRim : Grown::kPlane;
}

}  // namespace

std::vector<PlanePatch> detect_planes(std::span<const Point> points, const HoughOptions& options) {
  std::vector<PlanePatch> patches;
  if (points.size() < static_cast<std::size_t>(options.min_support)) return patches;
  Random random(options.seed);
  Vec3 sum = Vec3::Zero();
  const std::size_t step = std::max<std::size_t>(1, points.size() / 4096);
  std::size_t counted = 0;
  for (std::size_t i = 0; i < points.size(); i += step, ++counted) sum += points[i].cast<double>();
  const Point centre = (sum / static_cast<double>(counted)).cast<float>();

  Neighbourhood near(sampled(points, static_cast<std::size_t>(options.sample), centre, random),
                     options.max_pair_m / 2);
  const std::vector<Point> all = near.points();
  BallAccumulator votes(options.angle_cell_rad, options.rho_cell_m);
  std::vector<std::uint8_t> taken;
  int trials = 0, refusals = 0;  // since the last plane
  while (static_cast<int>(patches.size()) < options.max_planes &&
         near.points().size() >= static_cast<std::size_t>(options.min_support)) {
    const std::optional<Candidate> candidate = draw_candidate(near, votes, random, options, trials);
    if (!candidate) break;
    PlanePatch patch;
    const Grown grown = grow(near.points(), all, *candidate, patches, options, patch);
    if (grown == Grown::kTooSmall) {
      if (++refusals == options.max_refusals) break;
      continue;
    }
    // A rim's points are taken out like a plane's: they would only be drawn again.
    taken.assign(near.points().size(), 0);
    const double reach = grown == Grown::kRim ? patch.band_m : std::max(1.5 * patch.band_m, 0.03);
    const Eigen::Vector3f normal = patch.normal.cast<float>();
    const float rho = static_cast<float>(patch.rho_m), limit = static_cast<float>(reach);
    for (std::size_t i = 0; i < taken.size(); ++i) {
      const Point& p = near.points()[i];
      taken[i] = std::abs(normal.dot(p) - rho) <= limit && patch.covers(p.cast<double>());
    }
    near.remove(taken);
    votes.clear();
    if (grown == Grown::kRim) continue;
    trials = refusals = 0;
    patches.push_back(patch);
  }

  refit_planes(patches, points, centre);
  for (PlanePatch& patch : patches) {  // back to the cloud's origin
    const Vec3 shift = centre.cast<double>();
    patch.corner += shift;
    patch.rho_m += patch.normal.dot(shift);
    if (patch.rho_m < 0) {
      patch.rho_m = -patch.rho_m;
      patch.normal = -patch.normal;
    }
  }
  std::stable_sort(patches.begin(), patches.end(),
                   [](const PlanePatch& a, const PlanePatch& b) { return a.support > b.support; });
  return patches;
}

}  // namespace gramap
