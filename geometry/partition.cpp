#include "geometry/partition.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "geometry/overlay.h"
#include "geometry/polygon.h"
#include "geometry/segment_grid.h"
#include "geometry/sets.h"
#include "geometry/wall_cuts.h"

namespace gramap {
namespace {

/// Makes rooms that touch share their points: corners that nearly coincide become one, a corner that nearly
/// lies on another room's edge becomes a corner of that room too.
std::vector<Polygon> welded(std::vector<Polygon> rooms, double weld_m) {
  std::map<std::pair<long long, long long>, std::vector<Vec2>> corners;
  const auto key = [weld_m](double x) { return static_cast<long long>(std::floor(x / weld_m)); };
  SegmentGrid grid;
  std::vector<std::pair<int, int>> edge_of;
  for (Polygon& ring : rooms) {
    for (Vec2& p : ring) {
      const Vec2* twin = nullptr;
      for (long long dy = -1; dy <= 1; ++dy)
        for (long long dx = -1; dx <= 1; ++dx)
          if (const auto cell = corners.find({key(p.x()) + dx, key(p.y()) + dy}); cell != corners.end())
            for (const Vec2& q : cell->second)
              if ((q - p).norm() < weld_m) twin = &q;
      if (twin != nullptr)
        p = *twin;
      else
        corners[{key(p.x()), key(p.y())}].push_back(p);
    }
    ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
    while (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
  }
  for (int room = 0; room < static_cast<int>(rooms.size()); ++room)
    for (int i = 0; i < static_cast<int>(rooms[room].size()); ++i) {
      grid.add(rooms[room][i], rooms[room][(i + 1) % rooms[room].size()]);
      edge_of.emplace_back(room, i);
    }
  std::map<std::pair<int, int>, std::vector<Vec2>> on_edge;
  for (const Polygon& ring : rooms)
    for (const Vec2& p : ring)
      for (const int index : grid.near(p, p, weld_m)) {
        const auto [room, edge] = edge_of[index];
        const Vec2 a = rooms[room][edge], b = rooms[room][(edge + 1) % rooms[room].size()];
        if (p != a && p != b && distance_to_segment(p, a, b) < weld_m) on_edge[{room, edge}].push_back(p);
      }
  for (int room = 0; room < static_cast<int>(rooms.size()); ++room) {
    Polygon ring;
    for (int i = 0; i < static_cast<int>(rooms[room].size()); ++i) {
      const Vec2 a = rooms[room][i];
      ring.push_back(a);
      std::vector<Vec2>& between = on_edge[{room, i}];
      std::sort(between.begin(), between.end(),
                [&a](const Vec2& p, const Vec2& q) { return (p - a).norm() < (q - a).norm(); });
      between.erase(std::unique(between.begin(), between.end()), between.end());
      ring.insert(ring.end(), between.begin(), between.end());
    }
    rooms[room] = std::move(ring);
  }
  return rooms;
}

class Builder {
 public:
  explicit Builder(const PlanInput& input) : input_(input), rooms_(welded(input.rooms, input.weld_m)) {}

  Partition build() {
    rings_ = input_.outline;
    first_room_ = static_cast<int>(rings_.size());
    rings_.insert(rings_.end(), rooms_.begin(), rooms_.end());
    std::vector<bool> wall_on_left(rings_.size(), false);
    std::fill(wall_on_left.begin(), wall_on_left.begin() + first_room_, true);

    const WallFaces faces(rings_, wall_on_left, input_.thickest_wall_m);
    std::vector<Cut> cuts = faces.corner_cuts();
    opening_cuts(faces, cuts);
    share_landings(cuts, 1e-3);
    overlay_ = overlay(rings_, cuts);
    result_.points = overlay_.points;

    classify();
    find_neighbours();
    name_sides();
    mark_openings();
    gather_walls();
    sum_areas();
    result_.footprints = std::move(footprints_);
    return std::move(result_);
  }

  /// After build(): where all that is wrong with the plan are overlaps within `input.rounding_m`, takes them
  /// from the later room of each two in `rooms`. False when that is not so or cannot be done.
  bool give_way(std::vector<Polygon>& rooms) const {
    std::map<int, std::set<std::size_t>> lost;  // by room: what it loses of the overlay's cells
    for (std::size_t i = 0; i < overlay_.cells.size(); ++i) {
      const Overlay::Cell& cell = overlay_.cells[i];
      const auto first = std::lower_bound(cell.rings.begin(), cell.rings.end(), first_room_);
      if (cell.rings.end() - first < 2) continue;
      Polygon points;
      for (const Triangle& t : cell.triangles)
        for (const int p : t) points.push_back(overlay_.points[p]);
      if (oriented_box(points).breadth_m > input_.rounding_m) return false;
      for (auto ring = first + 1; ring != cell.rings.end(); ++ring) lost[*ring - first_room_].insert(i);
    }
    for (const auto& [room, cells] : lost) {
      std::vector<Triangle> kept;
      for (std::size_t i = 0; i < overlay_.cells.size(); ++i) {
        const Overlay::Cell& cell = overlay_.cells[i];
        if (!cells.contains(i) &&
            std::binary_search(cell.rings.begin(), cell.rings.end(), first_room_ + room))
          kept.insert(kept.end(), cell.triangles.begin(), cell.triangles.end());
      }
      const std::vector<Polygon> rings = border(overlay_.points, kept);
      if (rings.size() != 1) return false;
      rooms[room] = simplified(rings.front(), 1e-7);  // without the ends of cuts
    }
    return !lost.empty();
  }

 private:
  void fault(PlanFault::Kind kind, int a, int b, const Vec2& at, double area_m2) {
    result_.faults.push_back({kind, a, b, at, area_m2});
  }

  void opening_cuts(const WallFaces& faces, std::vector<Cut>& cuts) {
    for (const PlanOpening& opening : input_.openings) {
      const auto from = faces.across(faces.nearest(first_room_ + opening.room, opening.a));
      const auto to = faces.across(faces.nearest(first_room_ + opening.room, opening.b));
      footprints_.emplace_back();
      if (!from || !to) continue;
      cuts.push_back(*from);
      cuts.push_back(*to);
      footprints_.back() = {from->from.at, to->from.at, to->to.at, from->to.at};
    }
  }

  /// Rooms, and the wall region's cells for now all as walls.
  void classify() {
    for (const Overlay::Cell& piece : overlay_.cells) {
      PlanCell cell;
      cell.triangles = piece.triangles;
      cell.area_m2 = piece.area_m2;
      int within = 0;
      std::vector<int> rooms;
      for (const int ring : piece.rings) {
        if (ring >= first_room_)
          rooms.push_back(ring - first_room_);
        else
          within += signed_area(rings_[ring]) > 0 ? 1 : -1;
      }
      if (rooms.size() > 1) fault(PlanFault::Kind::overlap, rooms[0], rooms[1], piece.inside, piece.area_m2);
      if (within < 0 || within > 1)
        fault(PlanFault::Kind::crossing_outlines, -1, -1, piece.inside, piece.area_m2);
      if (within <= 0) {
        if (!rooms.empty())
          fault(PlanFault::Kind::outside_outline, rooms[0], -1, piece.inside, piece.area_m2);
        continue;  // in a courtyard or outside
      }
      if (!rooms.empty()) {
        cell.kind = PlanCell::Kind::room;
        cell.room = rooms[0];
      }
      result_.cells.push_back(std::move(cell));
      inside_.push_back(piece.inside);
    }
  }

  void find_neighbours() {
    std::map<std::pair<int, int>, int> cell_of;  // by directed edge
    for (int c = 0; c < static_cast<int>(result_.cells.size()); ++c)
      for (const Triangle& t : result_.cells[c].triangles)
        for (int k = 0; k < 3; ++k) cell_of[{t[k], t[(k + 1) % 3]}] = c;
    borders_.resize(result_.cells.size());
    for (const auto& [edge, cell] : cell_of) {
      const auto behind = cell_of.find({edge.second, edge.first});
      const int other = behind == cell_of.end() ? kOutside : behind->second;
      if (other != cell) borders_[cell].push_back({edge.first, edge.second, other});
    }
  }

  /// The room (or the outside) behind a border edge of a wall's cell; nothing for another wall.
  std::optional<int> side(int neighbour) const {
    if (neighbour == kOutside) return kOutside;
    const PlanCell& cell = result_.cells[neighbour];
    if (cell.kind == PlanCell::Kind::room) return cell.room;
    return std::nullopt;
  }

  /// How many separate stretches of a cell's border lie on rooms or the outside.
  int stretches(int c) const {
    std::map<int, int> next, behind;
    for (const Border& b : borders_[c]) next[b.from] = b.to, behind[b.from] = b.neighbour;
    std::map<int, int> before;
    for (const auto& [from, to] : next) before[to] = from;
    int count = 0;
    for (const auto& [from, neighbour] : behind) {
      if (!side(neighbour)) continue;
      const auto previous = before.find(from);
      if (previous == before.end() || !side(behind.at(previous->second)) ||
          *side(behind.at(previous->second)) != *side(neighbour))
        ++count;
    }
    return count;
  }

  void name_sides() {
    for (int c = 0; c < static_cast<int>(result_.cells.size()); ++c) {
      PlanCell& cell = result_.cells[c];
      std::set<int> touching;
      for (const Border& b : borders_[c]) {
        if (cell.kind == PlanCell::Kind::room && b.neighbour == kOutside)
          fault(PlanFault::Kind::zero_wall, cell.room, kOutside, result_.points[b.from], 0);
        if (const auto room = side(b.neighbour)) touching.insert(*room);
      }
      cell.touching.assign(touching.begin(), touching.end());
      if (cell.kind == PlanCell::Kind::room) continue;
      const int sides = static_cast<int>(touching.size());
      if (sides == 2 || (sides == 1 && stretches(c) == 2)) {
        cell.kind = PlanCell::Kind::wall;
        const int low = *touching.begin(), high = *touching.rbegin();
        cell.side_a = low == kOutside ? high : low;
        cell.side_b = low == kOutside ? kOutside : high;
      } else {
        cell.kind = PlanCell::Kind::junction;
      }
      if (is_mass(c)) cell.kind = PlanCell::Kind::mass;
    }
  }

  /// Thicker both ways than any wall.
  bool is_mass(int c) const {
    Polygon points;
    for (const Triangle& t : result_.cells[c].triangles)
      for (const int p : t) points.push_back(result_.points[p]);
    if (oriented_box(points).breadth_m <= input_.thickest_wall_m) return false;
    // A bent wall has a wide box, too, but little area for its border.
    double length = 0;
    for (const Border& b : borders_[c]) length += (result_.points[b.to] - result_.points[b.from]).norm();
    return 2 * result_.cells[c].area_m2 / length > input_.thickest_wall_m / 2;
  }

  void mark_openings() {
    SegmentGrid places;
    for (const Vec2& inside : inside_) places.add(inside, inside);
    for (int o = 0; o < static_cast<int>(footprints_.size()); ++o) {
      const Polygon& footprint = footprints_[o];
      const auto lost = [&](const Vec2& at) { fault(PlanFault::Kind::lost_opening, o, -1, at, 0); };
      if (footprint.empty()) {
        lost(input_.openings[o].a);
        continue;
      }
      int found = -1;
      for (const int c : places.near(footprint[0], footprint[2], 0.1))
        if (result_.cells[c].kind == PlanCell::Kind::wall && contains(footprint, inside_[c])) found = c;
      const double area = std::abs(signed_area(footprint));
      if (found < 0 || result_.cells[found].opening >= 0 ||
          std::abs(result_.cells[found].area_m2 - area) > 1e-6)
        lost(footprint.front()), footprints_[o].clear();
      else
        result_.cells[found].opening = o;
    }
  }

  void gather_walls() {
    Sets sets(result_.cells.size());
    for (int c = 0; c < static_cast<int>(result_.cells.size()); ++c) {
      const PlanCell& cell = result_.cells[c];
      if (cell.kind == PlanCell::Kind::room) continue;
      for (const Border& b : borders_[c]) {
        if (b.neighbour == kOutside) continue;
        const PlanCell& other = result_.cells[b.neighbour];
        if (other.kind == cell.kind && other.side_a == cell.side_a && other.side_b == cell.side_b)
          sets.join(c, b.neighbour);
      }
    }
    std::map<int, std::vector<int>> groups;
    for (int c = 0; c < static_cast<int>(result_.cells.size()); ++c)
      if (result_.cells[c].kind != PlanCell::Kind::room) groups[sets.find(c)].push_back(c);
    for (auto& [root, cells] : groups) result_.walls.push_back(make_wall(std::move(cells)));
    // By place, so that the order does not depend on how the triangulation was built.
    const auto place = [this](const Partition::Wall& wall) {
      Vec2 low = Vec2::Constant(1e300);
      for (const int c : wall.cells)
        for (const Triangle& t : result_.cells[c].triangles)
          for (const int p : t)
            if (std::pair(result_.points[p].x(), result_.points[p].y()) < std::pair(low.x(), low.y()))
              low = result_.points[p];
      return std::tuple(wall.kind, wall.side_a, wall.side_b, low.x(), low.y());
    };
    std::sort(result_.walls.begin(), result_.walls.end(),
              [&](const auto& a, const auto& b) { return place(a) < place(b); });
  }

  Partition::Wall make_wall(std::vector<int> cells) const {
    Partition::Wall wall;
    const PlanCell& first = result_.cells[cells.front()];
    wall.kind = first.kind;
    wall.side_a = first.side_a;
    wall.side_b = first.side_b;
    double area = 0, length = 0;
    for (const int c : cells) {
      area += result_.cells[c].area_m2;
      for (const Border& b : borders_[c])
        if (const auto room = side(b.neighbour)) {
          wall.faces.push_back({*room, result_.points[b.from], result_.points[b.to]});
          length += (result_.points[b.to] - result_.points[b.from]).norm();
        }
    }
    join_collinear(wall.faces);
    wall.cells = std::move(cells);
    if (wall.kind == PlanCell::Kind::wall) {
      wall.length_m = length / 2;
      wall.thickness_m = area / wall.length_m;
    }
    return wall;
  }

  /// Joins stretches of a face that follow one another straight on.
  static void join_collinear(std::vector<Partition::Face>& faces) {
    for (bool joined = true; joined;) {
      joined = false;
      for (std::size_t i = 0; i < faces.size() && !joined; ++i)
        for (std::size_t j = 0; j < faces.size() && !joined; ++j) {
          const Vec2 u = faces[i].b - faces[i].a, v = faces[j].b - faces[j].a;
          if (i == j || faces[i].side != faces[j].side || faces[i].b != faces[j].a) continue;
          if (u.dot(v) <= 0 || std::abs(u.x() * v.y() - u.y() * v.x()) > 1e-9 * u.norm() * v.norm()) continue;
          faces[i].b = faces[j].b;
          faces.erase(faces.begin() + static_cast<std::ptrdiff_t>(j));
          joined = true;
        }
    }
  }

  void sum_areas() {
    for (int ring = 0; ring < first_room_; ++ring) result_.outline_area_m2 += signed_area(rings_[ring]);
    for (const PlanCell& cell : result_.cells)
      (cell.kind == PlanCell::Kind::room ? result_.rooms_area_m2 : result_.walls_area_m2) += cell.area_m2;
    // Every ring is tiled by its cells, none of which lies in two rooms or outside: the parts make up the
    // outline.
    result_.exact =
        std::all_of(overlay_.tiled.begin(), overlay_.tiled.end(), [](bool tiled) { return tiled; });
    for (const PlanFault& f : result_.faults)
      if (f.kind == PlanFault::Kind::overlap || f.kind == PlanFault::Kind::outside_outline ||
          f.kind == PlanFault::Kind::crossing_outlines)
        result_.exact = false;
  }

  struct Border {
    int from, to;
    int neighbour;  ///< a cell, or kOutside
  };

  const PlanInput& input_;
  std::vector<Polygon> rooms_;
  std::vector<Polygon> rings_;  ///< outline rings, then rooms
  int first_room_ = 0;
  std::vector<Polygon> footprints_;  ///< of the openings; empty where none can be cut
  Overlay overlay_;
  std::vector<Vec2> inside_;                  ///< by cell
  std::vector<std::vector<Border>> borders_;  ///< by cell
  Partition result_;
};

}  // namespace

Partition partition(const PlanInput& input) {
  PlanInput plan = input;
  for (int round = 0;; ++round) {
    Builder builder(plan);
    Partition result = builder.build();
    // What gives way is rounded, too, and may overlap anew, by less.
    std::vector<Polygon> rooms = plan.rooms;
    if (result.faults.empty() || round == 3 || !builder.give_way(rooms)) return result;
    plan.rooms = std::move(rooms);
  }
}

std::vector<Polygon> outline_around(const std::vector<Polygon>& rooms, double wall_m) {
  std::vector<Polygon> wide;
  for (const Polygon& room : rooms) wide.push_back(grown(room, wall_m));
  const Overlay together = overlay(welded(std::move(wide), 1e-4), {});
  std::vector<Triangle> triangles;
  for (const Overlay::Cell& cell : together.cells)
    triangles.insert(triangles.end(), cell.triangles.begin(), cell.triangles.end());
  std::vector<Polygon> rings;
  for (const Polygon& ring : border(together.points, triangles)) {
    const bool hole = signed_area(ring) < 0;
    if (hole && -signed_area(ring) <= 4 * wall_m * wall_m) continue;
    // Rooms drawn by hand are never quite in line; a bend of less than a millimetre is no corner.
    rings.push_back(simplified(ring, 1e-3));
    if (hole) std::reverse(rings.back().begin(), rings.back().end());
  }
  return rings;
}

std::vector<Polygon> border(const std::vector<Vec2>& points, const std::vector<Triangle>& triangles) {
  // Where triangles lie on one another an edge is there twice: only so does every way round come to an end.
  std::multiset<std::pair<int, int>> edges;
  for (const Triangle& t : triangles)
    for (int k = 0; k < 3; ++k) {
      const auto behind = edges.find({t[(k + 1) % 3], t[k]});
      if (behind != edges.end())
        edges.erase(behind);
      else
        edges.insert({t[k], t[(k + 1) % 3]});
    }
  std::vector<Polygon> rings;
  while (!edges.empty()) {
    Polygon ring;
    auto edge = *edges.begin();
    const int start = edge.first;
    while (true) {
      edges.erase(edges.find(edge));
      ring.push_back(points[edge.first]);
      if (edge.second == start) break;
      // Where rings touch in a point, the sharpest turn to the right keeps them apart.
      auto next = edges.lower_bound({edge.second, -1});
      auto best = next;
      double least = 1e300;
      const Vec2 back = points[edge.first] - points[edge.second];
      for (; next != edges.end() && next->first == edge.second; ++next) {
        const Vec2 ahead = points[next->second] - points[next->first];
        double angle = std::atan2(back.x() * ahead.y() - back.y() * ahead.x(), back.dot(ahead));
        if (angle <= 0) angle += 2 * M_PI;
        if (2 * M_PI - angle < least) least = 2 * M_PI - angle, best = next;
      }
      edge = *best;
    }
    // Points on a straight line are the triangulation's, not the border's.
    Polygon corners;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vec2 u = ring[i] - ring[(i + ring.size() - 1) % ring.size()],
                 v = ring[(i + 1) % ring.size()] - ring[i];
      if (std::abs(u.x() * v.y() - u.y() * v.x()) > 1e-9 * u.norm() * v.norm()) corners.push_back(ring[i]);
    }
    rings.push_back(std::move(corners));
  }
  return rings;
}

bool areas_exact(const Partition& partition) {
  std::vector<Triangle> triangles;
  for (const PlanCell& cell : partition.cells)
    triangles.insert(triangles.end(), cell.triangles.begin(), cell.triangles.end());
  return tiles_exactly(partition.points, triangles);
}

std::optional<Vec2> stray_border(const std::vector<Vec2>& points, const std::vector<Triangle>& triangles,
                                 const std::vector<Polygon>& outline, double tolerance_m) {
  for (const Polygon& ring : border(points, triangles))
    for (const Vec2& p : ring)
      if (std::none_of(outline.begin(), outline.end(),
                       [&](const Polygon& o) { return distance_to_border(o, p) <= tolerance_m; }))
        return p;
  return std::nullopt;
}

}  // namespace gramap
