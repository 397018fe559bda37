#include "perception/simulate_furniture.h"

#include <algorithm>

#include "geometry/polygon.h"

namespace gramap {
namespace {

constexpr double kTopThickness_m = 0.03;
constexpr double kLeg_m = 0.05;
constexpr double kStool_m = 0.6;  // a chair taller than this has a back
constexpr double kSeat_m = 0.46;

Polygon rectangle(const Vec2& corner, const Vec2& along, double length, const Vec2& across, double breadth) {
  return {corner, corner + length * along, corner + length * along + breadth * across,
          corner + breadth * across};
}

/// A plate on four legs near the corners of the box around `outline`.
void add_plate_on_legs(std::vector<Face>& faces, const Polygon& outline, double floor_m, double top_m) {
  add_prism(faces, outline, top_m - kTopThickness_m, top_m);
  const OrientedBox box = oriented_box(outline);
  const Vec2 across(-box.axis.y(), box.axis.x());
  const Vec2 middle = box.corner + 0.5 * box.length_m * box.axis + 0.5 * box.breadth_m * across;
  for (const double s : {-0.35, 0.35})
    for (const double t : {-0.35, 0.35}) {
      const Vec2 foot = middle + s * box.length_m * box.axis + t * box.breadth_m * across;
      const Vec2 corner = foot - 0.5 * kLeg_m * (box.axis + across);
      add_prism(faces, rectangle(corner, box.axis, kLeg_m, across, kLeg_m), floor_m, top_m - kTopThickness_m);
    }
}

/// The frame of a piece with a back: corner at the back's left end, along the back, and to the front.
struct Backed {
  Vec2 corner, along, front;
  double length_m, depth_m;
  explicit Backed(const Polygon& outline)
      : corner(outline[0]),
        along((outline[1] - outline[0]).normalized()),
        front(-along.y(), along.x()),
        length_m((outline[1] - outline[0]).norm()),
        depth_m((outline[2] - outline[1]).norm()) {}
  Polygon part(double s0, double s1, double t0, double t1) const {
    return rectangle(corner + s0 * along + t0 * front, along, s1 - s0, front, t1 - t0);
  }
};

void add_sofa(std::vector<Face>& faces, const Polygon& outline, double floor_m, double top_m) {
  const Backed sofa(outline);
  const double arm_m = 0.12 * sofa.length_m, back_m = 0.25 * sofa.depth_m;
  const double seat = floor_m + std::min(0.42, 0.6 * (top_m - floor_m)), arms = 0.5 * (seat + top_m);
  add_prism(faces, sofa.part(0, sofa.length_m, 0, back_m), floor_m, top_m);
  add_prism(faces, sofa.part(0, arm_m, back_m, sofa.depth_m), floor_m, arms);
  add_prism(faces, sofa.part(sofa.length_m - arm_m, sofa.length_m, back_m, sofa.depth_m), floor_m, arms);
  add_prism(faces, sofa.part(arm_m, sofa.length_m - arm_m, back_m, sofa.depth_m), floor_m, seat);
}

void add_shelf(std::vector<Face>& faces, const Polygon& outline, double bottom_m, double top_m) {
  constexpr double kBoard_m = 0.02, kApart_m = 0.36;
  const Backed shelf(outline);
  add_prism(faces, shelf.part(0, shelf.length_m, 0, kBoard_m), bottom_m, top_m);
  add_prism(faces, shelf.part(0, kBoard_m, 0, shelf.depth_m), bottom_m, top_m);
  add_prism(faces, shelf.part(shelf.length_m - kBoard_m, shelf.length_m, 0, shelf.depth_m), bottom_m, top_m);
  const int boards = std::max(1, static_cast<int>((top_m - bottom_m) / kApart_m));
  for (int i = 0; i <= boards; ++i) {
    const double z = bottom_m + 0.05 + i * (top_m - bottom_m - 0.05) / boards;
    add_prism(faces, shelf.part(0, shelf.length_m, 0, shelf.depth_m), z - kBoard_m, z);
  }
}

void add_stairs(std::vector<Face>& faces, const Polygon& outline, double floor_m, double top_m) {
  const OrientedBox box = oriented_box(outline);
  const Vec2 across(-box.axis.y(), box.axis.x());
  const int steps = std::max(1, static_cast<int>((top_m - floor_m) / 0.17));
  const double landing_m = std::min(box.breadth_m, 0.4 * box.length_m);
  const double tread_m = (box.length_m - landing_m) / steps, rise_m = (top_m - floor_m) / steps;
  for (int i = 0; i < steps; ++i) {
    const double from = i * tread_m, to = i + 1 == steps ? box.length_m : from + tread_m;
    add_prism(faces, rectangle(box.corner + from * box.axis, box.axis, to - from, across, box.breadth_m),
              floor_m, floor_m + (i + 1) * rise_m);
  }
}

}  // namespace

void add_furniture(std::vector<Face>& faces, const BuildingFurniture& piece, double floor_m) {
  const double bottom = floor_m + piece.bottom_m, top = floor_m + piece.top_m;
  if (piece.closed && (piece.type == "table" || piece.top_m <= kStool_m)) {
    add_prism(faces, piece.outline, bottom, top);
  } else if (piece.type == "table") {
    add_plate_on_legs(faces, piece.outline, bottom, top);
  } else if (piece.type == "chair" && piece.top_m <= kStool_m) {
    add_plate_on_legs(faces, piece.outline, bottom, top);
  } else if (piece.type == "chair") {
    const double seat = floor_m + std::min(kSeat_m, 0.6 * piece.top_m);
    add_plate_on_legs(faces, piece.outline, bottom, seat);
    const OrientedBox box = oriented_box(piece.outline);
    const Vec2 across(-box.axis.y(), box.axis.x());
    add_prism(faces, rectangle(box.corner, box.axis, box.length_m, across, kTopThickness_m), seat, top);
  } else if (piece.type == kSofa && piece.outline.size() == 4) {
    add_sofa(faces, piece.outline, bottom, top);
  } else if (piece.type == kShelf && piece.outline.size() == 4) {
    add_shelf(faces, piece.outline, bottom, top);
  } else if (piece.type == kStairs) {
    add_stairs(faces, piece.outline, bottom, top);
  } else {
    add_prism(faces, piece.outline, bottom, top);
  }
}

}  // namespace gramap
