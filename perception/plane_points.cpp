#include "perception/plane_points.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "geometry/polygon.h"

namespace gramap {
namespace {

constexpr double kSigmas = 3;  // points up to so many deviations off are the face's
constexpr double kBeside = 9;  // what lies between, up to so many, tells of points that are not
constexpr double kMostBeside =
    0.1;                         // of those on the face: half as many are wrongly among them, all on one side
constexpr double kCell_m = 0.2;  // small enough for frames, large enough for a handful of points each
constexpr double kLeastPlain = 0.2;  // of a face's points; a face that has less is measured on all it has

/// How the rays through the cells of a face end.
class FaceCells {
 public:
  struct Cell {
    int on = 0;
    int beside = 0;  ///< a little in front of it, or beyond
    bool is_plain() const { return beside <= kMostBeside * on; }
  };

  FaceCells(const RoomFaces& faces, std::size_t plane) : plane_(faces.planes[plane]) {
    Vec2 low(1e300, 1e300), high = -low;
    const auto widen = [&](const Vec2& p) { low = low.cwiseMin(p), high = high.cwiseMax(p); };
    if (plane < 2) {
      for (const Vec2& corner : faces.ring) widen(on_plane(Vec3(corner.x(), corner.y(), plane_.middle.z())));
    } else {
      const double reach = faces.planes[1].middle.z() - faces.planes[0].middle.z();
      for (const FaceStretch& s : faces.stretches[plane]) widen({s.from, -reach}), widen({s.to, reach});
    }
    if (low.x() > high.x()) low = high = Vec2::Zero();
    low_ = low;
    columns_ = 1 + static_cast<std::size_t>((high.x() - low.x()) / kCell_m);
    rows_ = 1 + static_cast<std::size_t>((high.y() - low.y()) / kCell_m);
    cells_.resize(columns_ * rows_);
  }
  std::uint32_t index(const Vec3& place) const {
    const Vec2 p = (on_plane(place) - low_) / kCell_m;
    const auto clamped = [](double x, std::size_t n) {
      return static_cast<std::size_t>(std::clamp(x, 0.0, static_cast<double>(n - 1)));
    };
    return static_cast<std::uint32_t>(clamped(p.y(), rows_) * columns_ + clamped(p.x(), columns_));
  }
  Cell& operator[](std::uint32_t index) { return cells_[index]; }

 private:
  const AdjustedPlane& plane_;
  Vec2 low_;
  std::size_t columns_, rows_;
  std::vector<Cell> cells_;

  Vec2 on_plane(const Vec3& place) const {
    const Vec3 offset = place - plane_.middle;
    return {plane_.u.dot(offset), plane_.v.dot(offset)};
  }
};

}  // namespace

bool RoomFaces::covers(std::size_t plane, const Vec3& place) const {
  if (plane < 2) return contains(ring, place.head<2>());
  if (!(place.z() > planes[0].middle.z() + 0.1 && place.z() < planes[1].middle.z() - 0.1)) return false;
  const double along = planes[plane].u.dot(place - planes[plane].middle);
  return std::any_of(stretches[plane].begin(), stretches[plane].end(),
                     [&](const FaceStretch& s) { return along >= s.from && along <= s.to; });
}

std::optional<Meeting> meeting(const AdjustedPlane& plane, const Vec3& scanner, const Vec3& point) {
  const Vec3 ray = point - scanner;
  const double part = plane.normal.dot(plane.middle - scanner) / plane.normal.dot(ray);
  if (!(part > 0 && part < 2)) return std::nullopt;
  const double range = ray.norm();
  return Meeting{scanner + part * ray, part * range, std::abs(plane.normal.dot(ray)) / range};
}

std::vector<PlanePoint> points_on(const RoomFaces& faces, const FaceNoise& noise,
                                  const RegisteredCloud& cloud,
                                  const std::vector<Eigen::Isometry3d>& corrections, std::size_t most) {
  const std::vector<AdjustedPlane>& planes = faces.planes;
  std::vector<FaceCells> cells;
  for (std::size_t k = 0; k < planes.size(); ++k) cells.emplace_back(faces, k);
  std::vector<PlanePoint> points;
  std::vector<std::uint32_t> cell_of_point;
  const std::size_t step = std::max<std::size_t>(1, cloud.points_m.size() / most);
  for (std::uint32_t part = 0; part < cloud.parts.size(); ++part) {
    const RegisteredCloud::Part& scan = cloud.parts[part];
    const Vec3 scanner = corrections[part] * scan.scanner_m;
    for (std::size_t i = scan.begin; i < scan.end; i += step) {
      const Vec3 raw = cloud.points_m[i].cast<double>(), p = corrections[part] * raw;
      double nearest = kSigmas;
      PlanePoint best;
      std::uint32_t best_cell = 0;
      for (std::uint32_t k = 0; k < planes.size(); ++k) {
        if (k == 1 && !faces.level_ceiling) continue;
        const double across = planes[k].normal.dot(p - planes[k].middle);
        if (std::abs(across) > kBeside * FaceNoise::kLargest_m) continue;
        const std::optional<Meeting> met = meeting(planes[k], scanner, p);
        if (!met) continue;
        const double sigma = noise.at(met->range_m, met->slope);
        if (std::abs(across) > kBeside * sigma || !faces.covers(k, met->place)) continue;
        const std::uint32_t cell = cells[k].index(met->place);
        ++(std::abs(across) <= kSigmas * sigma ? cells[k][cell].on : cells[k][cell].beside);
        if (std::abs(across) > nearest * sigma) continue;
        nearest = std::abs(across) / sigma;
        best = {raw, sigma, part, k};
        best_cell = cell;
      }
      if (nearest < kSigmas) points.push_back(best), cell_of_point.push_back(best_cell);
    }
  }
  std::vector<std::size_t> all(planes.size()), plain(planes.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    ++all[points[i].plane];
    plain[points[i].plane] += cells[points[i].plane][cell_of_point[i]].is_plain();
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::size_t k = points[i].plane;
    if (static_cast<double>(plain[k]) >= kLeastPlain * static_cast<double>(all[k]) &&
        !cells[k][cell_of_point[i]].is_plain())
      continue;
    points[kept++] = points[i];
  }
  points.resize(kept);
  return points;
}

}  // namespace gramap
