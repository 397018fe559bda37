#include "floor/known_rows.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>
#include <unordered_map>

#include "floor/find_spaces.h"
#include "geometry/polygon.h"
#include "grammar/learn_habits.h"

namespace gramap {
namespace {

/// A room as it lies along the reference line.
/// What the truth says of things in rooms, by the rooms' ids.
struct Contents {
  std::unordered_map<std::string, std::vector<const TrueOpening*>> openings;
  std::unordered_map<std::string, std::vector<const TrueFurniture*>> furniture;
  bool doors_known = false;

  explicit Contents(const FloorTruth& truth) {
    for (const TrueOpening& opening : truth.openings) {
      openings[opening.room].push_back(&opening);
      doors_known = doors_known || opening.kind == "door";
    }
    for (const TrueFurniture& piece : truth.furniture) furniture[piece.room].push_back(&piece);
  }
};

struct Lying {
  const TrueRoom* room = nullptr;
  double start_m = 0, end_m = 0;   ///< at the hallway
  double front_m = 0, back_m = 0;  ///< distance from the line
};

struct Frame {
  Vec2 origin, along, across;
  explicit Frame(const Space& space)
      : origin(space.start), along((space.end - space.start).normalized()), across(-along.y(), along.x()) {}
  Vec2 local(const Vec2& point) const { return {along.dot(point - origin), across.dot(point - origin)}; }
};

std::vector<Lying> rooms_along(const Space& space, const Frame& frame,
                               const std::vector<const TrueRoom*>& rooms) {
  std::vector<Lying> lying;
  Eigen::AlignedBox2d bounds;
  for (const Vec2& point : space.outline) bounds.extend(point);
  for (const TrueRoom* room : rooms) {
    const Vec2 centre = centroid(room->outline);
    if (bounds.exteriorDistance(centre) > 0.31) continue;
    if (!contains(space.outline, centre) && distance_to_border(space.outline, centre) > 0.3) continue;
    Lying item{room, 1e300, -1e300, 1e300, -1e300};
    for (const Vec2& point : room->outline) {
      item.front_m = std::min(item.front_m, frame.local(point).y());
      item.back_m = std::max(item.back_m, frame.local(point).y());
    }
    if (item.front_m > 0.8) continue;  // it lies behind another room
    for (const Vec2& point : room->outline) {
      const Vec2 local = frame.local(point);
      if (local.y() > item.front_m + 0.35) continue;
      item.start_m = std::min(item.start_m, local.x());
      item.end_m = std::max(item.end_m, local.x());
    }
    if (item.end_m - item.start_m > 0.3) lying.push_back(item);
  }
  std::stable_sort(lying.begin(), lying.end(),
                   [](const Lying& a, const Lying& b) { return a.start_m < b.start_m; });
  return lying;
}

void add_openings(const std::vector<const TrueOpening*>& openings, const Frame& frame, const Lying& item,
                  double start_m, KnownRoom& room) {
  for (const TrueOpening* given : openings) {
    const TrueOpening& opening = *given;
    const Vec2 a = frame.local(opening.a), b = frame.local(opening.b), middle = (a + b) / 2;
    if (std::abs(a.y() - b.y()) > 0.3) continue;  // in a side wall
    const double half = std::max(opening.width_m, (a - b).norm()) / 2;
    if (opening.kind == "door" && middle.y() < item.front_m + 0.5)
      room.doors.push_back(
          {middle.x() - half - start_m, middle.x() + half - start_m, opening.head_m - opening.sill_m});
    if (opening.kind == "window" && middle.y() > (item.front_m + item.back_m) / 2)
      room.windows.push_back({middle.x() - start_m, 2 * half, opening.sill_m, opening.head_m});
  }
}

/// The row from lying[first] to lying[last - 1].
KnownRow make_row(const std::vector<Lying>& lying, std::size_t first, std::size_t last, const Space& space,
                  const Frame& frame, const Contents& contents, double wall_m, bool whole) {
  KnownRow row;
  row.space = space.id;
  row.hallway = space.hallway;
  row.whole = whole;
  const double length = (space.end - space.start).norm();
  const double row_start = whole ? 0 : lying[first].start_m;
  const double row_end = whole ? length : lying[last - 1].end_m;
  double start = row_start;
  for (std::size_t i = first; i < last; ++i) {
    const double middle = i + 1 < last ? (lying[i].end_m + lying[i + 1].start_m) / 2 : row_end + wall_m / 2;
    KnownRoom room;
    room.id = lying[i].room->id;
    room.type = lying[i].room->type;
    room.width_m = middle - wall_m / 2 - start;
    room.depth_m = lying[i].back_m - lying[i].front_m;
    room.doors_known = contents.doors_known;
    if (const auto found = contents.openings.find(room.id); found != contents.openings.end())
      add_openings(found->second, frame, lying[i], start, room);
    if (const auto found = contents.furniture.find(room.id); found != contents.furniture.end())
      for (const TrueFurniture* piece : found->second) room.furniture.push_back(piece->type);
    row.rooms.push_back(std::move(room));
    start = middle + wall_m / 2;
  }
  row.length_m = row_end - row_start;
  return row;
}

void add_rows(const Space& space, const std::vector<const TrueRoom*>& rooms, const Contents& contents,
              double wall_m, std::vector<KnownRow>& rows) {
  const Frame frame(space);
  std::vector<Lying> lying = rooms_along(space, frame, rooms);
  // Of two that lie side by side on the same stretch the narrower one is no room of the row.
  for (std::size_t i = 0; i + 1 < lying.size();) {
    const double lap = lying[i].end_m - lying[i + 1].start_m;
    const double a = lying[i].end_m - lying[i].start_m, b = lying[i + 1].end_m - lying[i + 1].start_m;
    if (lap > 0.5 * std::min(a, b))
      lying.erase(lying.begin() + static_cast<std::ptrdiff_t>(a < b ? i : i + 1));
    else
      ++i;
  }
  if (lying.empty()) return;
  const double length = (space.end - space.start).norm(), gap = wall_m + 0.6;
  std::vector<std::size_t> cuts = {0};
  for (std::size_t i = 0; i + 1 < lying.size(); ++i)
    if (lying[i + 1].start_m - lying[i].end_m > gap) cuts.push_back(i + 1);
  cuts.push_back(lying.size());
  const bool whole = cuts.size() == 2 && lying.front().start_m < 0.6 && lying.back().end_m > length - 0.6;
  for (std::size_t c = 0; c + 1 < cuts.size(); ++c) {
    KnownRow row = make_row(lying, cuts[c], cuts[c + 1], space, frame, contents, wall_m, whole);
    const bool sound =
        std::all_of(row.rooms.begin(), row.rooms.end(), [](const KnownRoom& r) { return r.width_m > 0.3; });
    if (sound) rows.push_back(std::move(row));
  }
}

std::vector<Space> spaces_of(const FloorGroundTruth& floor, const FloorTruth& truth,
                             const std::vector<const TrueRoom*>& rooms) {
  if (!floor.spaces.empty()) return floor.spaces;
  std::vector<Hallway> hallways = floor.hallways;
  if (hallways.empty())
    for (const TrueRoom& room : truth.rooms)
      if (room.type == "Hallway") hallways.push_back({room.id, room.name, room.outline});
  std::vector<TrueRoom> copies;
  for (const TrueRoom* room : rooms) copies.push_back(*room);
  std::vector<Vec2> doors;
  for (const TrueOpening& opening : truth.openings)
    if (opening.kind == "door") doors.push_back((opening.a + opening.b) / 2);
  std::vector<Space> spaces;
  for (const auto& row : contact_rows(hallway_contacts(hallways, copies, doors)))
    spaces.push_back(space_of_row(row, copies[static_cast<std::size_t>(row.front().room)].id,
                                  hallways[static_cast<std::size_t>(row.front().hallway)].id, {}, 0));
  return spaces;
}

}  // namespace

std::vector<KnownRow> known_rows(const FloorGroundTruth& floor, const FloorTruth& truth,
                                 double inner_wall_m) {
  std::set<std::string> given;
  for (const Hallway& hallway : floor.hallways) given.insert(hallway.id);
  for (const FixedRoom& room : floor.fixed) given.insert(room.id);
  std::vector<const TrueRoom*> rooms;
  for (const TrueRoom& room : truth.rooms)
    if (!given.contains(room.id) && room.type != "Hallway") rooms.push_back(&room);
  std::vector<KnownRow> rows;
  const Contents contents(truth);
  for (const Space& space : spaces_of(floor, truth, rooms))
    add_rows(space, rooms, contents, inner_wall_m, rows);
  for (KnownRow& row : rows) row.floor = floor.name;
  return rows;
}

std::vector<KnownRow> seen_parts(const KnownRow& row, const std::set<std::string>& unseen,
                                 double inner_wall_m) {
  std::vector<KnownRow> parts;
  bool goes_on = false;
  for (const KnownRoom& room : row.rooms) {
    if (unseen.contains(room.id)) {
      goes_on = false;
      continue;
    }
    if (!goes_on) {
      parts.push_back(row);
      parts.back().rooms.clear();
      parts.back().length_m = -inner_wall_m;
      parts.back().whole = false;
    }
    parts.back().rooms.push_back(room);
    parts.back().length_m += room.width_m + inner_wall_m;
    goes_on = true;
  }
  if (parts.size() == 1 && parts.front().rooms.size() == row.rooms.size()) return {row};
  return parts;
}

LearnData learn_data(const std::vector<FloorGroundTruth>& floors, const std::vector<FloorTruth>& truths,
                     const std::vector<std::set<std::string>>& unseen) {
  LearnData data;
  std::vector<double> inner, outer, heights;
  for (std::size_t i = 0; i < floors.size(); ++i) {
    if (floors[i].inner_wall_m) inner.push_back(*floors[i].inner_wall_m);
    if (floors[i].outer_wall_m) outer.push_back(*floors[i].outer_wall_m);
    if (floors[i].ceiling_height_m) heights.push_back(*floors[i].ceiling_height_m);
    for (const TrueRoom& room : truths[i].rooms)
      if (room.ceiling_m > room.floor_m) heights.push_back(room.ceiling_m - room.floor_m);
  }
  if (!inner.empty()) data.inner_wall_m = std::round(1000 * median(inner)) / 1000;
  if (!outer.empty()) data.outer_wall_m = std::round(1000 * median(outer)) / 1000;
  if (!heights.empty()) data.height_m = std::round(100 * median(heights)) / 100;
  for (std::size_t i = 0; i < floors.size(); ++i) {
    data.sources.push_back(floors[i].name);
    const std::set<std::string> none;
    for (const KnownRow& row : known_rows(floors[i], truths[i], data.inner_wall_m))
      for (KnownRow& part : seen_parts(row, i < unseen.size() ? unseen[i] : none, data.inner_wall_m))
        data.rows.push_back(std::move(part));
  }
  return data;
}

}  // namespace gramap
