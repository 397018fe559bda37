#include "floor/wall_openings.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "geometry/say.h"

namespace gramap {
namespace {

constexpr double kReach_m = 0.6;    ///< most distance between an opening and its wall's face
constexpr double kMargin_m = 0.02;  ///< least stretch of wall beside an opening, and between two
constexpr double kLeastWidth_m = 0.25;
constexpr double kLeastHeight_m = 0.25;
constexpr double kLintel_m = 0.03;  ///< least height of wall above an opening

struct Candidate {
  int room = 0;
  FittedOpening opening;
  int wall = -1;
  Partition::Face face;  ///< of the room
  double from_m = 0;     ///< along the face
  double to_m = 0;
  double common_from_m = 0;  ///< along the wall's own direction, to compare openings of one wall
  double common_to_m = 0;
};

std::string described(const ModelRoom& room, const FittedOpening& opening) {
  return "the " + opening.kind + " of " + room.node + " at " + said_point((opening.a + opening.b) / 2);
}

/// A direction along the wall that does not depend on the side one looks from.
Vec2 common_direction(const Vec2& along) {
  return along.x() < -1e-9 || (std::abs(along.x()) <= 1e-9 && along.y() < 0) ? Vec2(-along) : along;
}

/// The wall and face behind an opening; wall < 0 when there is none.
Candidate find_face(int room, const FittedOpening& opening, const Partition& plan,
                    const std::vector<std::vector<int>>& walls_of_room) {
  Candidate best{room, opening, -1, {}, 0, 0, 0, 0};
  const Vec2 middle = (opening.a + opening.b) / 2, across = (opening.b - opening.a).normalized();
  double nearest = kReach_m;
  for (const int w : walls_of_room[room])
    for (const Partition::Face& face : plan.walls[w].faces) {
      if (face.side != room) continue;
      const double length = (face.b - face.a).norm();
      const Vec2 along = (face.b - face.a) / length;
      if (std::abs(across.dot(along)) < 0.9) continue;
      const double t = std::clamp((middle - face.a).dot(along), 0.0, length);
      const double distance = (face.a + along * t - middle).norm();
      if (distance >= nearest) continue;
      nearest = distance;
      best.wall = w;
      best.face = face;
    }
  return best;
}

/// Clips the opening to its face and to the faces that lie opposite.
bool clip(Candidate& candidate, const Partition& plan) {
  const Partition::Face& face = candidate.face;
  const double length = (face.b - face.a).norm();
  const Vec2 along = (face.b - face.a) / length;
  const double a = (candidate.opening.a - face.a).dot(along), b = (candidate.opening.b - face.a).dot(along);
  const double wish_from = std::min(a, b), wish_to = std::max(a, b);
  double best = 0;
  for (const Partition::Face& other : plan.walls[candidate.wall].faces) {
    if ((other.b - other.a).dot(along) >= 0) continue;  // the same side
    const double from = std::max({wish_from, kMargin_m, (other.b - face.a).dot(along) + kMargin_m});
    const double to = std::min({wish_to, length - kMargin_m, (other.a - face.a).dot(along) - kMargin_m});
    if (to - from <= best) continue;
    best = to - from;
    candidate.from_m = from;
    candidate.to_m = to;
  }
  return best >= std::max(kLeastWidth_m, (wish_to - wish_from) / 2);
}

void set_common(Candidate& candidate) {
  const Vec2 along = (candidate.face.b - candidate.face.a).normalized(), common = common_direction(along);
  const double a = (candidate.face.a + along * candidate.from_m).dot(common),
               b = (candidate.face.a + along * candidate.to_m).dot(common);
  candidate.common_from_m = std::min(a, b);
  candidate.common_to_m = std::max(a, b);
}

/// Doors before windows, what was seen before what was derived, rooms before the hallways that have the same
/// door.
bool goes_first(const Candidate& a, const Candidate& b, const std::vector<ModelRoom>& rooms) {
  const auto rank = [&rooms](const Candidate& c) {
    return std::tuple(c.wall, c.opening.origin == Origin::derived,
                      rooms[c.room].kind != ModelRoom::Kind::room, c.opening.kind, -c.opening.confidence,
                      c.common_from_m, c.common_to_m);
  };
  return rank(a) < rank(b);
}

}  // namespace

PlacedOpenings place_openings(const std::vector<ModelRoom>& rooms, const Partition& plan) {
  PlacedOpenings result;
  const auto set_aside = [&](const Candidate& c, const std::string& reason) {
    if (c.opening.origin == Origin::derived) return;  // nobody has seen it
    result.set_aside.push_back({described(rooms[c.room], c.opening), reason});
  };
  std::vector<std::vector<int>> walls_of_room(rooms.size());
  for (int w = 0; w < static_cast<int>(plan.walls.size()); ++w) {
    const Partition::Wall& wall = plan.walls[w];
    if (wall.kind != PlanCell::Kind::wall) continue;
    if (wall.side_a == kOutside) continue;  // between two courtyards
    walls_of_room[wall.side_a].push_back(w);
    if (wall.side_b != kOutside && wall.side_b != wall.side_a) walls_of_room[wall.side_b].push_back(w);
  }

  std::vector<Candidate> candidates;
  for (int room = 0; room < static_cast<int>(rooms.size()); ++room)
    for (const FittedOpening& opening : rooms[room].fitted.openings) {
      Candidate candidate = find_face(room, opening, plan, walls_of_room);
      FittedOpening& o = candidate.opening;
      o.sill_m = o.kind == "door" && o.sill_m < 0.1 ? 0 : std::max(0.0, o.sill_m);
      o.head_m = std::min(o.head_m, rooms[room].height_m - kLintel_m);
      if (candidate.wall < 0)
        set_aside(candidate, "no wall of the room is there");
      else if (o.kind == "window" && o.origin == Origin::derived &&
               plan.walls[candidate.wall].side_b != kOutside)
        continue;  // rules know of façades only
      else if (!(o.head_m - o.sill_m >= kLeastHeight_m))
        set_aside(candidate, "it has no height");
      else if (!clip(candidate, plan))
        set_aside(candidate, "it does not fit into the wall there");
      else
        set_common(candidate), candidates.push_back(std::move(candidate));
    }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [&rooms](const Candidate& a, const Candidate& b) { return goes_first(a, b, rooms); });

  std::vector<const Candidate*> taken;
  for (Candidate& c : candidates) {
    bool free = true;
    for (const Candidate* other : taken) {
      if (other->wall != c.wall) continue;
      const double overlap =
          std::min(c.common_to_m, other->common_to_m) - std::max(c.common_from_m, other->common_from_m);
      if (overlap <= -kMargin_m) continue;
      const double narrower = std::min(c.to_m - c.from_m, other->to_m - other->from_m);
      const bool same = c.opening.kind == other->opening.kind && overlap > 0.3 * narrower;
      if (!same && c.opening.origin != Origin::derived)
        set_aside(c, "another opening of the wall is in its place");
      free = false;
      break;
    }
    if (!free) continue;
    taken.push_back(&c);
    const Vec2 along = (c.face.b - c.face.a).normalized();
    ModelOpening opening;
    opening.fitted = c.opening;
    opening.fitted.a = c.face.a + along * c.from_m;
    opening.fitted.b = c.face.a + along * c.to_m;
    opening.room = rooms[c.room].fitted.id;
    const Partition::Wall& wall = plan.walls[c.wall];
    const int other = wall.side_a == c.room ? wall.side_b : wall.side_a;
    opening.other = other == kOutside ? "outside" : rooms[other].fitted.id;
    result.cuts.push_back({c.room, opening.fitted.a, opening.fitted.b});
    result.openings.push_back(std::move(opening));
  }
  return result;
}

}  // namespace gramap
