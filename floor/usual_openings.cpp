#include "floor/usual_openings.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace gramap {
namespace {

bool has(const FittedRoom& room, const std::string& kind) {
  return std::any_of(room.openings.begin(), room.openings.end(),
                     [&kind](const FittedOpening& o) { return o.kind == kind; });
}

void add_door(FittedRoom& room, const DoorHabit& habit, const Space& space) {
  const Vec2 along = (space.end - space.start).normalized();
  const double width = std::min(habit.width_m, room.width_m - 0.1);
  const auto place = std::max_element(habit.places.begin(), habit.places.end(),
                                      [](const auto& a, const auto& b) { return a.weight < b.weight; });
  double offset = (room.width_m - width) / 2;
  if (place != habit.places.end())
    offset = place->from_end ? room.width_m - place->offset.mean_m - width : place->offset.mean_m;
  offset = std::clamp(offset, 0.05, std::max(0.05, room.width_m - width - 0.05));
  const Vec2 a = space.start + along * (room.start_m + offset);
  room.openings.push_back(
      {"door", Origin::derived, a, a + along * width, 0, habit.height_m, room.type_probability});
}

/// The distance across the space from its reference line to the room's far side, at a place along the line.
double far_side_m(const FittedRoom& room, const Space& space, double at_m) {
  const Vec2 along = (space.end - space.start).normalized(), left(-along.y(), along.x());
  double far = 0;
  for (std::size_t i = 0; i < room.outline.size(); ++i) {
    const Vec2 p = room.outline[i] - space.start,
               q = room.outline[(i + 1) % room.outline.size()] - space.start;
    const double s = p.dot(along), t = q.dot(along);
    if (std::abs(t - s) < 1e-9 || (at_m - s) * (at_m - t) > 0) continue;
    far = std::max(far, p.dot(left) + (q - p).dot(left) * (at_m - s) / (t - s));
  }
  return far;
}

void add_windows(FittedRoom& room, const WindowHabit& habit, const Space& space) {
  const Vec2 along = (space.end - space.start).normalized(), left(-along.y(), along.x());
  const double spacing = std::max(habit.spacing_m, habit.width_m + 0.1),
               free = room.width_m - 0.1 - habit.width_m;
  if (free < 0) return;
  const int count = 1 + static_cast<int>(std::floor(free / spacing + 1e-6));
  for (int i = 0; i < count; ++i) {
    const double centre = room.start_m + room.width_m / 2 + (i - (count - 1) / 2.0) * spacing;
    const auto at = [&](double s) -> Vec2 {
      return space.start + along * s + left * far_side_m(room, space, s);
    };
    room.openings.push_back({"window", Origin::derived, at(centre - habit.width_m / 2),
                             at(centre + habit.width_m / 2), habit.sill_m, habit.sill_m + habit.height_m,
                             room.type_probability});
  }
}

}  // namespace

void add_usual_openings(FittedFloor& floor, const RuleSet& rules) {
  for (FittedRoom& room : floor.rooms) {
    const auto type = std::find_if(rules.rooms.begin(), rules.rooms.end(),
                                   [&](const RoomType& t) { return t.name == room.type; });
    const auto space = std::find_if(floor.floor.spaces.begin(), floor.floor.spaces.end(),
                                    [&](const Space& s) { return s.id == room.space; });
    if (type == rules.rooms.end() || space == floor.floor.spaces.end()) continue;
    if (type->door && !has(room, "door")) add_door(room, *type->door, *space);
    if (!has(room, "window"))
      for (const WindowHabit& habit : type->windows) add_windows(room, habit, *space);
  }
}

}  // namespace gramap
