// The exact planar partition of a floor: clear areas of rooms, and the walls between them cut into single
// walls and junctions. Coordinates are doubles on the way in and out; in between they are exact rationals
// (CGAL), so that the areas of the parts add up to the outline's without any remainder.
//
// Method. All rings and cuts go as constraints into one constrained Delaunay triangulation with exact
// constructions. Cells are the connected sets of triangles that no constraint separates. The wall region
// (inside the outline, in no room) is cut at every corner of a ring where a wall starts or ends:
// perpendicular to the wall's faces, across to the face that lies opposite. A cell that then lies between two
// rooms (or a room and the outside) is a wall between these; the others are junctions.
#pragma once

#include <optional>
#include <vector>

#include "geometry/mesh.h"
#include "geometry/types.h"

namespace gramap {

/// An opening that is cut through the wall behind a stretch of a room's outline.
struct PlanOpening {
  int room = 0;  ///< into PlanInput::rooms
  Vec2 a = Vec2::Zero();
  Vec2 b = Vec2::Zero();
};

struct PlanInput {
  /// Outer faces of the outer walls, counter-clockwise, and courtyards, clockwise.
  std::vector<Polygon> outline;
  std::vector<Polygon> rooms;  ///< clear areas, counter-clockwise
  std::vector<PlanOpening> openings;
  /// Points nearer than this to another ring's corner or edge are put onto it (the outline stays).
  double weld_m = 1e-4;
  /// Rooms that overlap by no more than this abut: plans are rounded so. The later of the two gives way.
  double rounding_m = 1e-3;
  /// Faces farther apart than this have no wall between them, but solid mass.
  double thickest_wall_m = 1.2;
};

constexpr int kOutside = -1;  ///< stands for the outside where a room index is expected

struct PlanCell {
  enum class Kind { room, wall, junction, mass };
  Kind kind = Kind::wall;
  int room = -1;          ///< Kind::room: into PlanInput::rooms
  int side_a = kOutside;  ///< Kind::wall: the rooms on both sides, smaller index (kOutside last) first
  int side_b = kOutside;
  std::vector<int> touching;  ///< rooms (or kOutside) that share a stretch of border with the cell, sorted
  int opening = -1;           ///< into PlanInput::openings, where the cell is an opening's footprint
  std::vector<Triangle> triangles;  ///< over Partition::points, counter-clockwise
  double area_m2 = 0;
};

/// A place where the input contradicts itself.
struct PlanFault {
  enum class Kind { overlap, outside_outline, zero_wall, lost_opening, crossing_outlines };
  Kind kind = Kind::overlap;
  int a = -1;  ///< the room, or the opening; none for crossing outlines
  int b = -1;  ///< the other room
  Vec2 at = Vec2::Zero();
  double area_m2 = 0;
};

struct Partition {
  std::vector<Vec2> points;
  std::vector<PlanCell> cells;
  /// A straight stretch of a wall's face, with the wall on its left.
  struct Face {
    int side = kOutside;  ///< the room on whose border it is
    Vec2 a = Vec2::Zero();
    Vec2 b = Vec2::Zero();
  };
  /// Walls and junctions: the cells (walls with their openings' footprints) of each, ordered by place.
  struct Wall {
    PlanCell::Kind kind = PlanCell::Kind::wall;
    int side_a = kOutside;
    int side_b = kOutside;
    std::vector<int> cells;
    std::vector<Face> faces;
    double thickness_m = 0;  ///< area over mean face length; 0 for junctions and mass
    double length_m = 0;
  };
  std::vector<Wall> walls;
  /// By opening: a and b on the room's face, then the points opposite b and a; empty where none could be cut.
  std::vector<Polygon> footprints;
  double outline_area_m2 = 0;
  double rooms_area_m2 = 0;
  double walls_area_m2 = 0;
  /// Rooms and walls make up the outline without any remainder, in exact arithmetic.
  bool exact = false;
  std::vector<PlanFault> faults;
};

Partition partition(const PlanInput& input);

/// The rings around all rooms at distance `wall_m` (mitred), as outer rings (counter-clockwise) and holes
/// (clockwise): an outline for floors that have none.
std::vector<Polygon> outline_around(const std::vector<Polygon>& rooms, double wall_m);

/// The border of a set of triangles as rings: outer counter-clockwise, holes clockwise.
std::vector<Polygon> border(const std::vector<Vec2>& points, const std::vector<Triangle>& triangles);

/// True when the areas of the cells' triangles add up to the area that their common border encloses, and to
/// the area that `outline` encloses, in exact arithmetic, and every triangle is positive.
bool areas_exact(const Partition& partition);

/// The first corner of the triangles' border that does not lie on one of the `outline` rings, within the
/// tolerance: a gap or an overlap in what should fill the outline. None, when triangles that are all
/// counter-clockwise and whose area is the outline's fill it exactly once.
std::optional<Vec2> stray_border(const std::vector<Vec2>& points, const std::vector<Triangle>& triangles,
                                 const std::vector<Polygon>& outline, double tolerance_m);

}  // namespace gramap
