#include "floor/find_spaces.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "geometry/polygon.h"

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

std::optional<HallwayContact> contact_of(const Polygon& outline, const std::vector<Hallway>& hallways,
                                         const std::vector<Vec2>& doors, const FindSpacesOptions& options) {
  const Polygon ring = simplified(outline, 0.05);
  std::optional<HallwayContact> best;
  double best_score = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 &a = ring[i], &b = ring[(i + 1) % ring.size()];
    const double length = (b - a).norm();
    if (length < 0.3) continue;
    const Vec2 along = (b - a) / length;
    bool has_door = false;
    for (const Vec2& door : doors)
      has_door = has_door || distance_to_segment(door, a, b) < options.reach_m / 2;
    for (std::size_t h = 0; h < hallways.size(); ++h) {
      const double shared = shared_length(a, along, length, hallways[h].outline, options);
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

}  // namespace

std::vector<HallwayContact> hallway_contacts(const std::vector<Hallway>& hallways,
                                             const std::vector<TrueRoom>& rooms,
                                             const std::vector<Vec2>& doors,
                                             const FindSpacesOptions& options) {
  std::vector<HallwayContact> contacts;
  for (std::size_t i = 0; i < rooms.size(); ++i) {
    std::optional<HallwayContact> contact = contact_of(rooms[i].outline, hallways, doors, options);
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
  for (int i = 0; i < count; ++i) {
    double nearest = 1e300;
    int found = -1;
    for (int j = 0; j < count; ++j) {
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

Space space_of_row(const std::vector<HallwayContact>& row, const std::string& id,
                   const std::string& hallway) {
  Space space;
  space.id = id;
  space.hallway = hallway;
  // One straight line for the whole row: its rooms' edges may step a little.
  Vec2 along = Vec2::Zero();
  for (const HallwayContact& contact : row) along += contact.end - contact.start;
  along.normalize();
  const Vec2 normal = left_of(along);
  double across = 0, length = 0;
  std::vector<double> depths;
  for (const HallwayContact& contact : row) {
    const double share = (contact.end - contact.start).norm();
    across += share * normal.dot((contact.start + contact.end) / 2 - row.front().start);
    length += share;
    depths.push_back(contact.depth_m);
  }
  std::nth_element(depths.begin(), depths.begin() + static_cast<std::ptrdiff_t>(depths.size() / 2),
                   depths.end());
  const double depth = depths[depths.size() / 2];
  space.start = row.front().start + across / length * normal;
  space.end = space.start + along.dot(row.back().end - row.front().start) * along;
  space.outline = {space.start, space.end, space.end + depth * normal, space.start + depth * normal};
  return space;
}

}  // namespace gramap
