#include "perception/outline.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "geometry/polygon.h"
#include "perception/cells.h"
#include "perception/min_cut.h"

namespace gramap {

Vec2 crossing_of(const WallLine& a, const WallLine& b) {
  Eigen::Matrix2d normals;
  normals << a.normal.transpose(), b.normal.transpose();
  return normals.partialPivLu().solve(Vec2(a.rho_m, b.rho_m));
}

namespace {

struct CellEvidence {
  double area_m2 = 0;
  double seen_share = 0;
  bool has_scanner = false;
};

Polygon ring_of(const PlanCells& cells, const PlanCells::Cell& cell) {
  Polygon ring;
  for (const int corner : cell.corners) ring.push_back(cells.corners[static_cast<std::size_t>(corner)]);
  return ring;
}

/// Area and seen share of every cell, by the pixels whose centres lie in it.
std::vector<CellEvidence> look_into(const PlanCells& cells, const FreeSpace& space,
                                    const RegisteredCloud& cloud) {
  std::vector<CellEvidence> evidence;
  for (const PlanCells::Cell& cell : cells.cells) {
    const Polygon ring = ring_of(cells, cell);
    CellEvidence found;
    found.area_m2 = signed_area(ring);
    Vec2 low = ring.front(), high = ring.front();
    for (const Vec2& p : ring) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    const auto index = [&](double coordinate, double origin, int count) {
      return std::clamp(static_cast<int>((coordinate - origin) / space.pixel_m), 0, count - 1);
    };
    int pixels = 0, seen = 0;
    for (int row = index(low.y(), space.corner_m.y(), space.rows);
         row <= index(high.y(), space.corner_m.y(), space.rows); ++row)
      for (int column = index(low.x(), space.corner_m.x(), space.columns);
           column <= index(high.x(), space.corner_m.x(), space.columns); ++column) {
        if (!contains(ring, space.centre(column, row))) continue;
        ++pixels;
        seen += space.seen[static_cast<std::size_t>(row) * static_cast<std::size_t>(space.columns) +
                           static_cast<std::size_t>(column)];
      }
    found.seen_share = pixels ? static_cast<double>(seen) / pixels : 0;
    for (const RegisteredCloud::Part& part : cloud.parts)
      found.has_scanner |= contains(ring, part.scanner_m.head<2>());
    evidence.push_back(found);
  }
  return evidence;
}

/// The cells that are room: the side of the source of the minimum cut.
std::vector<bool> label(const PlanCells& cells, const std::vector<CellEvidence>& evidence,
                        const std::vector<WallLine>& lines, const OutlineOptions& options) {
  const std::size_t count = cells.cells.size(), source = count, sink = count + 1;
  MinCut graph(count + 2);
  for (std::size_t c = 0; c < count; ++c) {
    const CellEvidence& seen = evidence[c];
    graph.connect(source, c, seen.has_scanner ? 1e6 : seen.area_m2 * seen.seen_share, 0);
    graph.connect(c, sink, seen.area_m2 * (1 - seen.seen_share), 0);
    const PlanCells::Cell& cell = cells.cells[c];
    for (std::size_t i = 0; i < cell.corners.size(); ++i) {
      const int beyond = cell.neighbours[i];
      if (beyond < 0) {
        graph.connect(c, sink, 1e3, 0);  // the box is no wall
        continue;
      }
      if (beyond < static_cast<int>(c)) continue;
      const Vec2 &a = cells.corners[static_cast<std::size_t>(cell.corners[i])],
                 &b = cells.corners[static_cast<std::size_t>(cell.corners[(i + 1) % cell.corners.size()])];
      const double share = lines[static_cast<std::size_t>(cell.lines[i])].wall_share(a, b);
      const double cost = options.border_cost_m * (b - a).norm() * (1 - share);
      graph.connect(c, static_cast<std::size_t>(beyond), cost, cost);
    }
  }
  std::vector<bool> room = graph.source_side(source, sink);
  room.resize(count);
  return room;
}

/// Keeps the room's part that holds most scanners.
void keep_scanned_part(const PlanCells& cells, const std::vector<CellEvidence>& evidence,
                       std::vector<bool>& room) {
  std::vector<int> part(room.size(), -1);
  std::vector<double> score;
  for (std::size_t start = 0; start < room.size(); ++start) {
    if (!room[start] || part[start] >= 0) continue;
    const int id = static_cast<int>(score.size());
    score.push_back(0);
    std::vector<std::size_t> stack = {start};
    part[start] = id;
    while (!stack.empty()) {
      const std::size_t here = stack.back();
      stack.pop_back();
      score.back() += (evidence[here].has_scanner ? 1e6 : 0) + evidence[here].area_m2;
      for (const int next : cells.cells[here].neighbours)
        if (next >= 0 && room[static_cast<std::size_t>(next)] && part[static_cast<std::size_t>(next)] < 0) {
          part[static_cast<std::size_t>(next)] = id;
          stack.push_back(static_cast<std::size_t>(next));
        }
    }
  }
  if (score.empty()) return;
  const int best = static_cast<int>(std::max_element(score.begin(), score.end()) - score.begin());
  for (std::size_t c = 0; c < room.size(); ++c) room[c] = part[c] == best;
}

bool nearly_parallel(const WallLine& a, const WallLine& b) {
  return std::abs(a.normal.x() * b.normal.y() - a.normal.y() * b.normal.x()) < 0.17;
}

}  // namespace

void tidy(RoomOutline& outline, const std::vector<WallLine>& lines, double min_edge_m) {
  const auto line = [&](std::size_t edge) -> const WallLine& {
    return lines[static_cast<std::size_t>(outline.lines[edge])];
  };
  while (outline.lines.size() > 3) {
    const std::size_t n = outline.lines.size();
    std::size_t drop = n;
    for (std::size_t i = 0; i < n && drop == n; ++i) {
      const std::size_t before = (i + n - 1) % n, after = (i + 1) % n;
      if (outline.lines[i] == outline.lines[after]) {
        drop = after;
      } else if (nearly_parallel(line(i), line(after))) {
        const auto length = [&](std::size_t edge) {
          return (outline.ring[(edge + 1) % n] - outline.ring[edge]).norm();
        };
        const std::size_t weak = length(i) < length(after) ? i : after, strong = weak == i ? after : i;
        const double far = std::max(std::abs(line(strong).distance(outline.ring[weak])),
                                    std::abs(line(strong).distance(outline.ring[(weak + 1) % n])));
        if (far < min_edge_m) drop = weak;
      } else if ((outline.ring[after] - outline.ring[i]).norm() < min_edge_m) {
        if (nearly_parallel(line(before), line(after)))
          outline.lines[line(before).support < line(after).support ? before : after] =
              outline.lines[line(before).support < line(after).support ? after : before];
        drop = i;
      }
    }
    if (drop == n) return;
    outline.lines.erase(outline.lines.begin() + static_cast<std::ptrdiff_t>(drop));
    const std::size_t m = outline.lines.size();
    outline.ring.resize(m);
    for (std::size_t i = 0; i < m; ++i) {
      const WallLine &a = line((i + m - 1) % m), &b = line(i);
      if (outline.lines[(i + m - 1) % m] != outline.lines[i]) outline.ring[i] = crossing_of(a, b);
    }
  }
}

RoomOutline room_outline(const std::vector<WallLine>& lines, const FreeSpace& space,
                         const RegisteredCloud& cloud, const OutlineOptions& options) {
  RoomOutline outline;
  if (lines.size() < 3 || space.columns == 0) return outline;
  std::vector<PlanLine> cuts;
  for (const WallLine& line : lines) cuts.push_back({line.normal, line.rho_m});
  const Vec2 margin = Vec2::Constant(0.5);
  const Vec2 high = space.corner_m + space.pixel_m * Vec2(space.columns, space.rows);
  const PlanCells cells = cut_into_cells(space.corner_m - margin, high + margin, cuts);
  const std::vector<CellEvidence> evidence = look_into(cells, space, cloud);
  std::vector<bool> room = label(cells, evidence, lines, options);
  keep_scanned_part(cells, evidence, room);

  // The border's edges, chained into rings; where two rings touch in a corner either order closes both.
  struct Edge {
    int to, line;
  };
  std::multimap<int, Edge> from;
  for (std::size_t c = 0; c < cells.cells.size(); ++c) {
    if (!room[c]) continue;
    const PlanCells::Cell& cell = cells.cells[c];
    for (std::size_t i = 0; i < cell.corners.size(); ++i) {
      const int beyond = cell.neighbours[i];
      if (beyond >= 0 && room[static_cast<std::size_t>(beyond)]) continue;
      from.emplace(cell.corners[i], Edge{cell.corners[(i + 1) % cell.corners.size()], cell.lines[i]});
    }
  }
  struct Ring {
    std::vector<int> corners, lines;
    double area_m2 = 0;
  };
  std::vector<Ring> rings;
  while (!from.empty()) {
    Ring ring;
    Polygon points;
    auto at = from.begin();
    while (at != from.end()) {
      ring.corners.push_back(at->first);
      ring.lines.push_back(at->second.line);
      points.push_back(cells.corners[static_cast<std::size_t>(at->first)]);
      const int next = at->second.to;
      from.erase(at);
      at = from.find(next);
    }
    ring.area_m2 = signed_area(points);
    rings.push_back(ring);
  }
  if (rings.empty()) return outline;
  const Ring& outer = *std::max_element(rings.begin(), rings.end(),
                                        [](const Ring& a, const Ring& b) { return a.area_m2 < b.area_m2; });
  for (const Ring& ring : rings)
    if (ring.area_m2 < -0.02) {
      char text[100];
      std::snprintf(text, sizeof text,
                    "a column of %.2f m² stands free in the room; the outline leaves it out", -ring.area_m2);
      outline.remarks.push_back(text);
    }
  const std::size_t n = outer.corners.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (outer.lines[i] < 0) return {};  // the room runs into the box: nothing encloses it
    if (outer.lines[i] == outer.lines[(i + n - 1) % n]) continue;
    outline.lines.push_back(outer.lines[i]);
    outline.ring.push_back(cells.corners[static_cast<std::size_t>(outer.corners[i])]);
  }
  tidy(outline, lines, options.min_edge_m);
  return outline;
}

}  // namespace gramap
