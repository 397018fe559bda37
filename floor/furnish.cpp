#include "floor/furnish.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>

#include "floor/connect_rooms.h"
#include "floor/derived_furniture.h"
#include "floor/facade.h"
#include "floor/hallway_doors.h"
#include "floor/inner_doors.h"
#include "floor/place.h"
#include "floor/reachable.h"
#include "geometry/polygon.h"

namespace gramap {
namespace {

constexpr double kDoorHead_m = 2.1;    // of a door whose head nobody saw and no type says
constexpr double kAtBorder_m = 0.05;   // a side that is no farther is one of its space
constexpr double kAtHallway_m = 0.05;  // a room's side that is no farther lies on the reference line
constexpr double kMargin_m = 0.05;     // least wall between an opening and the room's corner

struct Edge {
  Vec2 a, b;
  Vec2 along() const { return (b - a).normalized(); }
  Vec2 outward() const { return Vec2(along().y(), -along().x()); }
  double length_m() const { return (b - a).norm(); }
};

Edge edge_of(const Polygon& outline, std::size_t i) {
  return {outline[i], outline[(i + 1) % outline.size()]};
}

/// The edge of a room's outline that runs along its space's reference line, and the one most away from it.
Edge hallway_edge(const FittedRoom& room, const Space& space) {
  const Vec2 along = (space.end - space.start).normalized(), left(-along.y(), along.x());
  Edge best = edge_of(room.outline, 0);
  double nearest = 1e300;
  for (std::size_t i = 0; i < room.outline.size(); ++i) {
    const Edge edge = edge_of(room.outline, i);
    const double distance = ((edge.a + edge.b) / 2 - space.start).dot(left);
    if (edge.along().dot(along) > 0.9 && distance < nearest) nearest = distance, best = edge;
  }
  return best;
}

bool is_at_hallway(const FittedRoom& room, const Space& space) {
  const Edge side = hallway_edge(room, space);
  return distance_to_segment((side.a + side.b) / 2, space.start, space.end) < kAtHallway_m;
}

/// How well a way round agrees with what doors and windows mean: doors on the hallway's side, windows on
/// walls to the outside.
double plausibility(const RoomObservation& seen, const PlanMotion& motion, const FittedRoom& room,
                    const Space* space, const Polygon& floor_outline) {
  double score = 0;
  for (const OpeningObservation& opening : seen.openings) {
    const WallObservation& wall = seen.walls[static_cast<std::size_t>(opening.wall)];
    const Vec2 along = (motion(wall.b) - motion(wall.a)).normalized();
    const Vec2 middle = motion(wall.a) + along * (opening.start_m + opening.width_m / 2);
    if (opening.kind == "door" && space) {
      const Edge side = hallway_edge(room, *space);
      score += distance_to_segment(middle, side.a, side.b) < 0.4 ? 1 : 0;
    } else if (opening.kind == "window" && !floor_outline.empty()) {
      score += distance_to_border(floor_outline, middle) < 0.8 ? 1 : 0;
    }
  }
  return score;
}

/// Lays an observation onto its room. In the building's frame the outlines say how, in a frame of its own
/// several ways may fit.
PlanMotion lay(const RoomObservation& seen, const FittedRoom& room, const Space* space,
               const Polygon& floor_outline) {
  const bool own_frame = !lies_on(seen.outline, room.outline);
  PlanMotion best;
  double highest = -1;
  for (const PlanMotion& motion : hallway_motions(seen, room.outline, own_frame)) {
    const double score = plausibility(seen, motion, room, space, floor_outline);
    if (score > highest) highest = score, best = motion;
  }
  return best;
}

/// Puts a stretch of a moved wall onto the room's own edge that runs the same way nearest to it.
FittedOpening onto_outline(const Polygon& outline, const Vec2& from, const Vec2& to) {
  FittedOpening opening;
  double nearest = 1e300;
  const Vec2 along = (to - from).normalized(), middle = (from + to) / 2;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Edge edge = edge_of(outline, i);
    const double distance = distance_to_segment(middle, edge.a, edge.b);
    if (edge.along().dot(along) < 0.8 || distance >= nearest) continue;
    nearest = distance;
    const double length = edge.length_m(), width = std::min((to - from).norm(), length - 2 * kMargin_m);
    const double start =
        std::clamp((middle - edge.a).dot(edge.along()) - width / 2, kMargin_m, length - kMargin_m - width);
    opening.a = edge.a + edge.along() * start;
    opening.b = opening.a + edge.along() * width;
  }
  return opening;
}

void add_seen(FittedRoom& room, const RoomObservation& seen, const PlanMotion& motion) {
  for (const OpeningObservation& opening : seen.openings) {
    const WallObservation& wall = seen.walls[static_cast<std::size_t>(opening.wall)];
    const Vec2 a = motion(wall.a), along = (motion(wall.b) - a).normalized();
    FittedOpening fitted = onto_outline(room.outline, a + along * opening.start_m,
                                        a + along * (opening.start_m + opening.width_m));
    if (fitted.a == fitted.b) continue;
    fitted.kind = opening.kind;
    fitted.origin = Origin::observed;
    fitted.sill_m = opening.kind == "door" ? 0 : opening.sill_m;
    fitted.head_m = opening.head_m > opening.sill_m ? opening.head_m : kDoorHead_m;
    fitted.confidence = opening.confidence;
    room.openings.push_back(fitted);
  }
  for (const FurnitureObservation& piece : seen.furniture) {
    FittedFurniture fitted{piece.type, Origin::observed, {}, piece.bottom_m, piece.top_m, piece.confidence};
    for (const Vec2& point : piece.footprint) fitted.outline.push_back(motion(point));
    room.furniture.push_back(fitted);
  }
}

/// A door of the given width on the hallway's side, its nearer edge at `start_m` along the room.
FittedOpening door_at(const Edge& side, double start_m, double width_m, double head_m, Origin origin) {
  const double length = side.length_m(), width = std::min(width_m, length - 2 * kMargin_m);
  const double start = std::clamp(start_m, kMargin_m, length - kMargin_m - width);
  FittedOpening door{
      "door", origin, side.a + side.along() * start, side.a + side.along() * (start + width), 0, head_m, 1};
  return door;
}

/// The doors that the hallway showed in this room's stretch of the wall.
void add_hallway_doors(FittedRoom& room, const Space& space, const SpaceProblem& problem,
                       const RoomType* type) {
  const Edge side = hallway_edge(room, space);
  const double head = type && type->door ? type->door->height_m : kDoorHead_m;
  for (const DoorEvidence& door : problem.doors) {
    const double start = door.centre_m - room.start_m - door.width_m / 2;
    if (door.centre_m <= room.start_m || door.centre_m >= room.start_m + room.width_m) continue;
    room.openings.push_back(door_at(side, start, door.width_m, head, Origin::observed));
  }
}

void derive_door(FittedRoom& room, const Space& space, const DoorHabit& habit) {
  const Edge side = hallway_edge(room, space);
  double start = (side.length_m() - habit.width_m) / 2;
  const auto usual = std::max_element(
      habit.places.begin(), habit.places.end(),
      [](const DoorHabit::Place& a, const DoorHabit::Place& b) { return a.weight < b.weight; });
  if (usual != habit.places.end())
    start = usual->from_end ? side.length_m() - usual->offset.mean_m - habit.width_m : usual->offset.mean_m;
  room.openings.push_back(door_at(side, start, habit.width_m, habit.height_m, Origin::derived));
}

/// A row of windows in the middle of every wall to the outside that faces away from the hallway.
void derive_windows(FittedRoom& room, const Space& space, const RoomType& type, const FittedFloor& floor) {
  const Vec2 along = (space.end - space.start).normalized();
  for (std::size_t i = 0; i < room.outline.size(); ++i) {
    const Edge edge = edge_of(room.outline, i);
    if (edge.along().dot(along) > -0.9) continue;
    const bool is_inner = distance_to_border(space.outline, (edge.a + edge.b) / 2) > kAtBorder_m;
    if (is_inner || !faces_outside(floor.floor, 1.5 * floor.outer_wall_m + 0.05, edge.a, edge.b)) continue;
    for (const WindowHabit& habit : type.windows) {
      const double room_for = edge.length_m() - 2 * kMargin_m - habit.width_m;
      if (room_for < 0) continue;
      const int count =
          1 + (habit.spacing_m > habit.width_m ? static_cast<int>(room_for / habit.spacing_m) : 0);
      const double first = (edge.length_m() - (count - 1) * habit.spacing_m - habit.width_m) / 2;
      for (int n = 0; n < count; ++n) {
        const Vec2 a = edge.a + edge.along() * (first + n * habit.spacing_m);
        room.openings.push_back({"window", Origin::derived, a, a + edge.along() * habit.width_m, habit.sill_m,
                                 std::min(habit.sill_m + habit.height_m, room.height_m - 0.1), 1});
      }
    }
  }
}

}  // namespace

void furnish(FittedFloor& fitted, const RuleSet& rules, const std::vector<SpaceProblem>& problems,
             const std::vector<RoomObservation>& observations) {
  std::map<std::string_view, const RoomObservation*> by_name;  // the first of each name
  for (const RoomObservation& observation : observations) by_name.emplace(observation.room, &observation);
  const auto observation_of = [&](const FittedRoom& room) -> const RoomObservation* {
    if (room.scans.empty()) return nullptr;
    const auto found = by_name.find(room.scans.front());
    return found == by_name.end() ? nullptr : found->second;
  };
  std::map<std::string_view, std::vector<FittedRoom*>> by_space;
  for (FittedRoom& room : fitted.rooms) by_space[room.space].push_back(&room);
  for (std::size_t s = 0; s < fitted.floor.spaces.size(); ++s) {
    const Space& space = fitted.floor.spaces[s];
    for (FittedRoom* const in_space : by_space[space.id]) {
      FittedRoom& room = *in_space;
      const auto found = std::find_if(rules.rooms.begin(), rules.rooms.end(),
                                      [&](const RoomType& t) { return t.name == room.type; });
      const RoomType* const type = found == rules.rooms.end() ? nullptr : &*found;
      if (const RoomObservation* seen = observation_of(room)) {
        add_seen(room, *seen, lay(*seen, room, &space, fitted.floor.outline));
      } else if (type) {
        derive_windows(room, space, *type, fitted);
        room.furniture = derived_furniture(room, hallway_edge(room, space).along(), type->furniture);
      }
      if (!has_door(room) && is_at_hallway(room, space)) add_hallway_doors(room, space, problems[s], type);
      if (!has_door(room) && type && type->door && is_at_hallway(room, space))
        derive_door(room, space, *type->door);
    }
  }
  add_inner_doors(fitted, rules);
  for (auto* given : {&fitted.hallways, &fitted.fixed})
    for (FittedRoom& room : *given)
      if (const RoomObservation* seen = observation_of(room))
        add_seen(room, *seen, lay(*seen, room, nullptr, fitted.floor.outline));
  connect_rooms(fitted);
}

}  // namespace gramap
