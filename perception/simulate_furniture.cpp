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
  } else {
    add_prism(faces, piece.outline, bottom, top);
  }
}

}  // namespace gramap
