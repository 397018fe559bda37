#include "floor/inner_doors.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "floor/reachable.h"

namespace gramap {
namespace {

constexpr double kWidth_m = 0.8;  // of a door that the room's type says nothing of
constexpr double kHead_m = 2.1;
constexpr double kLeast_m = 0.55;  // nobody passes a narrower door
constexpr double kMargin_m = 0.05;
constexpr double kTouch_m = 0.02;

/// A stretch of a room's wall face.
struct Stretch {
  Vec2 a, b;
  double length_m() const { return (b - a).norm(); }
};

/// The longest stretch of `room`'s outline behind which, one wall farther, lies a face of `other`.
std::optional<Stretch> shared_wall(const FittedRoom& room, const FittedRoom& other, double wall_m) {
  std::optional<Stretch> longest;
  for (std::size_t i = 0; i < room.outline.size(); ++i) {
    const Vec2& a = room.outline[i];
    const Vec2 edge = room.outline[(i + 1) % room.outline.size()] - a;
    const Vec2 along = edge.normalized(), outward(along.y(), -along.x());
    for (std::size_t j = 0; j < other.outline.size(); ++j) {
      const Vec2 c = other.outline[j] - a, d = other.outline[(j + 1) % other.outline.size()] - a;
      const bool faces = std::abs(c.dot(outward) - wall_m) < kTouch_m &&
                         std::abs(d.dot(outward) - wall_m) < kTouch_m && d.dot(along) < c.dot(along);
      if (!faces) continue;
      const double from_m = std::max(0.0, d.dot(along)), to_m = std::min(edge.norm(), c.dot(along));
      if (to_m - from_m > (longest ? longest->length_m() : 0.0))
        longest = Stretch{a + from_m * along, a + to_m * along};
    }
  }
  return longest;
}

FittedOpening door_in(const Stretch& wall, double width_m, double head_m) {
  const Vec2 middle = (wall.a + wall.b) / 2;
  const Vec2 half = (wall.b - wall.a).normalized() * (std::min(width_m, wall.length_m() - 2 * kMargin_m) / 2);
  return {"door", Origin::derived, middle - half, middle + half, 0, head_m, 1};
}

/// Rooms of one space whose stretches along the reference line overlap, joined as far as that goes on.
std::vector<std::vector<FittedRoom*>> units(FittedFloor& fitted, const std::string& space) {
  std::vector<FittedRoom*> rooms;
  for (FittedRoom& room : fitted.rooms)
    if (room.space == space) rooms.push_back(&room);
  std::stable_sort(rooms.begin(), rooms.end(),
                   [](const FittedRoom* a, const FittedRoom* b) { return a->start_m < b->start_m; });
  std::vector<std::vector<FittedRoom*>> made;
  double end_m = 0;
  for (FittedRoom* room : rooms) {
    if (made.empty() || room->start_m > end_m - kTouch_m) made.emplace_back();
    end_m =
        made.back().empty() ? room->start_m + room->width_m : std::max(end_m, room->start_m + room->width_m);
    made.back().push_back(room);
  }
  return made;
}

}  // namespace

void add_inner_doors(FittedFloor& fitted, const RuleSet& rules) {
  for (const Space& space : fitted.floor.spaces) {
    for (const std::vector<FittedRoom*>& unit : units(fitted, space.id)) {
      std::vector<FittedRoom*> reached, waiting;
      for (FittedRoom* room : unit) (has_door(*room) ? reached : waiting).push_back(room);
      for (std::size_t from = 0; from < reached.size(); ++from) {
        for (FittedRoom*& room : waiting) {
          if (room == nullptr) continue;
          const std::optional<Stretch> wall = shared_wall(*room, *reached[from], fitted.inner_wall_m);
          if (!wall || wall->length_m() < kLeast_m + 2 * kMargin_m) continue;
          const auto type = std::find_if(rules.rooms.begin(), rules.rooms.end(),
                                         [&](const RoomType& t) { return t.name == room->type; });
          const bool says = type != rules.rooms.end() && type->door;
          room->openings.push_back(
              door_in(*wall, says ? type->door->width_m : kWidth_m, says ? type->door->height_m : kHead_m));
          reached.push_back(room);
          room = nullptr;
        }
      }
    }
  }
}

}  // namespace gramap
