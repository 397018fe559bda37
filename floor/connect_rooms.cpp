#include "floor/connect_rooms.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "floor/reachable.h"
#include "geometry/polygon.h"

namespace gramap {
namespace {

constexpr double kWidth_m = 0.9;
constexpr double kHead_m = 2.1;
constexpr double kMargin_m = 0.05;  // least wall beside a door

/// Where a door can be: a stretch of a room's outline, counter-clockwise, that another place faces.
struct SharedWall {
  Vec2 a, b;
  std::size_t other = 0;  ///< the place behind it
  bool same_unit = false;
  double length_m() const { return (b - a).norm(); }
};

enum class Partner { entrance, same_unit, hallway, any };

Vec2 outward(const Vec2& a, const Vec2& b) {
  const Vec2 along = (b - a).normalized();
  return {along.y(), -along.x()};
}

/// Whether a room's stretch of its space's reference line holds another's.
bool spans(const FittedRoom& outer, const FittedRoom& inner) {
  constexpr double kSlack_m = 0.02;
  return outer.space == inner.space && outer.start_m <= inner.start_m + kSlack_m &&
         outer.start_m + outer.width_m >= inner.start_m + inner.width_m - kSlack_m;
}

class Floor {
 public:
  explicit Floor(FittedFloor& fitted) : fitted_(fitted), reach_m_(2 * fitted.inner_wall_m + 0.05) {
    for (auto* list : {&fitted.hallways, &fitted.fixed, &fitted.rooms})
      for (FittedRoom& room : *list) places_.push_back(&room);
    for (const FittedRoom* place : places_) {
      boxes_.emplace_back();
      for (const Vec2& p : place->outline) boxes_.back().extend(p);
    }
    hallways_ = fitted.hallways.size();
  }

  void connect() {
    for (FittedRoom& room : fitted_.rooms)
      for (FittedOpening& opening : room.openings)
        if (opening.kind == "door" && opening.origin == Origin::derived) move_beside_walls(room, opening);
    for (const FittedRoom* room : places_) {
      if (has_door(*room)) entrances_.insert(room->id);
      for (const FittedOpening& opening : room->openings)
        if (opening.kind == "door")
          if (const std::string other = behind(opening); !other.empty())
            passages_.emplace_back(room->id, other);
    }
    // Rooms without any door first: those whose doors lead to one of them are then reached as well.
    for (const bool doorless : {true, false})
      for (const Partner partner : {Partner::entrance, Partner::same_unit, Partner::hallway, Partner::any})
        while (connect_one(doorless, partner)) continue;
  }

 private:
  /// False when no room is left that could be given a door.
  bool connect_one(bool doorless, Partner partner) {
    const std::set<std::string> closed = closed_rooms();
    for (FittedRoom& room : fitted_.rooms) {
      if (room.origin != Origin::derived || !closed.contains(room.id) || (doorless && has_door(room)))
        continue;
      std::optional<SharedWall> best;
      for (const SharedWall& wall : shared_walls(room)) {
        if (wall.length_m() < kWidth_m) continue;
        const FittedRoom& other = *places_[wall.other];
        if (closed.contains(other.id) || (partner == Partner::hallway && wall.other >= hallways_) ||
            (partner <= Partner::same_unit && !wall.same_unit) ||
            (partner == Partner::entrance && !entrances_.contains(other.id)))
          continue;
        if (!best || wall.length_m() > best->length_m()) best = wall;
      }
      if (!best) continue;
      const Vec2 middle = (best->a + best->b) / 2, half = (best->b - best->a).normalized() * (kWidth_m / 2);
      room.openings.push_back({"door", Origin::derived, middle - half, middle + half, 0,
                               std::min(kHead_m, room.height_m - 0.1), 1});
      passages_.emplace_back(room.id, places_[best->other]->id);
      return true;
    }
    return false;
  }

  /// Rooms behind one another belong together, and so do rooms side by side before or behind a third.
  bool same_unit(const FittedRoom& a, const FittedRoom& b) const {
    return !b.space.empty() &&
           std::any_of(fitted_.rooms.begin(), fitted_.rooms.end(),
                       [&](const FittedRoom& whole) { return spans(whole, a) && spans(whole, b); });
  }

  std::set<std::string> closed_rooms() const {
    std::vector<std::string> ids, from{"outside"};
    for (std::size_t i = 0; i < places_.size(); ++i) {
      ids.push_back(places_[i]->id);
      if (i < hallways_) from.push_back(places_[i]->id);
    }
    const std::vector<std::string> list = unreachable(ids, passages_, from);
    return {list.begin(), list.end()};
  }

  /// The place a door leads to: a room's id, "outside", or nothing where there is only wall.
  std::string behind(const FittedOpening& door) const {
    const Vec2 middle = (door.a + door.b) / 2, out = outward(door.a, door.b),
               beyond = middle + out * (reach_m_ + 0.02);
    for (const FittedRoom* room : places_)
      if (contains(room->outline, beyond)) return room->id;
    const Polygon& outline = fitted_.floor.outline;
    return outline.empty() || !contains(outline, middle + out * (1.5 * fitted_.outer_wall_m + 0.05))
               ? "outside"
               : "";
  }

  /// The stretches of a room's outline that face other places across a wall, less margins.
  const std::vector<SharedWall>& shared_walls(const FittedRoom& room) {
    const auto [entry, is_new] = walls_.try_emplace(&room);
    if (!is_new) return entry->second;
    Eigen::AlignedBox2d near;
    for (const Vec2& p : room.outline) near.extend(p);
    near.min() -= Vec2::Constant(reach_m_);
    near.max() += Vec2::Constant(reach_m_);
    for (std::size_t place = 0; place < places_.size(); ++place) {
      if (places_[place] == &room || !near.intersects(boxes_[place])) continue;
      const std::size_t before = entry->second.size();
      add_walls(room.outline, place, entry->second);
      if (entry->second.size() == before || !same_unit(room, *places_[place])) continue;
      for (std::size_t i = before; i < entry->second.size(); ++i) entry->second[i].same_unit = true;
    }
    return entry->second;
  }

  void add_walls(const Polygon& outline, std::size_t place, std::vector<SharedWall>& walls) const {
    const Polygon& facing = places_[place]->outline;
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const Vec2 &a = outline[i], &b = outline[(i + 1) % outline.size()];
      const Vec2 along = (b - a).normalized(), out = outward(a, b);
      for (std::size_t j = 0; j < facing.size(); ++j) {
        const Vec2 &c = facing[j], &d = facing[(j + 1) % facing.size()];
        const double apart_m = (c - a).dot(out);
        if (apart_m <= 0 || apart_m > reach_m_ || (d - c).normalized().dot(along) > -0.999) continue;
        const double from_m = std::max(0.0, (d - a).dot(along)) + kMargin_m,
                     to_m = std::min((b - a).norm(), (c - a).dot(along)) - kMargin_m;
        if (to_m > from_m) walls.push_back({a + along * from_m, a + along * to_m, place, false});
      }
    }
  }

  /// A door that does not face one place alone moves to the nearest stretch beside it that does, before
  /// a hallway if it can.
  void move_beside_walls(const FittedRoom& room, FittedOpening& door) {
    const std::string leads_to = behind(door);
    if (leads_to == "outside") return;
    const Vec2 along = (door.b - door.a).normalized();
    const double width_m = (door.b - door.a).norm();
    std::optional<std::pair<bool, double>> best;  // not a hallway, and how far to move
    double shift_m = 0;
    for (const SharedWall& wall : shared_walls(room)) {
      if (wall.length_m() < width_m || outward(wall.a, wall.b).dot(outward(door.a, door.b)) < 0.999 ||
          std::abs((wall.a - door.a).dot(outward(door.a, door.b))) > 0.01)
        continue;
      const double back_m = (wall.a - door.a).dot(along), ahead_m = (wall.b - door.b).dot(along);
      if (back_m <= kMargin_m && ahead_m >= -kMargin_m) return;  // as it is, it faces this place alone
      const double move_m = back_m > 0 ? back_m : ahead_m;
      const std::pair rank(wall.other >= hallways_, std::abs(move_m));
      if ((!leads_to.empty() && std::abs(move_m) > width_m) || (best && *best <= rank)) continue;
      best = rank;
      shift_m = move_m;
    }
    door.a += along * shift_m;
    door.b += along * shift_m;
  }

  FittedFloor& fitted_;
  double reach_m_;
  std::vector<FittedRoom*> places_;  ///< hallways first, then fixed rooms and rooms
  std::vector<Eigen::AlignedBox2d> boxes_;
  std::size_t hallways_ = 0;
  std::map<const FittedRoom*, std::vector<SharedWall>> walls_;  ///< of the rooms asked for so far
  std::set<std::string> entrances_;                             ///< what had a door from the first
  std::vector<std::pair<std::string, std::string>> passages_;   ///< what lies at both sides of each door
};

}  // namespace

void connect_rooms(FittedFloor& fitted) {
  Floor(fitted).connect();
}

}  // namespace gramap
