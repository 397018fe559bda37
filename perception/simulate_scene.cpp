#include "perception/simulate_scene.h"

#include <algorithm>
#include <cmath>

#include "geometry/polygon.h"
#include "perception/random.h"
#include "perception/simulate_furniture.h"

namespace gramap {
namespace {

constexpr double kThickestWall_m = 0.8;  // farther than this, the face behind is another room's far side

Vec2 right_of(const Vec2& direction) {
  return {direction.y(), -direction.x()};
}

Vec3 at_height(const Vec2& p, double z) {
  return {p.x(), p.y(), z};
}

/// An upright rectangle over the plan segment a–b.
Face upright(const Vec2& a, const Vec2& b, double bottom, double top) {
  return {at_height(a, bottom), at_height(b - a, 0), Vec3(0, 0, top - bottom), {}};
}

/// A hole through a wall: the rectangle on the room's face and how deep it goes outward.
struct Aperture {
  std::string kind;
  Vec2 a, b;     // on the face, in the outline's direction: the room is on the left
  Vec2 outward;  // unit
  double bottom, top;
  double depth;   // to the face behind, or of the outer wall
  bool mirrored;  // the same hole is already there, as seen from the room behind
};

struct Edge {
  Vec2 a, b;
};

std::vector<Edge> edges_of(const Polygon& ring) {
  std::vector<Edge> edges;
  for (std::size_t i = 0; i < ring.size(); ++i) edges.push_back({ring[i], ring[(i + 1) % ring.size()]});
  return edges;
}

/// How far behind `point` the next room's face lies, looking along `outward`; the outer wall when there is
/// none.
double wall_depth(const Building& building, std::size_t room, const Vec2& point, const Vec2& outward,
                  double outer_wall_m) {
  double depth = kThickestWall_m;
  for (std::size_t other = 0; other < building.rooms.size(); ++other) {
    if (other == room) continue;
    for (const Edge& edge : edges_of(building.rooms[other].outline)) {
      const Vec2 along = (edge.b - edge.a).normalized();
      if (along.dot(right_of(outward)) > -0.99 && along.dot(right_of(outward)) < 0.99) continue;
      const double s = along.dot(point - edge.a);
      const double d = outward.dot(edge.a - point);
      if (s > 0 && s < (edge.b - edge.a).norm() && d > 0.01) depth = std::min(depth, d);
    }
  }
  return depth < kThickestWall_m ? depth : outer_wall_m;
}

/// The hole of an opening of `room`; on the outline's nearest edge.
Aperture aperture_of(const Building& building, std::size_t room, const BuildingOpening& opening,
                     double outer_wall_m) {
  const BuildingRoom& owner = building.rooms[room];
  const Vec2 middle = 0.5 * (opening.a + opening.b);
  Edge best{opening.a, opening.b};
  double best_distance = std::numeric_limits<double>::infinity();
  for (const Edge& edge : edges_of(owner.outline)) {
    const double distance = distance_to_segment(middle, edge.a, edge.b);
    if (distance < best_distance) best = edge, best_distance = distance;
  }
  const Vec2 along = (best.b - best.a).normalized();
  const double from = std::min(along.dot(opening.a - best.a), along.dot(opening.b - best.a));
  const double to = std::max(along.dot(opening.a - best.a), along.dot(opening.b - best.a));
  const Vec2 outward = right_of(along);
  return {opening.kind,
          best.a + from * along,
          best.a + to * along,
          outward,
          owner.floor_m + opening.sill_m,
          owner.floor_m + opening.head_m,
          wall_depth(building, room, middle, outward, outer_wall_m),
          false};
}

std::vector<Aperture> apertures_of(const Building& building, double outer_wall_m) {
  std::vector<Aperture> all;
  for (std::size_t room = 0; room < building.rooms.size(); ++room)
    for (const BuildingOpening& opening : building.rooms[room].openings) {
      Aperture hole = aperture_of(building, room, opening, outer_wall_m);
      for (const Aperture& other : all) {
        const Vec2 between = 0.5 * (other.a + other.b) - 0.5 * (hole.a + hole.b);
        if (hole.outward.dot(other.outward) < -0.99 &&
            std::abs(hole.outward.dot(between) - hole.depth) < 0.05 &&
            std::abs(right_of(hole.outward).dot(between)) < 0.2)
          hole.mirrored = true;
      }
      all.push_back(hole);
    }
  return all;
}

/// A wall of a room as rectangles around the holes that reach its face from either side.
void add_wall(std::vector<Face>& faces, const Edge& edge, const BuildingRoom& room,
              const std::vector<Aperture>& apertures) {
  struct Hole {
    double from, to, bottom, top;
  };
  const double length = (edge.b - edge.a).norm();
  const Vec2 along = (edge.b - edge.a) / length;
  std::vector<Hole> holes;
  std::vector<double> cuts = {0, length}, heights = {room.floor_m, room.ceiling_m};
  for (const Aperture& hole : apertures) {
    const double across = right_of(along).dot(hole.a - edge.a);
    const bool on_this_face = hole.outward.dot(right_of(along)) > 0.99 && std::abs(across) < 0.02;
    const bool from_behind =
        hole.outward.dot(right_of(along)) < -0.99 && std::abs(across - hole.depth) < 0.02;
    if (!on_this_face && !from_behind) continue;
    const double s = along.dot(hole.a - edge.a), t = along.dot(hole.b - edge.a);
    const Hole cut{std::clamp(std::min(s, t), 0.0, length), std::clamp(std::max(s, t), 0.0, length),
                   std::clamp(hole.bottom, room.floor_m, room.ceiling_m),
                   std::clamp(hole.top, room.floor_m, room.ceiling_m)};
    if (cut.to - cut.from < 1e-6 || cut.top - cut.bottom < 1e-6) continue;
    holes.push_back(cut);
    cuts.insert(cuts.end(), {cut.from, cut.to});
    heights.insert(heights.end(), {cut.bottom, cut.top});
  }
  std::sort(cuts.begin(), cuts.end());
  std::sort(heights.begin(), heights.end());
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    if (cuts[i + 1] - cuts[i] < 1e-6) continue;
    double solid_from = heights.front();  // merge the solid cells of a column
    const double s = 0.5 * (cuts[i] + cuts[i + 1]);
    const auto add = [&](double bottom, double top) {
      if (top - bottom > 1e-6)
        faces.push_back(upright(edge.a + cuts[i] * along, edge.a + cuts[i + 1] * along, bottom, top));
    };
    for (std::size_t j = 0; j + 1 < heights.size(); ++j) {
      const double z = 0.5 * (heights[j] + heights[j + 1]);
      const bool open = std::any_of(holes.begin(), holes.end(), [&](const Hole& hole) {
        return s > hole.from && s < hole.to && z > hole.bottom && z < hole.top;
      });
      if (!open) continue;
      add(solid_from, heights[j]);
      solid_from = heights[j + 1];
    }
    add(solid_from, heights.back());
  }
}

void add_reveal(std::vector<Face>& faces, const Aperture& hole) {
  const Vec2 back = hole.depth * hole.outward;
  faces.push_back(upright(hole.a, hole.a + back, hole.bottom, hole.top));
  faces.push_back(upright(hole.b, hole.b + back, hole.bottom, hole.top));
  for (const double z : {hole.bottom, hole.top})
    faces.push_back({at_height(hole.a, z), at_height(hole.b - hole.a, 0), at_height(back, 0), {}});
}

/// A leaf, closed in the middle of the wall or ajar, turned into the room around one of its two edges.
void add_leaf(std::vector<Face>& faces, const Aperture& hole, const SimulateOptions& options,
              Random& random) {
  const double state = random.uniform();
  const bool hinge_at_a = random.chance(0.5);
  const double opened_rad = random.uniform(20, 80) * 3.141592653589793 / 180;
  const Vec2 inset = std::min(0.05, 0.5 * hole.depth) * hole.outward;
  if (state < options.doors_closed_share) {
    faces.push_back(upright(hole.a + inset, hole.b + inset, hole.bottom, hole.top));
  } else if (state < options.doors_closed_share + options.doors_ajar_share) {
    const Vec2 hinge = hinge_at_a ? hole.a : hole.b;
    const Vec2 shut = hinge_at_a ? Vec2(hole.b - hole.a) : Vec2(hole.a - hole.b);
    const Vec2 free_edge =
        hinge + std::cos(opened_rad) * shut - std::sin(opened_rad) * shut.norm() * hole.outward;
    const Vec2 thickness = 0.04 * right_of((free_edge - hinge).normalized());
    add_prism(faces, {hinge, free_edge, free_edge + thickness, hinge + thickness}, hole.bottom + 0.005,
              hole.top);
  }
}

void add_window(std::vector<Face>& faces, const Aperture& hole, const SimulateOptions& options,
                Random& random) {
  const double drawn = random.uniform(), lowered = random.uniform(0.2, 0.6);
  const Vec2 along = (hole.b - hole.a).normalized();
  const Vec2 pane = 0.6 * hole.depth * hole.outward;
  const double width = (hole.b - hole.a).norm(), frame = options.window_frame_m;
  const Vec2 a = hole.a + pane, b = hole.b + pane;
  if (frame > 0 && 2 * frame < std::min(width, hole.top - hole.bottom)) {
    faces.push_back(upright(a, a + frame * along, hole.bottom, hole.top));
    faces.push_back(upright(b - frame * along, b, hole.bottom, hole.top));
    faces.push_back(upright(a + frame * along, b - frame * along, hole.bottom, hole.bottom + frame));
    faces.push_back(upright(a + frame * along, b - frame * along, hole.top - frame, hole.top));
    if (width > 1.3) {
      const Vec2 middle = 0.5 * (a + b);
      faces.push_back(
          upright(middle - 0.5 * frame * along, middle + 0.5 * frame * along, hole.bottom, hole.top));
    }
  }
  if (drawn < options.blinds_share) {
    const Vec2 inset = 0.3 * hole.depth * hole.outward;
    faces.push_back(
        upright(hole.a + inset, hole.b + inset, hole.top - lowered * (hole.top - hole.bottom), hole.top));
  }
}

/// What is in sight through a window, unless rooms are there: an upright face that may be narrower than the
/// window or wider, low or high.
void add_opposite(std::vector<Face>& faces, const Building& building, const Aperture& hole,
                  const SimulateOptions& options, Random& random) {
  const double drawn = random.uniform(), away = random.uniform(1.5, 5.0), aside = random.uniform(-1.0, 1.0);
  const double width = random.uniform(0.5, 12.0), top = random.uniform(0.5, 6.0);
  if (drawn >= options.opposite_share) return;
  const Vec2 along = (hole.b - hole.a).normalized();
  const Vec2 middle = 0.5 * (hole.a + hole.b) + (hole.depth + away) * hole.outward + aside * along;
  constexpr int kPlaces = 9;
  for (int i = 0; i < kPlaces; ++i) {
    const Vec2 place = middle + (static_cast<double>(i) / (kPlaces - 1) - 0.5) * width * along;
    for (const BuildingRoom& room : building.rooms)
      if (contains(room.outline, place)) return;
  }
  faces.push_back(upright(middle - 0.5 * width * along, middle + 0.5 * width * along, hole.bottom - 3,
                          hole.bottom + top));
}

/// What a hole is like depends on the seed and its place, not on how many other holes there are.
Random random_of(const Aperture& hole, std::uint64_t seed) {
  const Vec2 middle = 0.5 * (hole.a + hole.b);
  const std::string place = hole.kind + std::to_string(std::lround(middle.x() * 100)) + "," +
                            std::to_string(std::lround(middle.y() * 100));
  return Random(seed_for(seed, place));
}

}  // namespace

std::vector<Face> building_faces(const Building& building, const SimulateOptions& options) {
  std::vector<Face> faces;
  const std::vector<Aperture> apertures = apertures_of(building, options.outer_wall_m);
  for (const BuildingRoom& room : building.rooms) {
    for (const double z : {room.floor_m, room.ceiling_m}) {
      Face face;
      face.origin = at_height(room.outline[0], z);
      face.ring = room.outline;
      faces.push_back(face);
    }
    for (const Edge& edge : edges_of(room.outline))
      if ((edge.b - edge.a).norm() > 1e-6) add_wall(faces, edge, room, apertures);
    for (const BuildingFurniture& piece : room.furniture) add_furniture(faces, piece, room.floor_m);
  }
  for (const Aperture& hole : apertures) {
    if (hole.mirrored) continue;
    add_reveal(faces, hole);
    Random random = random_of(hole, options.seed);
    if (hole.kind == "door") add_leaf(faces, hole, options, random);
    if (hole.kind != "window") continue;
    add_window(faces, hole, options, random);
    add_opposite(faces, building, hole, options, random);
  }
  return faces;
}

void add_prism(std::vector<Face>& faces, const Polygon& outline, double bottom_m, double top_m) {
  for (std::size_t i = 0; i < outline.size(); ++i)
    faces.push_back(upright(outline[i], outline[(i + 1) % outline.size()], bottom_m, top_m));
  for (const double z : {bottom_m, top_m}) {
    Face face;
    face.origin = at_height(outline[0], z);
    face.ring = outline;
    faces.push_back(face);
  }
}

}  // namespace gramap
