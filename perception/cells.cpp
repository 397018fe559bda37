#include "perception/cells.h"

#include <map>

namespace gramap {
namespace {

Vec2 crossing(const PlanLine& a, const PlanLine& b) {
  const double determinant = a.normal.x() * b.normal.y() - a.normal.y() * b.normal.x();
  return Vec2(a.rho_m * b.normal.y() - b.rho_m * a.normal.y(),
              a.normal.x() * b.rho_m - b.normal.x() * a.rho_m) /
         determinant;
}

}  // namespace

PlanCells cut_into_cells(const Vec2& low, const Vec2& high, const std::vector<PlanLine>& lines) {
  // Lines 0 to 3 here are the box.
  std::vector<PlanLine> all = {
      {Vec2(0, 1), low.y()}, {Vec2(1, 0), high.x()}, {Vec2(0, 1), high.y()}, {Vec2(1, 0), low.x()}};
  all.insert(all.end(), lines.begin(), lines.end());

  PlanCells result;
  std::map<std::pair<int, int>, int> corner_of;
  const auto corner = [&](int a, int b) {
    const auto [it, is_new] =
        corner_of.try_emplace(std::minmax(a, b), static_cast<int>(result.corners.size()));
    if (is_new)
      result.corners.push_back(crossing(all[static_cast<std::size_t>(a)], all[static_cast<std::size_t>(b)]));
    return it->second;
  };
  using Cell = PlanCells::Cell;
  result.cells.push_back({{corner(3, 0), corner(0, 1), corner(1, 2), corner(2, 3)}, {0, 1, 2, 3}, {}});

  for (int line = 4; line < static_cast<int>(all.size()); ++line) {
    const PlanLine& knife = all[static_cast<std::size_t>(line)];
    std::vector<Cell> next;
    for (Cell& cell : result.cells) {
      const std::size_t n = cell.corners.size();
      std::vector<bool> beyond(n);
      for (std::size_t i = 0; i < n; ++i)
        beyond[i] = knife.normal.dot(result.corners[static_cast<std::size_t>(cell.corners[i])]) > knife.rho_m;
      std::size_t enters = n, leaves = n, changes = 0;
      for (std::size_t i = 0; i < n; ++i)
        if (beyond[i] != beyond[(i + 1) % n]) {
          ++changes;
          (beyond[i] ? leaves : enters) = i;
        }
      if (changes != 2) {  // not cut (or only by rounding, in a sliver)
        next.push_back(std::move(cell));
        continue;
      }
      const int in = corner(cell.lines[enters], line), out = corner(cell.lines[leaves], line);
      Cell far, near;
      far.corners.push_back(in);
      far.lines.push_back(cell.lines[enters]);
      for (std::size_t i = (enters + 1) % n;; i = (i + 1) % n) {
        far.corners.push_back(cell.corners[i]);
        far.lines.push_back(cell.lines[i]);
        if (i == leaves) break;
      }
      far.corners.push_back(out);
      far.lines.push_back(line);
      near.corners.push_back(out);
      near.lines.push_back(cell.lines[leaves]);
      for (std::size_t i = (leaves + 1) % n;; i = (i + 1) % n) {
        near.corners.push_back(cell.corners[i]);
        near.lines.push_back(cell.lines[i]);
        if (i == enters) break;
      }
      near.corners.push_back(in);
      near.lines.push_back(line);
      next.push_back(std::move(far));
      next.push_back(std::move(near));
    }
    result.cells = std::move(next);
  }

  std::map<std::pair<int, int>, int> cell_left_of;
  for (std::size_t c = 0; c < result.cells.size(); ++c) {
    const Cell& cell = result.cells[c];
    for (std::size_t i = 0; i < cell.corners.size(); ++i)
      cell_left_of[{cell.corners[i], cell.corners[(i + 1) % cell.corners.size()]}] = static_cast<int>(c);
  }
  for (Cell& cell : result.cells)
    for (std::size_t i = 0; i < cell.corners.size(); ++i) {
      const auto beyond = cell_left_of.find({cell.corners[(i + 1) % cell.corners.size()], cell.corners[i]});
      cell.neighbours.push_back(beyond == cell_left_of.end() ? -1 : beyond->second);
      cell.lines[i] -= 4;
    }
  return result;
}

}  // namespace gramap
