#include "floor/drawn_floor.h"

#include <algorithm>
#include <utility>

#include "geometry/error.h"
#include "geometry/polygon.h"
#include "grammar/derive.h"

namespace gramap {
namespace {

Polygon box(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

/// The rooms' doors as the other side shows them: on its own face of the wall between.
void add_other_sides(FittedFloor& floor) {
  const double wall_m = floor.inner_wall_m;
  std::vector<FittedRoom*> others;
  for (auto* rooms : {&floor.hallways, &floor.rooms})
    for (FittedRoom& room : *rooms) others.push_back(&room);
  std::vector<std::pair<FittedRoom*, FittedOpening>> added;
  for (const FittedRoom& room : floor.rooms)
    for (const FittedOpening& door : room.openings) {
      if (door.kind != "door") continue;
      const Vec2 along = (door.b - door.a).normalized();
      Vec2 through = wall_m * Vec2(along.y(), -along.x());
      const Vec2 middle = 0.5 * (door.a + door.b);
      if (contains(room.outline, middle + through)) through = -through;
      for (FittedRoom* other : others) {
        if (distance_to_border(other->outline, middle + through) > 0.02) continue;
        FittedOpening same = door;
        same.a += through, same.b += through;
        added.emplace_back(other, same);
        break;
      }
    }
  for (auto& [room, door] : added) room->openings.push_back(std::move(door));
}

}  // namespace

FloorGroundTruth plain_floor(const RuleSet& rules, const PlainFloorOptions& options) {
  const double length = options.length_m, depth = options.depth_m, hallway = options.hallway_m,
               inner = rules.inner_wall_m, outer = rules.outer_wall_m;
  FloorGroundTruth floor;
  floor.name = "floor";
  floor.ceiling_height_m = rules.height_m;
  floor.inner_wall_m = inner;
  floor.outer_wall_m = outer;
  floor.outline = box(-outer, -inner - depth - outer, length + outer, hallway + inner + depth + outer);
  floor.hallways = {{"hallway", "Hallway", box(0, 0, length, hallway)}};
  // Each space on the left of its line: the upper from left to right, the lower from right to left.
  floor.spaces = {
      {"north",
       "hallway",
       box(0, hallway + inner, length, hallway + inner + depth),
       {0, hallway + inner},
       {length, hallway + inner}},
      {"south", "hallway", box(0, -inner - depth, length, -inner), {length, -inner}, {0, -inner}}};
  return floor;
}

FittedFloor drawn_floor(const FloorGroundTruth& floor, const RuleSet& rules, std::uint64_t seed) {
  if (floor.spaces.empty())
    throw InputError({}, "the floor has no space for the rules to fill",
                     "give it features of kind 'space', or outline and hallways");
  const RuleSet here = rules_on_floor(rules, floor);
  std::vector<SetAsideInput> set_aside;
  const std::vector<SpaceProblem> problems = space_problems(floor, here, {}, {}, set_aside);
  std::vector<SpaceFit> layouts(problems.size());
  for (std::size_t i = 0; i < problems.size(); ++i) {
    // Each space draws from a stream of its own.
    Derivation drawn = std::move(SpaceDeriver(here, problems[i]).draw(1, seed + 0x9e37 * i).front());
    layouts[i].best.rooms = std::move(drawn.rooms);
  }
  FittedFloor fitted = floor_of_layouts(floor, rules, problems, layouts);
  add_other_sides(fitted);
  return fitted;
}

}  // namespace gramap
