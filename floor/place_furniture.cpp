#include "floor/place_furniture.h"

#include <algorithm>
#include <cmath>

#include "geometry/polygon.h"
#include "geometry/say.h"

namespace gramap {
namespace {

constexpr double kClear_m = 0.004;  ///< kept between furniture and walls: no faces in one plane
constexpr double kMost_m = 0.35;    ///< farther than this nothing is moved
constexpr double kLeast_m = 0.05;   ///< what is smaller is no furniture

std::vector<Vec2> corners(const OrientedBox& box) {
  const Vec2 u = box.axis * box.length_m, v = Vec2(-box.axis.y(), box.axis.x()) * box.breadth_m;
  return {box.corner, box.corner + u, box.corner + u + v, box.corner + v};
}

/// The move that takes the box's worst corner (or the worst of the room's corners that poke into the box) off
/// the wall.
Vec2 way_off_the_walls(const OrientedBox& box, const Polygon& room) {
  double worst = 0;
  Vec2 way = Vec2::Zero();
  for (const Vec2& corner : corners(box)) {
    const bool inside = contains(room, corner);
    double nearest = 1e300;
    Vec2 foot = corner;
    for (std::size_t i = 0; i < room.size(); ++i) {
      const Vec2& a = room[i];
      const Vec2 along = room[(i + 1) % room.size()] - a;
      const double t = std::clamp((corner - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
      const Vec2 at = a + along * t;
      if ((corner - at).norm() >= nearest) continue;
      nearest = (corner - at).norm();
      const Vec2 in = Vec2(-along.y(), along.x()).normalized();  // the room lies on the left
      foot = at + in * kClear_m;
    }
    if (inside && nearest >= kClear_m * 0.9) continue;
    if ((foot - corner).norm() > worst) worst = (foot - corner).norm(), way = foot - corner;
  }
  return way;
}

/// The side along which the chair's back stands: away from the nearest table, else away from the room's
/// middle.
Vec2 chair_front(const OrientedBox& chair, const FittedRoom& room) {
  const Vec2 u = chair.axis, v(-u.y(), u.x());
  const Vec2 middle = chair.corner + u * chair.length_m / 2 + v * chair.breadth_m / 2;
  Vec2 toward = centroid(room.outline);
  double nearest = 1.5;
  for (const FittedFurniture& piece : room.furniture) {
    if (piece.type.find("table") == std::string::npos && piece.type.find("desk") == std::string::npos)
      continue;
    if (const double distance = distance_to_border(piece.outline, middle); distance < nearest)
      nearest = distance, toward = centroid(piece.outline);
  }
  const Vec2 wish = toward - middle;
  Vec2 best = u;
  for (const Vec2& side : {u, v, Vec2(-u), Vec2(-v)})
    if (side.dot(wish) > best.dot(wish)) best = side;
  return best;
}

}  // namespace

std::vector<ModelFurniture> place_furniture(const ModelRoom& room, std::vector<SetAsideInput>& set_aside) {
  std::vector<ModelFurniture> placed;
  for (const FittedFurniture& piece : room.fitted.furniture) {
    ModelFurniture added;
    added.room = room.fitted.id;
    added.fitted = piece;
    const auto refuse = [&](const char* reason) {
      if (piece.origin == Origin::derived) return;  // nobody has seen it
      const Vec2 middle = piece.outline.empty() ? Vec2(0, 0) : centroid(piece.outline);
      set_aside.push_back({"the " + piece.type + " of " + room.node + " at " + said_point(middle), reason});
    };
    if (piece.outline.size() < 3) {
      refuse("it has no outline");
      continue;
    }
    added.box = oriented_box(piece.outline);
    added.fitted.bottom_m = piece.bottom_m < 0.08 ? 0 : piece.bottom_m;
    added.fitted.top_m = std::min(piece.top_m, room.height_m - 0.01);
    if (std::min({added.box.length_m, added.box.breadth_m, added.fitted.top_m - added.fitted.bottom_m}) <
        kLeast_m) {
      refuse("it is too small to be furniture");
      continue;
    }
    const Vec2 start = added.box.corner;
    Vec2 way = way_off_the_walls(added.box, room.fitted.outline);
    for (int i = 0; i < 8 && way != Vec2::Zero(); ++i) {
      added.box.corner += way;
      way = way_off_the_walls(added.box, room.fitted.outline);
    }
    if (way.norm() > 2 * kClear_m || (added.box.corner - start).norm() > kMost_m) {
      refuse("it does not fit between the room's walls");
      continue;
    }
    if (piece.type.find("chair") != std::string::npos) {
      // Turned so that the frame's -y is the front.
      const Vec2 front = chair_front(added.box, room.fitted), u(-front.y(), front.x());
      OrientedBox& box = added.box;
      const Vec2 v(-box.axis.y(), box.axis.x());
      const Vec2 middle = box.corner + box.axis * box.length_m / 2 + v * box.breadth_m / 2;
      if (std::abs(u.dot(box.axis)) < 0.5) std::swap(box.length_m, box.breadth_m);
      box.axis = u;
      box.corner = middle - u * box.length_m / 2 + front * box.breadth_m / 2;
    }
    added.fitted.outline = corners(added.box);
    placed.push_back(std::move(added));
  }
  return placed;
}

}  // namespace gramap
