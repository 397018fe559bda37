#include "floor/find_spaces.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "geometry/polygon.h"
#include "geometry/segment_grid.h"

namespace gramap {
namespace {

Vec2 left_of(const Vec2& direction) {
  return Vec2(-direction.y(), direction.x());
}

/// Length of the hallway's border that runs beside the edge from `a` along `along`.
double shared_length(const Vec2& a, const Vec2& along, double length, const Polygon& hallway,
                     const FindSpacesOptions& options) {
  const Vec2 outward = -left_of(along);
  double shared = 0;
  for (std::size_t i = 0; i < hallway.size(); ++i) {
    const Vec2 c = hallway[i] - a, d = hallway[(i + 1) % hallway.size()] - a;
    const double edge_length = (d - c).norm();
    // Two areas on either side of a line run along it in opposite directions.
    if (edge_length == 0 || along.dot(d - c) > -std::cos(options.parallel_rad) * edge_length) continue;
    const double gap = outward.dot((c + d) / 2);
    if (gap < -options.interior_lap_m || gap > options.reach_m) continue;
    shared += std::max(0.0, std::min(along.dot(c), length) - std::max(along.dot(d), 0.0));
  }
  return shared;
}

/// The stretch of the room's border within a wall's thickness of the line through `a` along `along`.
HallwayContact stretch(const Polygon& ring, const Vec2& a, const Vec2& along) {
  HallwayContact contact;
  const Vec2 normal = left_of(along);
  double first = 1e300, last = -1e300, deepest = 0;
  for (const Vec2& point : ring) {
    const double across = normal.dot(point - a);
    deepest = std::max(deepest, across);
    if (std::abs(across) > 0.35) continue;
    first = std::min(first, along.dot(point - a));
    last = std::max(last, along.dot(point - a));
  }
  contact.start = a + first * along;
  contact.end = a + last * along;
  contact.depth_m = deepest;
  return contact;
}

/// What rooms are beside: hallways and the box in which a room's edge can be beside one, doors by their
/// place.
struct Surroundings {
  const std::vector<Hallway>& hallways;
  std::vector<Eigen::AlignedBox2d> beside;  ///< by hallway
  const std::vector<Vec2>& doors;
  SegmentGrid door_grid;

  Surroundings(const std::vector<Hallway>& all_hallways, const std::vector<Vec2>& all_doors,
               const FindSpacesOptions& options)
      : hallways(all_hallways), doors(all_doors) {
    for (const Hallway& hallway : hallways) {
      Eigen::AlignedBox2d& box = beside.emplace_back();
      for (const Vec2& point : hallway.outline) box.extend(point);
      // An edge askew by the most that is allowed comes nearer than its middle is.
      const double margin_m =
          std::max(options.reach_m, options.interior_lap_m) + options.parallel_rad * box.diagonal().norm();
      if (!box.isEmpty()) box = {Vec2(box.min().array() - margin_m), Vec2(box.max().array() + margin_m)};
    }
    for (const Vec2& door : doors) door_grid.add(door, door);
  }
};

std::optional<HallwayContact> contact_of(const Polygon& outline, const Surroundings& around,
                                         const FindSpacesOptions& options) {
  const Polygon ring = simplified(outline, 0.05);
  std::optional<HallwayContact> best;
  double best_score = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 &a = ring[i], &b = ring[(i + 1) % ring.size()];
    const double length = (b - a).norm();
    if (length < 0.3) continue;
    const Vec2 along = (b - a) / length;
    bool has_door = false;
    for (const int door : around.door_grid.near(a, b, options.reach_m))
      has_door = has_door || distance_to_segment(around.doors[static_cast<std::size_t>(door)], a, b) <
                                 options.reach_m / 2;
    Eigen::AlignedBox2d edge(a);
    edge.extend(b);
    for (std::size_t h = 0; h < around.hallways.size(); ++h) {
      if (!around.beside[h].intersects(edge)) continue;
      const double shared = shared_length(a, along, length, around.hallways[h].outline, options);
      if (shared < std::min(options.overlap_m, 0.8 * length)) continue;
      const double score = shared + (has_door ? 1000 : 0);
      if (score <= best_score) continue;
      best_score = score;
      best = stretch(ring, a, along);
      best->hallway = static_cast<int>(h);
    }
  }
  return best;
}

Vec2 direction(const HallwayContact& contact) {
  return (contact.end - contact.start).normalized();
}

bool follows(const HallwayContact& next, const HallwayContact& contact, const FindSpacesOptions& options) {
  const Vec2 along = direction(contact);
  if (direction(next).dot(along) < std::cos(options.parallel_rad)) return false;
  const Vec2 step = next.start - contact.end;
  return std::abs(left_of(along).dot(step)) < options.step_m && along.dot(step) < options.interior_gap_m &&
         along.dot(step) > -options.interior_lap_m;
}

/// A room's part of its row, in the row's frame: along the line and across it.
struct Strip {
  double start_m = 0, end_m = 0;   ///< along
  double front_m = 0, back_m = 0;  ///< across, the front at the hallway
};

/// The least distance at which the ring crosses the band from..to along the line, of what lies further than
/// `beyond`; 1e300 when nothing does.
double nearest_across(const Polygon& ring, double from, double to, double beyond) {
  double nearest = 1e300;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    Vec2 a = ring[i], b = ring[(i + 1) % ring.size()];
    if (a.x() > b.x()) std::swap(a, b);
    if (b.x() <= from || a.x() >= to) continue;
    const auto at = [&](double s) { return a.y() + (b.y() - a.y()) * (s - a.x()) / (b.x() - a.x()); };
    for (const double t : {at(std::max(from, a.x())), at(std::min(to, b.x()))})
      if (t > beyond) nearest = std::min(nearest, t);
  }
  return nearest;
}

/// Where others reach a little into the row from its ends, the row is shortened; where they reach into it
/// from behind, the strip there is made less deep; from before, its front recedes.
void keep_clear(std::vector<Strip>& strips, const std::vector<Polygon>& others, double wall_m) {
  constexpr double kAskew_m = 1;  // the most that a plan's rooms are askew by, over their depth
  Strip &first = strips.front(), &last = strips.back();
  const double start_m = first.start_m, end_m = last.end_m;
  const auto swapped = [](const Polygon& ring) {
    Polygon result;
    for (const Vec2& p : ring) result.emplace_back(p.y(), p.x());
    return result;
  };
  for (const Polygon& ring : others) {
    Polygon turned = swapped(ring);
    const double ahead = nearest_across(turned, last.front_m, last.back_m, end_m - kAskew_m);
    last.end_m = std::min(last.end_m, ahead - wall_m);
    for (Vec2& p : turned) p.y() = -p.y();
    const double behind = -nearest_across(turned, first.front_m, first.back_m, -start_m - kAskew_m);
    first.start_m = std::max(first.start_m, behind + wall_m);
  }
  for (Strip& strip : strips) {
    const double middle = (strip.front_m + strip.back_m) / 2, inset = 0.02;
    for (Polygon ring : others) {
      const double from = strip.start_m + inset, to = strip.end_m - inset;
      strip.back_m = std::min(strip.back_m, nearest_across(ring, from, to, middle) - wall_m);
      for (Vec2& p : ring) p.y() = -p.y();
      const double before = -nearest_across(ring, from, to, -middle);
      strip.front_m = std::max(strip.front_m, before + wall_m);
    }
  }
}

/// Joins neighbours that differ by less than anybody would build.
void join_equal(std::vector<Strip>& strips) {
  constexpr double kStep_m = 0.1;
  std::vector<Strip> joined;
  for (const Strip& strip : strips) {
    if (!joined.empty() && std::abs(joined.back().front_m - strip.front_m) < kStep_m &&
        std::abs(joined.back().back_m - strip.back_m) < kStep_m) {
      Strip& whole = joined.back();
      whole.end_m = strip.end_m;
      whole.front_m = std::max(whole.front_m, strip.front_m);
      whole.back_m = std::min(whole.back_m, strip.back_m);
    } else {
      joined.push_back(strip);
    }
  }
  strips = std::move(joined);
}

}  // namespace

std::vector<HallwayContact> hallway_contacts(const std::vector<Hallway>& hallways,
                                             const std::vector<TrueRoom>& rooms,
                                             const std::vector<Vec2>& doors,
                                             const FindSpacesOptions& options) {
  const Surroundings around(hallways, doors, options);
  std::vector<HallwayContact> contacts;
  for (std::size_t i = 0; i < rooms.size(); ++i) {
    std::optional<HallwayContact> contact = contact_of(rooms[i].outline, around, options);
    if (!contact || (contact->end - contact->start).norm() < 0.5) continue;
    contact->room = static_cast<int>(i);
    contacts.push_back(*contact);
  }
  return contacts;
}

std::vector<std::vector<HallwayContact>> contact_rows(const std::vector<HallwayContact>& contacts,
                                                      const FindSpacesOptions& options) {
  const int count = static_cast<int>(contacts.size());
  const auto at = [&](int i) -> const HallwayContact& { return contacts[static_cast<std::size_t>(i)]; };
  std::vector<int> next(contacts.size(), -1), previous(contacts.size(), -1);
  SegmentGrid starts;
  for (const HallwayContact& contact : contacts) starts.add(contact.start, contact.start);
  const double reach_m = options.step_m + std::max(options.interior_gap_m, options.interior_lap_m);
  for (int i = 0; i < count; ++i) {
    double nearest = 1e300;
    int found = -1;
    for (const int j : starts.near(at(i).end, at(i).end, reach_m)) {
      if (j == i || previous[static_cast<std::size_t>(j)] >= 0 || !follows(at(j), at(i), options)) continue;
      const double distance = (at(j).start - at(i).end).norm();
      if (distance >= nearest) continue;
      nearest = distance;
      found = j;
    }
    if (found < 0) continue;
    next[static_cast<std::size_t>(i)] = found;
    previous[static_cast<std::size_t>(found)] = i;
  }
  std::vector<std::vector<HallwayContact>> rows;
  std::vector<bool> used(contacts.size(), false);
  const auto walk = [&](int i) {
    std::vector<HallwayContact> row;
    for (; i >= 0 && !used[static_cast<std::size_t>(i)]; i = next[static_cast<std::size_t>(i)]) {
      used[static_cast<std::size_t>(i)] = true;
      row.push_back(at(i));
    }
    if (!row.empty()) rows.push_back(std::move(row));
  };
  for (int i = 0; i < count; ++i)
    if (previous[static_cast<std::size_t>(i)] < 0) walk(i);
  for (int i = 0; i < count; ++i) walk(i);  // a row that bites its own tail, along a round hallway
  return rows;
}

Space space_of_row(const std::vector<HallwayContact>& row, const std::string& id, const std::string& hallway,
                   const std::vector<Polygon>& others, double wall_m) {
  // One straight line for the whole row: its rooms' edges may step a little.
  Vec2 along = Vec2::Zero();
  for (const HallwayContact& contact : row) along += contact.end - contact.start;
  along.normalize();
  const Vec2 normal = left_of(along), origin = row.front().start;
  double across = 0, length = 0;
  std::vector<Strip> strips;
  for (const HallwayContact& contact : row) {
    const double share = (contact.end - contact.start).norm();
    across += share * normal.dot((contact.start + contact.end) / 2 - origin);
    length += share;
    const double first = normal.dot(contact.start - origin), last = normal.dot(contact.end - origin);
    strips.push_back({along.dot(contact.start - origin), along.dot(contact.end - origin),
                      std::max(first, last), std::min(first, last) + contact.depth_m});
  }
  for (std::size_t i = 0; i + 1 < strips.size(); ++i)
    strips[i].end_m = strips[i + 1].start_m = (strips[i].end_m + strips[i + 1].start_m) / 2;
  std::vector<Polygon> rings;
  for (const Polygon& other : others) {
    rings.emplace_back();
    for (const Vec2& p : other) rings.back().emplace_back(along.dot(p - origin), normal.dot(p - origin));
  }
  keep_clear(strips, rings, wall_m);
  join_equal(strips);

  Space space;
  space.id = id;
  space.hallway = hallway;
  const auto in_plan = [&](double s, double t) { return Vec2(origin + s * along + t * normal); };
  space.start = in_plan(strips.front().start_m, across / length);
  space.end = in_plan(strips.back().end_m, across / length);
  for (const Strip& strip : strips) {
    space.outline.push_back(in_plan(strip.start_m, strip.front_m));
    space.outline.push_back(in_plan(strip.end_m, strip.front_m));
  }
  for (auto strip = strips.rbegin(); strip != strips.rend(); ++strip) {
    space.outline.push_back(in_plan(strip->end_m, strip->back_m));
    space.outline.push_back(in_plan(strip->start_m, strip->back_m));
  }
  space.outline = simplified(space.outline, 1e-6);
  return space;
}

}  // namespace gramap
