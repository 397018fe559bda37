#include "perception/narrow_faces.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "perception/range_noise.h"

namespace gramap {
namespace {

constexpr std::size_t kPoints = 200000;   // of the cloud that are looked through
constexpr double kRegistration_m = 0.01;  // scans lie this far off one another, whatever their noise
constexpr double kCell_m = 0.1;           // of the raster that clusters are connected on
constexpr double kStep_m = 0.01;          // of a face's place
constexpr double kLeastPoints = 8;        // a face has, weighted by how well they fit

struct PlanPoint {
  Vec2 at;
  Vec2 ray;        // from the scanner, in the plan; shorter than 1 when the ray is steep
  double sigma_m;  // along the ray

  /// Standard deviation across a face with the normal `n`.
  double across_m(const Vec2& n) const { return std::hypot(sigma_m * n.dot(ray), kRegistration_m); }
};

/// The points under the ceiling that lie on no plane.
std::vector<PlanPoint> unexplained(const std::vector<PlanePatch>& planes, const RegisteredCloud& cloud,
                                   const Storey& storey, const WallOptions& options,
                                   const RangeNoise& noise) {
  const auto low =
      static_cast<float>(storey.ceiling_z_m - std::max(2 * options.top_band_m, 0.25 * storey.height_m()));
  const auto high = static_cast<float>(storey.ceiling_z_m);
  const std::size_t step = std::max<std::size_t>(1, cloud.points_m.size() / kPoints);
  std::vector<PlanPoint> rest;
  for (const RegisteredCloud::Part& part : cloud.parts)
    for (std::size_t i = part.begin; i < part.end; i += step) {
      const Point& point = cloud.points_m[i];
      if (point.z() < low || point.z() > high) continue;
      const Vec3 p = point.cast<double>(), ray = p - part.scanner_m;
      const double range = ray.norm(), sigma = noise.at(range);
      const auto explains = [&](const PlanePatch& plane) {
        if (std::abs(plane.normal.z()) > options.vertical_epsilon)
          return std::abs(plane.distance(p)) <
                 3 * std::hypot(sigma * plane.normal.dot(ray) / range, kRegistration_m);
        const double along = plane.u.dot(p - plane.corner) / plane.cell_m;
        return along >= 0 && along <= plane.columns &&
               std::abs(plane.distance(p)) <
                   3.5 * std::hypot(sigma * plane.normal.dot(ray) / range, kRegistration_m);
      };
      if (range > 0.1 && std::none_of(planes.begin(), planes.end(), explains))
        rest.push_back({p.head<2>(), ray.head<2>() / range, sigma});
    }
  return rest;
}

/// The directions that walls face, a quarter turn folded: radians in [0, π/2), by decreasing area.
std::vector<double> directions_of(const std::vector<PlanePatch>& planes, const WallOptions& options) {
  constexpr double kQuarter = std::numbers::pi / 2;
  struct Direction {
    double angle, area;
  };
  std::vector<Direction> found;
  for (const PlanePatch& plane : planes) {
    if (std::abs(plane.normal.z()) > options.vertical_epsilon) continue;
    double angle = std::fmod(std::atan2(plane.normal.y(), plane.normal.x()) + 2 * std::numbers::pi, kQuarter);
    const auto apart = [&](double a) {
      const double turn = std::remainder(a - angle, kQuarter);
      return std::abs(turn);
    };
    const auto same =
        std::find_if(found.begin(), found.end(), [&](const Direction& d) { return apart(d.angle) < 0.05; });
    if (same == found.end())
      found.push_back({angle, plane.area_m2});
    else
      same->area += plane.area_m2;
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Direction& a, const Direction& b) { return a.area > b.area; });
  std::vector<double> directions;
  for (const Direction& direction : found)
    if (direction.area >= 0.1 * found.front().area) directions.push_back(direction.angle);
  return directions;
}

/// Groups of points whose cells touch; cells of single points are strays.
std::vector<std::vector<PlanPoint>> clusters_of(const std::vector<PlanPoint>& points) {
  std::map<std::pair<long, long>, std::vector<std::size_t>> cells;
  for (std::size_t i = 0; i < points.size(); ++i)
    cells[{std::lround(points[i].at.x() / kCell_m), std::lround(points[i].at.y() / kCell_m)}].push_back(i);
  std::erase_if(cells, [](const auto& cell) { return cell.second.size() < 2; });
  std::vector<std::vector<PlanPoint>> clusters;
  while (!cells.empty()) {
    std::vector<PlanPoint> cluster;
    std::vector<std::pair<long, long>> stack = {cells.begin()->first};
    while (!stack.empty()) {
      const auto [x, y] = stack.back();
      stack.pop_back();
      const auto cell = cells.find({x, y});
      if (cell == cells.end()) continue;
      for (const std::size_t i : cell->second) cluster.push_back(points[i]);
      cells.erase(cell);
      for (long dx = -1; dx <= 1; ++dx)
        for (long dy = -1; dy <= 1; ++dy) stack.push_back({x + dx, y + dy});
    }
    if (static_cast<double>(cluster.size()) >= kLeastPoints) clusters.push_back(std::move(cluster));
  }
  return clusters;
}

struct Face {
  Vec2 normal;
  double rho_m = 0, score = 0, spread_m = 0;
  double from_m = 0, to_m = 0;  // along the normal turned left
  std::vector<std::size_t> points;
};

/// The place across `normal` where most of the cluster's points are piled up.
Face best_face(const std::vector<PlanPoint>& cluster, const Vec2& normal) {
  Face face;
  face.normal = normal;
  double low = 1e300, high = -1e300;
  for (const PlanPoint& point : cluster) {
    low = std::min(low, normal.dot(point.at));
    high = std::max(high, normal.dot(point.at));
  }
  const auto steps = static_cast<std::size_t>((high - low) / kStep_m) + 1;
  if (steps > 100000) return face;
  std::vector<double> heap(steps);
  double even = 0;  // what every place would have if the points were spread evenly
  for (const PlanPoint& point : cluster) {
    const double sigma = point.across_m(normal), place = normal.dot(point.at) - low;
    even += std::sqrt(2 * std::numbers::pi) * sigma / std::max(high - low, sigma);
    const auto first = static_cast<std::size_t>(std::max(0.0, (place - 3 * sigma) / kStep_m));
    for (std::size_t s = first; s < steps && static_cast<double>(s) * kStep_m <= place + 3 * sigma; ++s) {
      const double off = (static_cast<double>(s) * kStep_m - place) / sigma;
      heap[s] += std::exp(-off * off / 2);
    }
  }
  const auto top = std::max_element(heap.begin(), heap.end());
  face.rho_m = low + kStep_m * static_cast<double>(top - heap.begin());
  face.score = *top;
  if (*top < kLeastPoints || (high - low > 0.2 && *top < 1.3 * even)) face.score = 0;
  return face;
}

/// The face's points, its exact place, and the extent of its longest run of points.
void settle(Face& face, const std::vector<PlanPoint>& cluster) {
  const Vec2 along(-face.normal.y(), face.normal.x());
  std::vector<std::pair<double, std::size_t>> own;
  for (int round = 0; round < 3; ++round) {
    own.clear();
    double weights = 0, sum = 0;
    for (std::size_t i = 0; i < cluster.size(); ++i) {
      const double sigma = cluster[i].across_m(face.normal), place = face.normal.dot(cluster[i].at);
      if (std::abs(place - face.rho_m) > 2 * sigma) continue;
      own.push_back({along.dot(cluster[i].at), i});
      weights += 1 / (sigma * sigma);
      sum += place / (sigma * sigma);
    }
    if (own.empty()) return;
    face.rho_m = sum / weights;
  }
  std::sort(own.begin(), own.end());
  std::size_t best = 0, best_end = 0;
  for (std::size_t begin = 0, i = 1; i <= own.size(); ++i)
    if (i == own.size() || own[i].first - own[i - 1].first > 2.5 * kCell_m) {
      if (i - begin > best_end - best) best = begin, best_end = i;
      begin = i;
    }
  face.points.clear();
  double squares = 0;
  for (std::size_t i = best; i < best_end; ++i) {
    face.points.push_back(own[i].second);
    const double off = face.normal.dot(cluster[own[i].second].at) - face.rho_m;
    squares += off * off;
  }
  // The outermost points are noise along the face.
  const std::size_t cut = (best_end - best) / 50;
  face.from_m = own[best + cut].first;
  face.to_m = own[best_end - 1 - cut].first;
  face.spread_m = std::sqrt(squares / static_cast<double>(face.points.size()));
}

PlanePatch patch_of(const Face& face, const Storey& storey, const WallOptions& options) {
  PlanePatch patch;
  patch.normal << face.normal, 0;
  patch.u << -face.normal.y(), face.normal.x(), 0;
  patch.v = Vec3::UnitZ();
  patch.rho_m = face.rho_m;
  patch.rms_m = face.spread_m;
  patch.band_m = std::clamp(3 * face.spread_m, 0.02, 0.07);
  patch.support = face.points.size();
  patch.cell_m = kCell_m;
  patch.columns = std::max(1, static_cast<int>((face.to_m - face.from_m) / kCell_m + 0.5)) + 2;
  const double bottom = storey.ceiling_z_m - std::max(2 * options.top_band_m, 0.25 * storey.height_m());
  patch.rows = static_cast<int>((storey.ceiling_z_m - bottom) / kCell_m) + 2;
  patch.corner =
      patch.normal * patch.rho_m + patch.u * (face.from_m - kCell_m) + patch.v * (bottom - kCell_m);
  patch.occupied.assign(static_cast<std::size_t>(patch.columns) * static_cast<std::size_t>(patch.rows), 0);
  for (int row = 1; row + 1 < patch.rows; ++row)
    for (int column = 1; column + 1 < patch.columns; ++column)
      patch.occupied[static_cast<std::size_t>(row * patch.columns + column)] = 1;
  patch.area_m2 = kCell_m * kCell_m * (patch.columns - 2) * (patch.rows - 2);
  return patch;
}

}  // namespace

std::vector<PlanePatch> find_narrow_faces(const std::vector<PlanePatch>& planes, const RegisteredCloud& cloud,
                                          const Storey& storey, const WallOptions& options,
                                          const RangeNoise& noise) {
  std::vector<PlanePatch> found;
  const std::vector<double> directions = directions_of(planes, options);
  for (std::vector<PlanPoint>& cluster : clusters_of(unexplained(planes, cloud, storey, options, noise)))
    for (int faces = 0; faces < 20; ++faces) {
      Face best;
      for (const double direction : directions)
        for (const double angle : {direction, direction + std::numbers::pi / 2}) {
          Face face = best_face(cluster, Vec2(std::cos(angle), std::sin(angle)));
          if (face.score > best.score) best = std::move(face);
        }
      if (best.score == 0) break;
      settle(best, cluster);
      if (best.points.empty()) break;
      if (best.to_m - best.from_m > kCell_m / 2) found.push_back(patch_of(best, storey, options));
      std::sort(best.points.begin(), best.points.end());
      for (auto i = best.points.rbegin(); i != best.points.rend(); ++i)
        cluster.erase(cluster.begin() + static_cast<std::ptrdiff_t>(*i));
    }
  return found;
}

}  // namespace gramap
