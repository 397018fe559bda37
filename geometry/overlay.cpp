#include "geometry/overlay.h"

// CGAL warns in debug builds that intersections of exact constraints may cascade. Ours do not: a cut ends
// where it meets a ring, and rings meet in corners.
#define CGAL_NO_CDT_2_WARNING
#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_rational.h>
#include <CGAL/Polygon_2_algorithms.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace gramap {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Point = Kernel::Point_2;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<int, Kernel>;
using FaceInfo = CGAL::Triangulation_face_base_with_info_2<int, Kernel>;
using FaceBase = CGAL::Constrained_triangulation_face_base_2<Kernel, FaceInfo>;
using Triangulation = CGAL::Constrained_Delaunay_triangulation_2<
    Kernel, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>, CGAL::Exact_intersections_tag>;
using Rational = CGAL::Exact_rational;

struct ExactPoint {
  Rational x, y;
};

Rational cross(const ExactPoint& a, const ExactPoint& b) {
  return a.x * b.y - a.y * b.x;
}

Rational twice_area(const ExactPoint& a, const ExactPoint& b, const ExactPoint& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

Point exact(const Vec2& p) {
  return {p.x(), p.y()};
}

ExactPoint rational(const Vec2& p) {
  return {Rational(p.x()), Rational(p.y())};
}

Point exact(const std::vector<Polygon>& rings, const PointOnRing& point) {
  const Polygon& ring = rings[point.ring];
  const Point p = exact(ring[point.edge]), q = exact(ring[(point.edge + 1) % ring.size()]);
  if (point.t <= 0) return p;
  if (point.t >= 1) return q;
  if (CGAL::collinear(p, q, exact(point.at))) return exact(point.at);
  return p + Kernel::FT(point.t) * (q - p);
}

/// The bounds of a ring or a point, with its number: what holds what is asked only where these overlap.
using Bounds = CGAL::Box_intersection_d::Box_with_info_d<double, 2, std::size_t>;

class Builder {
 public:
  Builder(const std::vector<Polygon>& rings, const std::vector<Cut>& cuts)
      : rings_(rings), cuts_(cuts), tiled_(rings.size(), Rational(0)) {}

  Overlay build() {
    insert();
    number_points();
    flood();
    find_rings();
    sum_areas();
    return std::move(result_);
  }

 private:
  void insert() {
    for (const Polygon& ring : rings_) {
      Triangulation::Vertex_handle first, previous;
      for (const Vec2& p : ring) {
        const auto vertex = triangulation_.insert(
            exact(p), previous == nullptr ? Triangulation::Face_handle() : previous->face());
        if (previous == nullptr) first = vertex;
        if (previous != nullptr && previous != vertex) triangulation_.insert_constraint(previous, vertex);
        previous = vertex;
      }
      if (previous != first) triangulation_.insert_constraint(previous, first);
    }
    Triangulation::Face_handle hint;
    for (const Cut& cut : cuts_) {
      const auto from = triangulation_.insert(exact(rings_, cut.from), hint);
      const auto to = triangulation_.insert(exact(rings_, cut.to), from->face());
      if (from != to) triangulation_.insert_constraint(from, to);
      hint = to->face();
    }
  }

  /// Points so near to each other that they are the same in doubles become one.
  void number_points() {
    std::map<std::pair<double, double>, int> numbers;
    for (const auto vertex : triangulation_.finite_vertex_handles()) {
      vertex->info() = static_cast<int>(exact_.size());
      const auto& point = vertex->point();
      const double x = CGAL::to_double(point.x()), y = CGAL::to_double(point.y());
      const auto [number, fresh] = numbers.try_emplace({x, y}, static_cast<int>(result_.points.size()));
      if (fresh) result_.points.emplace_back(x, y);
      number_.push_back(number->second);
      exact_.push_back({Rational(point.x().exact()), Rational(point.y().exact())});
    }
  }

  /// Cells: triangles that no constraint separates.
  void flood() {
    for (const auto face : triangulation_.all_face_handles()) face->info() = -1;
    for (const auto start : triangulation_.finite_face_handles()) {
      if (start->info() >= 0) continue;
      std::vector<Triangulation::Face_handle> faces{start};
      bool reaches_infinity = false;
      start->info() = 1;
      for (std::size_t i = 0; i < faces.size(); ++i)
        for (int k = 0; k < 3; ++k) {
          const auto next = faces[i]->neighbor(k);
          if (faces[i]->is_constrained(k) || next->info() >= 0) continue;
          if (triangulation_.is_infinite(next)) {
            reaches_infinity = true;
            continue;
          }
          next->info() = 1;
          faces.push_back(next);
        }
      if (!reaches_infinity) add_cell(faces);
    }
  }

  void add_cell(const std::vector<Triangulation::Face_handle>& faces) {
    Overlay::Cell& cell = result_.cells.emplace_back();
    double largest = -1;
    Triangulation::Face_handle inner;
    Rational twice = 0;
    for (const auto face : faces) {
      const int a = face->vertex(0)->info(), b = face->vertex(1)->info(), c = face->vertex(2)->info();
      twice += twice_area(exact_[a], exact_[b], exact_[c]);
      const Triangle t{number_[a], number_[b], number_[c]};
      if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
      cell.triangles.push_back(t);
      const Vec2 u = result_.points[t[1]] - result_.points[t[0]],
                 v = result_.points[t[2]] - result_.points[t[0]];
      const double area = (u.x() * v.y() - u.y() * v.x()) / 2;
      cell.area_m2 += area;
      if (area > largest) largest = area, inner = face;
    }
    const Point inside =
        CGAL::centroid(triangulation_.triangle(cell.triangles.empty() ? faces.front() : inner));
    cell.inside = {CGAL::to_double(inside.x()), CGAL::to_double(inside.y())};
    inside_.push_back(inside);
    twice_area_.push_back(std::move(twice));
  }

  /// The rings that hold each cell. Cells that none holds are dropped.
  void find_rings() {
    std::vector<std::vector<Point>> rings;
    std::vector<Bounds> ring_bounds, point_bounds;
    for (const Polygon& ring : rings_) {
      CGAL::Bbox_2 box;
      std::vector<Point>& points = rings.emplace_back();
      for (const Vec2& p : ring) points.push_back(exact(p)), box += points.back().bbox();
      ring_bounds.emplace_back(box, rings.size() - 1);
    }
    for (std::size_t cell = 0; cell < inside_.size(); ++cell)
      point_bounds.emplace_back(inside_[cell].bbox(), cell);
    CGAL::box_intersection_d(ring_bounds.begin(), ring_bounds.end(), point_bounds.begin(), point_bounds.end(),
                             [&](const Bounds& ring, const Bounds& point) {
                               const std::vector<Point>& points = rings[ring.info()];
                               if (CGAL::bounded_side_2(points.begin(), points.end(), inside_[point.info()],
                                                        Kernel()) == CGAL::ON_BOUNDED_SIDE)
                                 result_.cells[point.info()].rings.push_back(static_cast<int>(ring.info()));
                             });
    for (std::size_t i = 0; i < result_.cells.size(); ++i) {
      std::vector<int>& held_by = result_.cells[i].rings;
      std::sort(held_by.begin(), held_by.end());
      for (const int ring : held_by) tiled_[ring] += twice_area_[i];
    }
    std::erase_if(result_.cells,
                  [](const Overlay::Cell& cell) { return cell.rings.empty() || cell.triangles.empty(); });
  }

  void sum_areas() {
    for (std::size_t ring = 0; ring < rings_.size(); ++ring) {
      const Polygon& points = rings_[ring];
      Rational twice = 0;
      for (std::size_t i = 0; i < points.size(); ++i)
        twice += cross(rational(points[i]), rational(points[(i + 1) % points.size()]));
      if (twice < 0) twice = -twice;
      result_.ring_area_m2.push_back(CGAL::to_double(twice) / 2);
      result_.tiled.push_back(twice == tiled_[ring]);
    }
  }

  const std::vector<Polygon>& rings_;
  const std::vector<Cut>& cuts_;
  Triangulation triangulation_;
  std::vector<ExactPoint> exact_;     ///< by the triangulation's vertex
  std::vector<int> number_;           ///< likewise: the point that it is in the result
  std::vector<Point> inside_;         ///< by cell, as it is found: a point in it
  std::vector<Rational> twice_area_;  ///< likewise
  std::vector<Rational> tiled_;       ///< by ring: twice the area of its cells
  Overlay result_;
};

}  // namespace

Overlay overlay(const std::vector<Polygon>& rings, const std::vector<Cut>& cuts) {
  return Builder(rings, cuts).build();
}

bool tiles_exactly(const std::vector<Vec2>& points, const std::vector<Triangle>& triangles) {
  std::set<std::pair<int, int>> open;  // directed edges without a partner: the border
  Rational rest = 0;
  for (const Triangle& t : triangles) {
    const Rational area = twice_area(rational(points[t[0]]), rational(points[t[1]]), rational(points[t[2]]));
    if (area <= 0) return false;
    rest += area;
    for (int k = 0; k < 3; ++k) {
      const int a = t[k], b = t[(k + 1) % 3];
      if (open.erase({b, a}) == 0 && !open.insert({a, b}).second) return false;
    }
  }
  for (const auto& [a, b] : open) rest -= cross(rational(points[a]), rational(points[b]));
  return rest == 0;
}

}  // namespace gramap
