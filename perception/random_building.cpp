#include "perception/random_building.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace gramap {
namespace {

/// What a building's architect had a habit of.
struct Habits {
  double inner_m, outer_m, height_m, hallway_m, depth_m;
  double door_m, door_head_m, door_offset_m;
  double window_m, window_sill_m, window_head_m, window_gap_m;
  double furnished;

  explicit Habits(Random& random)
      : inner_m(random.uniform(0.08, 0.30)),
        outer_m(random.uniform(0.25, 0.50)),
        height_m(random.uniform(2.4, 3.4)),
        hallway_m(random.uniform(1.4, 3.0)),
        depth_m(random.uniform(3.0, 6.0)),
        door_m(random.uniform(0.75, 1.15)),
        door_head_m(random.uniform(1.95, 2.25)),
        door_offset_m(random.uniform(0.05, 0.5)),
        window_m(random.uniform(0.6, 1.8)),
        window_sill_m(random.chance(0.15) ? 0.05 : random.uniform(0.4, 1.2)),
        window_head_m(height_m - random.uniform(0.1, 0.5)),
        window_gap_m(random.uniform(0.15, 1.0)),
        furnished(random.uniform(0.1, 1.0)) {
    // Windows down to the floor are wider than doors, or nobody could tell the two apart by their shape.
    if (window_sill_m < 0.1) window_m = std::max(window_m, door_m + 0.4);
    window_head_m = std::max(window_head_m, window_sill_m + 0.6);
    window_head_m = std::min(window_head_m, height_m - 0.05);
  }
};

Polygon box(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

/// A row of windows in the wall from x0 to x1 at y, as many as fit or fewer.
void add_windows(BuildingRoom& room, const Habits& habits, double x0, double x1, double y, Random& random) {
  const double pitch = habits.window_m + habits.window_gap_m;
  const int fit = static_cast<int>((x1 - x0 - 0.2 + habits.window_gap_m) / pitch);
  const int count = random.chance(0.8) ? fit : random.below(fit + 1);
  const double used = count * pitch - habits.window_gap_m;
  const double start =
      random.chance(0.5) ? x0 + 0.5 * (x1 - x0 - used) : random.uniform(x0 + 0.1, x1 - used - 0.1);
  for (int i = 0; i < count; ++i) {
    const double left = start + i * pitch;
    room.openings.push_back(
        {"window", {left, y}, {left + habits.window_m, y}, habits.window_sill_m, habits.window_head_m});
  }
}

/// A door seen from both of the rooms that it joins.
void add_door(BuildingRoom& a, const Vec2& a0, const Vec2& a1, BuildingRoom& b, const Vec2& through,
              double head) {
  a.openings.push_back({"door", a0, a1, 0, head});
  b.openings.push_back({"door", a0 + through, a1 + through, 0, head});
}

/// Rooms along one side of the hallway (room 0): `face` is the hallway's wall, `away` ±1 the side.
void add_side(Building& building, const Habits& habits, int rooms, double face, double away, double length,
              Random& random) {
  std::vector<double> weights;
  double sum = 0;
  for (int i = 0; i < rooms; ++i) weights.push_back(random.uniform(1, 2.2)), sum += weights.back();
  const double clear = length - (rooms - 1) * habits.inner_m;
  double x = 0;
  const double near_y = face + away * habits.inner_m, far_y = near_y + away * habits.depth_m;
  for (int i = 0; i < rooms; ++i) {
    const double width = clear * weights[static_cast<std::size_t>(i)] / sum;
    BuildingRoom room{(away > 0 ? "n" : "s") + std::to_string(i),
                      box(x, std::min(near_y, far_y), x + width, std::max(near_y, far_y)),
                      0,
                      habits.height_m,
                      {},
                      {}};
    const double door =
        random.chance(0.1) ? std::min(1.8, width - 0.3) : std::min(habits.door_m, width - 0.2);
    const double free = width - door;
    const double offset =
        random.chance(0.8) ? std::min(habits.door_offset_m, free - 0.05) : random.uniform(0.05, free);
    const double left = random.chance(0.5) ? x + offset : x + width - offset - door;
    add_door(room, {left, near_y}, {left + door, near_y}, building.rooms[0], {0, -away * habits.inner_m},
             habits.door_head_m);
    add_windows(room, habits, x, x + width, far_y, random);
    if (i > 0 && random.chance(0.25)) {  // a door to the room before
      const double y = near_y + away * random.uniform(0.2, habits.depth_m - habits.door_m - 0.2);
      add_door(room, {x, y}, {x, y + away * habits.door_m}, building.rooms.back(), {-habits.inner_m, 0},
               habits.door_head_m);
    }
    building.rooms.push_back(std::move(room));
    x += width + habits.inner_m;
  }
}

}  // namespace

Building random_building(std::uint64_t seed, int rooms_per_side) {
  Random random(seed_for(seed, "building"));
  const Habits habits(random);
  const double length = rooms_per_side * random.uniform(2.6, 5.0);
  Building building;
  BuildingRoom hallway{"hallway", box(0, 0, length, habits.hallway_m), 0, habits.height_m, {}, {}};
  const double end = std::min(random.uniform(0.8, 1.8), habits.hallway_m - 0.2);
  const double from = 0.5 * (habits.hallway_m - end);
  if (random.chance(0.7))
    hallway.openings.push_back(
        {"window", {length, from}, {length, from + end}, habits.window_sill_m, habits.window_head_m});
  if (random.chance(0.7))
    hallway.openings.push_back({"door", {0, from}, {0, from + end}, 0, habits.door_head_m});
  building.rooms.push_back(std::move(hallway));
  add_side(building, habits, rooms_per_side, habits.hallway_m, 1, length, random);
  add_side(building, habits, rooms_per_side, 0, -1, length, random);
  for (std::size_t i = 0; i < building.rooms.size(); ++i)
    furnish(building.rooms[i], i == 0 ? 0.15 * habits.furnished : habits.furnished * random.uniform(0, 1.2),
            random);
  return building;
}

SimulateOptions random_conditions(std::uint64_t seed) {
  Random random(seed_for(seed, "conditions"));
  SimulateOptions options;
  options.seed = seed;
  options.points_per_room = static_cast<int>(std::exp(random.uniform(std::log(25000.0), std::log(150000.0))));
  options.noise_m = random.uniform(0.001, 0.008);
  options.noise_growth_per_m = random.uniform(0.0, 0.003);
  options.registration_sd_m = random.uniform(0, 0.012);
  options.registration_sd_deg = random.uniform(0, 0.3);
  options.range_m = random.uniform(4, 8);
  options.eye_height_m = random.uniform(1.2, 1.7);
  options.stray_share = random.uniform(0, 0.005);
  options.doors_closed_share = random.chance(0.7) ? 0 : random.uniform(0, 0.3);
  options.doors_ajar_share = random.chance(0.5) ? 0 : random.uniform(0, 0.5);
  options.window_frame_m = random.chance(0.4) ? 0 : random.uniform(0.03, 0.08);
  options.blinds_share = random.chance(0.6) ? 0 : random.uniform(0, 0.4);
  options.outer_wall_m = random.uniform(0.25, 0.5);
  options.opposite_share = random.chance(0.4) ? 0 : random.uniform(0, 1);
  return options;
}

}  // namespace gramap
