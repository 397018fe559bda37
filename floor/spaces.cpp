#include "floor/spaces.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <tuple>

#include "floor/model.h"
#include "floor/reference_line.h"
#include "geometry/error.h"
#include "geometry/polygon.h"

namespace gramap {
namespace {

constexpr double kLeastDepth_m = 1.5;       ///< what is shallower holds no room
constexpr double kLeastLength_m = 1.5;      ///< nor does what is shorter
constexpr double kInside_m = 1e-3;          ///< rays start so far off the lines that they run along
constexpr double kLeastSpaceDepth_m = 0.5;  ///< of a space that the floor file gives
constexpr double kWidestHallway_m = 100;    ///< as wide as a concourse; beyond that the unit is wrong
constexpr double kSaid_m = 0.5;  ///< shorter extensions around a hallway's end are not worth a sentence

double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

struct Obstacle {
  Polygon ring;
  bool solid = true;  ///< its inside is taken; else (the outline) its outside
  int hallway = -1;   ///< whose it is
};

/// An edge of a hallway seen from beside it: the line that a space there would have, offset by the wall.
struct Side {
  int hallway = 0;
  Vec2 start, end;  ///< the space on the left
  double length_m() const { return (end - start).norm(); }
};

class Deriver {
 public:
  Deriver(FloorGroundTruth& floor, double inner_wall_m, double outer_wall_m)
      : floor_(floor), wall_m_(inner_wall_m) {
    add_obstacle(grown(floor.outline, -outer_wall_m), false, -1);
    for (Polygon court : floor.courtyards) {
      if (signed_area(court) < 0) std::reverse(court.begin(), court.end());
      add_obstacle(grown(court, outer_wall_m), true, -1);
    }
    for (const FixedRoom& room : floor.fixed) add_obstacle(grown(room.outline, inner_wall_m), true, -1);
    for (int h = 0; h < static_cast<int>(floor.hallways.size()); ++h)
      add_obstacle(grown(floor.hallways[h].outline, inner_wall_m), true, h);
  }

  std::vector<std::string> run() {
    // Long sides first: they take the corners, short ones what is left.
    std::vector<Side> sides = hallway_sides();
    std::stable_sort(sides.begin(), sides.end(),
                     [](const Side& a, const Side& b) { return a.length_m() > b.length_m() + 1e-6; });
    std::vector<Side> again;
    for (const Side& side : sides) {
      left_over_ = false;
      fill(side);
      if (left_over_) again.push_back(side);
    }
    leaves_deep_ = false;  // what no other side took
    for (const Side& side : again) fill(side);
    return std::move(said_);
  }

 private:
  void add_obstacle(Polygon ring, bool solid, int hallway) {
    obstacles_.push_back({std::move(ring), solid, hallway});
  }

  std::vector<Side> hallway_sides() const {
    std::vector<Side> sides;
    for (int h = 0; h < static_cast<int>(floor_.hallways.size()); ++h) {
      const Polygon ring = simplified(floor_.hallways[h].outline, 1e-3);
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const Vec2& a = ring[i];
        const Vec2& b = ring[(i + 1) % ring.size()];
        const Vec2 along = (b - a).normalized();
        const Vec2 out = Vec2(along.y(), -along.x()) * wall_m_;
        if ((b - a).norm() >= 0.5) sides.push_back({h, b + out, a + out});
      }
    }
    return sides;
  }

  bool taken(const Vec2& p) const {
    for (const Obstacle& obstacle : obstacles_)
      if (contains(obstacle.ring, p) == obstacle.solid) return true;
    return false;
  }

  struct Hit {
    double distance_m = 1e300;
    int hallway = -1;
  };
  Hit shoot(const Vec2& from, const Vec2& direction) const {
    Hit hit;
    for (const Obstacle& obstacle : obstacles_)
      for (std::size_t i = 0; i < obstacle.ring.size(); ++i) {
        const Vec2 a = obstacle.ring[i], along = obstacle.ring[(i + 1) % obstacle.ring.size()] - a;
        const double facing = cross(direction, along);
        if (std::abs(facing) < 1e-9 * along.norm()) continue;
        const double distance = cross(a - from, along) / facing, t = cross(a - from, direction) / facing;
        if (distance > 1e-9 && distance < hit.distance_m && t >= -1e-9 && t <= 1 + 1e-9)
          hit = {distance, obstacle.hallway};
      }
    return hit;
  }

  /// Places along the side at which the depth behind it may change.
  std::vector<double> breaks(const Vec2& origin, const Vec2& along, double from, double to) const {
    std::vector<double> list{from, to};
    for (const Obstacle& obstacle : obstacles_)
      for (const Vec2& p : obstacle.ring)
        if (const double s = (p - origin).dot(along); s > from + 0.01 && s < to - 0.01) list.push_back(s);
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end(), [](double a, double b) { return b - a < 0.01; }),
               list.end());
    list.back() = to;
    return list;
  }

  struct Piece {
    double from, to;              ///< along the side
    double depth_from, depth_to;  ///< at its ends
  };

  void fill(const Side& side) {
    const Vec2 along = (side.end - side.start).normalized(), left(-along.y(), along.x());
    // The first free place of the side, looked for from its middle outward.
    for (const double share : {0.5, 0.25, 0.75, 0.1, 0.9}) {
      const double middle = side.length_m() * share;
      const Vec2 base = side.start + along * middle + left * kInside_m;
      if (taken(base)) continue;
      const double from = middle - shoot(base, -along).distance_m,
                   to = middle + shoot(base, along).distance_m;
      if (to - from < kLeastLength_m) continue;
      std::vector<Piece> run;
      const std::vector<double> cuts = breaks(side.start, along, from, to);
      for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
        Piece piece = measure(side, along, left, cuts[i], cuts[i + 1]);
        const bool goes_on = !run.empty() && std::abs(run.back().depth_to - piece.depth_from) < 0.02 &&
                             std::abs(slope(run.back()) - slope(piece)) < 0.01;
        if (std::max(piece.depth_from, piece.depth_to) < kLeastDepth_m || !goes_on) {
          const std::size_t before = floor_.spaces.size();
          add_space(side, along, left, run);
          run.clear();
          if (floor_.spaces.size() > before) {  // a wall between the two
            piece.depth_from += slope(piece) * wall_m_;
            piece.from += wall_m_;
          }
        }
        if (std::max(piece.depth_from, piece.depth_to) < kLeastDepth_m) continue;
        if (run.empty())
          run.push_back(piece);
        else
          run.back().to = piece.to, run.back().depth_to = piece.depth_to;
      }
      add_space(side, along, left, run);
    }
  }

  static double slope(const Piece& piece) {
    return (piece.depth_to - piece.depth_from) / (piece.to - piece.from);
  }

  Piece measure(const Side& side, const Vec2& along, const Vec2& left, double from, double to) const {
    const auto depth = [&](double s) {
      const Hit hit = shoot(side.start + along * s + left * kInside_m, left);
      const double whole = hit.distance_m + kInside_m;
      // Between two hallways each gets a half, when halves are deep enough for rooms.
      const double half = (whole - wall_m_) / 2;
      return hit.hallway >= 0 && half >= 2 * kLeastDepth_m ? half : whole;
    };
    // Depth is linear in between; measured a little inside of both ends.
    const double inset = (to - from) / 100, first = depth(from + inset), last = depth(to - inset);
    const double rise = (last - first) / (to - from - 2 * inset);
    return {from, to, first - rise * inset, last + rise * inset};
  }

  /// A narrow, deep piece at the side of another hallway (the inner corner of an L) is better served from
  /// there, where it is long and shallow.
  bool belongs_to_another(const Side& side, const Vec2& along, const Vec2& left, const Piece& piece) const {
    const double length = piece.to - piece.from, depth = std::min(piece.depth_from, piece.depth_to);
    if (depth < 2 * length) return false;
    const Vec2 middle = side.start + along * (piece.from + length / 2) + left * (depth / 2);
    for (const double sign : {-1.0, 1.0}) {
      const Hit hit = shoot(middle, sign * along);
      if (hit.hallway >= 0 && hit.distance_m < length) return true;
    }
    return false;
  }

  void add_space(const Side& side, const Vec2& along, const Vec2& left, const std::vector<Piece>& run) {
    if (run.empty()) return;
    const Piece& piece = run.front();
    if (piece.to - piece.from < kLeastLength_m) return;
    if (leaves_deep_ && belongs_to_another(side, along, left, piece)) {
      left_over_ = true;
      return;
    }
    Space space;
    const Hallway& hallway = floor_.hallways[side.hallway];
    space.hallway = hallway.id;
    space.id = hallway.id + "-" +
               std::to_string(1 + std::count_if(floor_.spaces.begin(), floor_.spaces.end(),
                                                [&](const Space& s) { return s.hallway == hallway.id; }));
    space.start = side.start + along * piece.from;
    space.end = side.start + along * piece.to;
    space.outline = {space.start, space.end, space.end + left * piece.depth_to,
                     space.start + left * piece.depth_from};
    add_obstacle(grown(space.outline, wall_m_ - kInside_m), true, -1);
    const double before = std::max(0.0, std::min(piece.to, 0.0) - piece.from);
    const double behind = std::max(0.0, piece.to - std::max(piece.from, side.length_m()));
    char text[240];
    std::snprintf(text, sizeof text, "space '%s' derived along hallway '%s': %.2f m long, %.2f m deep",
                  space.id.c_str(), hallway.id.c_str(), piece.to - piece.from,
                  (piece.depth_from + piece.depth_to) / 2);
    std::string sentence = text;
    if (before > kSaid_m || behind > kSaid_m) {
      std::snprintf(text, sizeof text,
                    "; it takes the corner beyond the hallway's side (%.2f m before, %.2f m behind)", before,
                    behind);
      sentence += text;
    }
    said_.push_back(std::move(sentence));
    floor_.spaces.push_back(std::move(space));
  }

  FloorGroundTruth& floor_;
  double wall_m_;
  std::vector<Obstacle> obstacles_;
  std::vector<std::string> said_;
  bool leaves_deep_ = true;  ///< to other hallways
  bool left_over_ = false;   ///< the side being filled left a piece
};

}  // namespace

std::vector<std::string> derive_spaces(FloorGroundTruth& floor, double inner_wall_m, double outer_wall_m) {
  if (floor.outline.empty())
    throw InputError(
        {}, "the floor has neither spaces nor an outline to derive them from",
        "draw the spaces beside the hallways, or the outline (the outer face of the outer walls)");
  if (floor.hallways.empty())
    throw InputError(
        {}, "the floor has neither spaces nor hallways to derive them from",
        "draw the hallways, or the spaces with their reference lines, or say in the rule file how "
        "hallways grow: `hallways { … }`");
  std::vector<std::string> said = Deriver(floor, inner_wall_m, outer_wall_m).run();
  if (said.empty())
    throw InputError({}, "beside the hallways nothing is left that could hold rooms",
                     "see that the outline encloses more than the hallways");
  return said;
}

void check_floor(const FloorGroundTruth& floor, const std::string& file) {
  char text[64];
  for (const Space& space : floor.spaces) {
    const double length = (space.end - space.start).norm();
    if (length < 0.05)
      throw InputError({file}, "the reference line of space '" + space.id + "' has no length",
                       "draw it along the whole of the space's hallway edge");
    const double depth = signed_area(space.outline) / side_length(space.outline, space.start, space.end);
    std::snprintf(text, sizeof text, "' is only %.2f m deep", depth);
    if (depth < kLeastSpaceDepth_m)
      throw InputError({file}, "space '" + space.id + text + ": no room fits into it",
                       "draw the whole area beside the hallway that rooms share, or leave the space out");
  }
  for (const Hallway& hallway : floor.hallways) {
    double border = 0;
    for (std::size_t i = 0; i < hallway.outline.size(); ++i)
      border += (hallway.outline[(i + 1) % hallway.outline.size()] - hallway.outline[i]).norm();
    const double width = 2 * signed_area(hallway.outline) / border;
    std::snprintf(text, sizeof text, "' is about %.0f m wide", width);
    if (width > kWidestHallway_m)
      throw InputError({file}, "hallway '" + hallway.id + text + ": these do not look like metres",
                       "give coordinates in metres, not in centimetres or feet");
  }
  FittedFloor given;
  given.floor = floor;
  for (const Hallway& hallway : floor.hallways) {
    given.hallways.emplace_back();
    given.hallways.back().id = hallway.id;
    given.hallways.back().outline = hallway.outline;
  }
  for (const FixedRoom& room : floor.fixed) {
    given.fixed.emplace_back();
    given.fixed.back().id = room.id;
    given.fixed.back().outline = room.outline;
  }
  for (const Space& space : floor.spaces) {
    given.rooms.emplace_back();
    given.rooms.back().id = space.id;
    given.rooms.back().outline = space.outline;
  }
  if (given.hallways.empty() && given.fixed.empty() && given.rooms.empty()) return;
  try {
    check_plan(given, "space");
  } catch (const InputError& error) {
    throw InputError({file}, error.what(), error.advice);
  }
}

}  // namespace gramap
