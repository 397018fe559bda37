// Rings and cuts laid over one another in exact arithmetic: a constrained Delaunay triangulation (CGAL) whose
// cells are what no line separates. Doubles in, doubles out; every predicate and every sum of areas in
// between is exact.
#pragma once

#include <vector>

#include "geometry/mesh.h"
#include "geometry/types.h"

namespace gramap {

/// A point on an edge of a ring: the edge from corner `edge` to the next one. Made exact as `at` itself where
/// that lies exactly on the edge, else as corner + t · (next - corner).
struct PointOnRing {
  int ring = 0;
  int edge = 0;
  double t = 0;  ///< 0 at the edge's first corner; 1 at the next
  Vec2 at = Vec2::Zero();
};

struct Cut {
  PointOnRing from;
  PointOnRing to;
};

struct Overlay {
  std::vector<Vec2> points;
  struct Cell {
    std::vector<int> rings;           ///< that contain the cell, ascending
    std::vector<Triangle> triangles;  ///< counter-clockwise
    Vec2 inside = Vec2::Zero();       ///< a point well inside
    double area_m2 = 0;
  };
  std::vector<Cell> cells;  ///< in no particular ring: those outside all rings are left out
  /// By ring: its area equals, without any remainder, the sum of the areas of its cells.
  std::vector<bool> tiled;
  std::vector<double> ring_area_m2;
};

Overlay overlay(const std::vector<Polygon>& rings, const std::vector<Cut>& cuts);

/// True when the areas of the triangles add up to the area within their common border in exact arithmetic and
/// every triangle is counter-clockwise: they tile it, without gap or overlap.
bool tiles_exactly(const std::vector<Vec2>& points, const std::vector<Triangle>& triangles);

}  // namespace gramap
