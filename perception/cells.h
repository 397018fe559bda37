// The cells that straight lines cut a box in the plan into.
//
// Every line runs through the whole box, so every cell is convex and is found by cutting; corners are
// computed once per pair of lines, so that all cells agree on them.
#pragma once

#include <vector>

#include "geometry/types.h"

namespace gramap {

struct PlanLine {
  Vec2 normal = Vec2::UnitX();
  double rho_m = 0;
};

struct PlanCells {
  struct Cell {
    std::vector<int> corners;     ///< into `corners`, counter-clockwise
    std::vector<int> lines;       ///< the line of the edge from corner i to corner i+1; below 0: the box
    std::vector<int> neighbours;  ///< the cell beyond that edge; -1: none
  };
  std::vector<Vec2> corners;
  std::vector<Cell> cells;
};

PlanCells cut_into_cells(const Vec2& low, const Vec2& high, const std::vector<PlanLine>& lines);

}  // namespace gramap
