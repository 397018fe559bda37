// Furniture at random: what stands in a room and where.
#include <algorithm>
#include <cmath>

#include "geometry/polygon.h"
#include "perception/random_building.h"

namespace gramap {
namespace {

/// An upright rectangle in the plan by its middle, its direction and its half sides.
Polygon rectangle(const Vec2& middle, const Vec2& along, double length, double breadth) {
  const Vec2 u = 0.5 * length * along, v = 0.5 * breadth * Vec2(-along.y(), along.x());
  return {middle - u - v, middle + u - v, middle + u + v, middle - u + v};
}

bool apart(const Polygon& a, const Polygon& b, double gap) {
  for (const Vec2& p : a)
    if (contains(b, p) || distance_to_border(b, p) < gap) return false;
  for (const Vec2& p : b)
    if (contains(a, p) || distance_to_border(a, p) < gap) return false;
  return true;
}

bool inside(const Polygon& piece, const Polygon& room) {
  return std::all_of(piece.begin(), piece.end(), [&](const Vec2& p) { return contains(room, p); });
}

/// Doors need room to walk through; windows keep away what would hide more than a little of them.
bool blocks_opening(const BuildingFurniture& piece, const BuildingRoom& room) {
  return std::any_of(room.openings.begin(), room.openings.end(), [&](const BuildingOpening& opening) {
    if (opening.kind == "window" && piece.top_m < std::max(1.0, opening.sill_m + 0.1)) return false;
    const double keep = opening.kind == "door" ? 0.7 : 0.3;
    return std::any_of(piece.outline.begin(), piece.outline.end(),
                       [&](const Vec2& p) { return distance_to_segment(p, opening.a, opening.b) < keep; }) ||
           distance_to_border(piece.outline, 0.5 * (opening.a + opening.b)) < keep;
  });
}

bool place(BuildingRoom& room, BuildingFurniture piece, double gap) {
  if (!inside(piece.outline, room.outline) || blocks_opening(piece, room)) return false;
  for (const BuildingFurniture& other : room.furniture)
    if (!apart(piece.outline, other.outline, gap)) return false;
  room.furniture.push_back(std::move(piece));
  return true;
}

Vec2 somewhere(const BuildingRoom& room, Random& random) {
  Vec2 low = room.outline[0], high = low;
  for (const Vec2& p : room.outline) low = low.cwiseMin(p), high = high.cwiseMax(p);
  return {random.uniform(low.x(), high.x()), random.uniform(low.y(), high.y())};
}

/// A place for a rectangle with its back to a random wall.
Polygon at_wall(const BuildingRoom& room, double length, double breadth, double gap, Random& random) {
  const auto i = static_cast<std::size_t>(random.below(static_cast<int>(room.outline.size())));
  const Vec2 a = room.outline[i], b = room.outline[(i + 1) % room.outline.size()];
  const Vec2 along = (b - a).normalized(), inward(-along.y(), along.x());
  const double s = random.uniform(0.5 * length, std::max(0.5 * length, (b - a).norm() - 0.5 * length));
  return rectangle(a + s * along + (0.5 * breadth + gap) * inward, along, length, breadth);
}

BuildingFurniture chair_like(const Vec2& middle, const Vec2& along, double size, Random& random) {
  BuildingFurniture chair{"chair", rectangle(middle, along, size, size), 0, 0};
  chair.top_m = size < 0.42 || random.chance(0.3) ? random.uniform(0.42, 0.52) : random.uniform(0.78, 1.05);
  chair.closed = random.chance(0.3);
  return chair;
}

/// What lies and stands on a table: papers, screens, boxes.
void add_clutter(BuildingRoom& room, std::size_t table, Random& random) {
  const Polygon top = room.furniture[table].outline;
  const double height_m = room.furniture[table].top_m;
  const OrientedBox box = oriented_box(top);
  const Vec2 across(-box.axis.y(), box.axis.x());
  for (int things = random.below(4); things > 0; --things) {
    const Vec2 middle = box.corner + random.uniform(0.15, 0.85) * box.length_m * box.axis +
                        random.uniform(0.15, 0.85) * box.breadth_m * across;
    const double thickness_m = random.chance(0.5) ? random.uniform(0.02, 0.1) : random.uniform(0.2, 0.45);
    BuildingFurniture thing{
        kClutter,
        rectangle(middle, box.axis, random.uniform(0.15, 0.55),
                  thickness_m < 0.15 ? random.uniform(0.15, 0.35) : random.uniform(0.05, 0.25)),
        height_m, height_m + thickness_m};
    if (std::all_of(thing.outline.begin(), thing.outline.end(),
                    [&](const Vec2& p) { return contains(top, p); }))
      room.furniture.push_back(std::move(thing));
  }
}

/// One to four equal tables side by side or head to head, with chairs around.
void add_tables(BuildingRoom& room, Random& random) {
  const double length = random.uniform(1.0, 2.0), breadth = random.uniform(0.6, 1.0),
               height = random.uniform(0.68, 0.82);
  const bool closed = random.chance(0.4);
  // Alone at a wall (twice as often), alone, side by side (twice as often), around a corner, round, a block.
  const int kind = random.below(8);
  const double angle =
      random.chance(0.8) ? 0.5 * 3.141592653589793 * random.below(4) : random.uniform(0, 6.283);
  Vec2 along(std::cos(angle), std::sin(angle)), across(-along.y(), along.x());
  Vec2 middle = somewhere(room, random);
  const auto before = room.furniture.size();
  const auto table = [&](const Polygon& outline) {
    BuildingFurniture piece{"table", outline, 0, height};
    piece.closed = closed;
    return place(room, piece, -1e-6);
  };
  if (kind <= 1) {
    const Polygon outline = at_wall(room, length, breadth, random.chance(0.5) ? 0.0005 : 0.05, random);
    middle = centroid(outline);
    if (!table(outline)) return;
  } else if (kind == 2) {
    if (!table(rectangle(middle, along, length, breadth))) return;
  } else if (kind == 3 || kind == 6) {
    if (!table(rectangle(middle - 0.501 * breadth * across, along, length, breadth))) return;
    table(rectangle(middle + 0.501 * breadth * across, along, length, breadth));
  } else if (kind == 4) {
    if (!table(rectangle(middle, along, length, breadth))) return;
    const double side = random.chance(0.5) ? 1 : -1;
    table(rectangle(
        middle + side * (0.5 * length + 0.501 * breadth) * along + 0.5 * (length - breadth) * across, across,
        length, breadth));
  } else if (kind == 7) {
    if (!table(rectangle(middle - 0.501 * breadth * across, along, length, breadth))) return;
    table(rectangle(middle + 0.501 * breadth * across, along, length, breadth));
    table(rectangle(middle + (0.5 * length + 0.501 * breadth) * along, across, length, breadth));
  } else {
    Polygon round;
    const double radius = random.uniform(0.4, 0.7);
    for (int i = 0; i < 16; ++i) {
      const double turn = 2 * 3.141592653589793 * i / 16;
      round.push_back(middle + radius * Vec2(std::cos(turn), std::sin(turn)));
    }
    if (!table(round)) return;
  }
  const auto tables = room.furniture.size();
  if (random.chance(0.5))
    for (std::size_t i = before; i < tables; ++i) add_clutter(room, i, random);
  for (std::size_t i = before; i < tables; ++i)
    for (int chairs = random.below(4); chairs > 0; --chairs) {
      const Polygon& ring = room.furniture[i].outline;
      const std::size_t edge = static_cast<std::size_t>(random.below(static_cast<int>(ring.size())));
      const Vec2 a = ring[edge], b = ring[(edge + 1) % ring.size()];
      const Vec2 side = (b - a).normalized(), out(side.y(), -side.x());
      const double size = random.uniform(0.3, 0.55);
      const Vec2 seat =
          a + random.uniform(0.2, 0.8) * (b - a) + (0.5 * size + random.uniform(0.02, 0.3)) * out;
      place(room, chair_like(seat, side, size, random), 0.02);
    }
}

/// A flight of stairs along a wall: no furniture, but level surfaces all the same.
void add_stairs(BuildingRoom& room, Random& random) {
  BuildingFurniture stairs{kStairs,
                           at_wall(room, random.uniform(2.5, 4.5), random.uniform(0.9, 1.5), 0.01, random), 0,
                           random.uniform(1.0, 2.2)};
  place(room, std::move(stairs), 0.02);
}

/// Cupboards, shelves, sideboards, sofas and boxes.
void add_body(BuildingRoom& room, Random& random) {
  const double drawn = random.uniform();
  BuildingFurniture piece{"other", {}, 0, 0};
  if (drawn < 0.45) {
    piece.outline = at_wall(room, random.uniform(0.6, 2.0), random.uniform(0.3, 0.65),
                            random.uniform(0.001, 0.03), random);
    piece.top_m = random.uniform(1.6, 2.25);
    if (random.chance(0.25)) piece.type = kShelf;
  } else if (drawn < 0.85) {
    piece.outline = at_wall(room, random.uniform(0.6, 2.0), random.uniform(0.3, 0.65),
                            random.uniform(0.001, 0.03), random);
    piece.top_m = random.uniform(0.6, 1.4);
  } else if (drawn < 0.93) {
    piece.outline = at_wall(room, random.uniform(1.5, 2.3), random.uniform(0.75, 1.0), 0.05, random);
    piece.top_m = random.uniform(0.6, 0.95);
    piece.type = kSofa;
  } else {
    piece.outline = rectangle(somewhere(room, random), Vec2::UnitX(), random.uniform(0.35, 0.8),
                              random.uniform(0.3, 0.6));
    piece.top_m = random.uniform(0.25, 0.6);
  }
  place(room, piece, 0.02);
}

}  // namespace

void furnish(BuildingRoom& room, double density, Random& random) {
  const double area = signed_area(room.outline);
  const auto pieces = [&](double per_piece_m2) {
    return static_cast<int>(std::lround(density * area / per_piece_m2));
  };
  // Some attempts find no place; more of them make a crammed room crammed.
  const auto fill = [&](int count, const auto& add) {
    const std::size_t before = room.furniture.size();
    for (int i = 0; i < 6 * count && room.furniture.size() < before + static_cast<std::size_t>(count); ++i)
      add();
  };
  if (random.chance(0.2)) add_stairs(room, random);
  fill(pieces(7), [&] { add_tables(room, random); });
  fill(pieces(6), [&] { add_body(room, random); });
  fill(pieces(25), [&] {
    place(room, chair_like(somewhere(room, random), Vec2::UnitX(), random.uniform(0.3, 0.5), random), 0.05);
  });
}

}  // namespace gramap
