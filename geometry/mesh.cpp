#include "geometry/mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <utility>

namespace gramap {
namespace {

using Interval = std::array<double, 2>;

/// What `solid` fills and `other` does not; both sorted and disjoint.
std::vector<Interval> difference(const std::vector<Interval>& solid, const std::vector<Interval>& other) {
  std::vector<Interval> rest;
  for (Interval piece : solid) {
    for (const Interval& cut : other) {
      if (cut[1] <= piece[0] || cut[0] >= piece[1]) continue;
      if (cut[0] > piece[0]) rest.push_back({piece[0], cut[0]});
      piece[0] = cut[1];
      if (piece[0] >= piece[1]) break;
    }
    if (piece[0] < piece[1]) rest.push_back(piece);
  }
  return rest;
}

class Extrusion {
 public:
  Extrusion(const std::vector<Vec2>& plan, const std::vector<PrismCell>& cells)
      : plan_(plan), cells_(cells) {}

  Mesh build() {
    for (std::size_t cell = 0; cell < cells_.size(); ++cell)
      for (const Triangle& triangle : cells_[cell].triangles)
        for (int k = 0; k < 3; ++k) {
          cell_right_of_[{triangle[(k + 1) % 3], triangle[k]}] = static_cast<int>(cell);
          std::vector<double>& levels = levels_[triangle[k]];
          for (const Interval& interval : cells_[cell].heights_m)
            levels.insert(levels.end(), interval.begin(), interval.end());
        }
    for (auto& [point, levels] : levels_) {
      std::sort(levels.begin(), levels.end());
      levels.erase(std::unique(levels.begin(), levels.end()), levels.end());
    }
    for (std::size_t cell = 0; cell < cells_.size(); ++cell) {
      caps(cells_[cell]);
      for (const Triangle& triangle : cells_[cell].triangles)
        for (int k = 0; k < 3; ++k) sides(static_cast<int>(cell), triangle[k], triangle[(k + 1) % 3]);
    }
    return std::move(mesh_);
  }

 private:
  int at(int point, double height) {
    const auto [entry, is_new] = index_.try_emplace({point, height}, static_cast<int>(mesh_.points.size()));
    if (is_new) mesh_.points.emplace_back(plan_[point].x(), plan_[point].y(), height);
    return entry->second;
  }

  void caps(const PrismCell& cell) {
    for (const Triangle& t : cell.triangles)
      for (const auto& [bottom, top] : cell.heights_m) {
        mesh_.triangles.push_back({at(t[0], bottom), at(t[2], bottom), at(t[1], bottom)});
        mesh_.triangles.push_back({at(t[0], top), at(t[1], top), at(t[2], top)});
      }
  }

  void sides(int cell, int a, int b) {
    const auto behind = cell_right_of_.find({a, b});
    const bool open = behind == cell_right_of_.end();
    if (!open && behind->second == cell) return;
    static const std::vector<Interval> nothing;
    for (const auto& [bottom, top] :
         difference(cells_[cell].heights_m, open ? nothing : cells_[behind->second].heights_m))
      strip(a, b, bottom, top);
  }

  /// The side face over a -> b from bottom to top, with every level that either end has: a zip of two chains.
  /// Where both could climb, the point of the larger index does, so that solids that abut have the same
  /// triangles there.
  void strip(int a, int b, double bottom, double top) {
    const std::vector<double> left = chain(a, bottom, top), right = chain(b, bottom, top);
    std::size_t i = 0, j = 0;
    while (i + 1 < left.size() || j + 1 < right.size()) {
      const bool climb_right = j + 1 < right.size() && (i + 1 == left.size() || right[j + 1] < left[i + 1] ||
                                                        (right[j + 1] == left[i + 1] && b > a));
      if (climb_right) {
        mesh_.triangles.push_back({at(a, left[i]), at(b, right[j]), at(b, right[j + 1])});
        ++j;
      } else {
        mesh_.triangles.push_back({at(a, left[i]), at(b, right[j]), at(a, left[i + 1])});
        ++i;
      }
    }
  }

  std::vector<double> chain(int point, double bottom, double top) const {
    const std::vector<double>& levels = levels_.at(point);
    return {std::lower_bound(levels.begin(), levels.end(), bottom),
            std::upper_bound(levels.begin(), levels.end(), top)};
  }

  const std::vector<Vec2>& plan_;
  const std::vector<PrismCell>& cells_;
  std::map<std::pair<int, int>, int> cell_right_of_;  ///< by directed plan edge
  std::map<int, std::vector<double>> levels_;         ///< heights that end at a plan point
  std::map<std::pair<int, double>, int> index_;
  Mesh mesh_;
};

}  // namespace

void append(Mesh& mesh, const Mesh& part) {
  const int first = static_cast<int>(mesh.points.size());
  mesh.points.insert(mesh.points.end(), part.points.begin(), part.points.end());
  for (const Triangle& t : part.triangles)
    mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
}

double signed_volume(const Mesh& mesh) {
  if (mesh.points.empty()) return 0;
  const Vec3 origin = mesh.points.front();
  double sum = 0;
  for (const Triangle& t : mesh.triangles)
    sum += (mesh.points[t[0]] - origin).dot((mesh.points[t[1]] - origin).cross(mesh.points[t[2]] - origin));
  return sum / 6;
}

Mesh box(const Vec3& origin, const Vec2& u, const Vec2& v, double length_m, double breadth_m,
         double height_m) {
  const Vec2 corner = origin.head<2>();
  const std::vector<Vec2> plan = {corner, corner + u * length_m, corner + u * length_m + v * breadth_m,
                                  corner + v * breadth_m};
  return extrude(plan, {{{{0, 1, 2}, {0, 2, 3}}, {{origin.z(), origin.z() + height_m}}}});
}

Mesh extrude(const std::vector<Vec2>& plan_points, const std::vector<PrismCell>& cells) {
  return Extrusion(plan_points, cells).build();
}

}  // namespace gramap
