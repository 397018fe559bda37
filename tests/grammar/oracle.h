// Every layout of a small space, one by one, straight from the meaning of the rules: no automaton, no tables.
// Slow and simple on purpose; the fit has to agree with it.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "grammar/evidence.h"
#include "grammar/grid.h"
#include "grammar/rules.h"
#include "grammar/space.h"

namespace gramap::test {

/// All layouts of one sequence of types.
struct OracleSequence {
  double weight = 0;                 // summed over layouts and associations
  double best_layout = 0;            // the largest weight of one layout with one association
  std::vector<double> x, xx, w, ww;  // by element: moments of start and clear width, weighted
};

struct OracleResult {
  double total = 0;
  std::map<std::string, OracleSequence> sequences;
  /// [type + 1][cell]: weight of layouts in which a room of the type covers the cell (without units only)
  std::vector<std::vector<double>> coverage;
  long layouts = 0;
};

/// A room whose like is looked for: a type, a cell that it covers, gross width in cells (to `tolerance`).
struct OracleRoom {
  int type = 0, middle = 0, width = 0, tolerance = 0;
  double weight = 0;        // of the layouts that have one
  double square_cells = 0;  // weighted: how far the width of what covers the middle is off, squared
};

/// What is asked of the layouts beside their sums.
struct OracleQuestions {
  std::vector<OracleRoom> rooms;
  /// Cells, and weighted: how far the nearest wall is from them, squared, in cells.
  std::vector<std::pair<int, double>> walls;
};

/// None when there are more layouts than `most`.
std::optional<OracleResult> enumerate_layouts(const RuleSet& rules, const SpaceProblem& problem,
                                              const Evidence& evidence, const Grid& grid, long most,
                                              OracleQuestions* wanted = nullptr);

}  // namespace gramap::test
