#include "grammar/explanation.h"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <limits>

namespace gramap {
namespace {

constexpr double kLeastWidth_m = 0.01;
constexpr double kHoldSd_m = 0.001;  // of widths held at their least, and of the hold itself
constexpr double kFreeSd_m = 100;    // of widths of which nothing is known: they stay near the grid's

Explained best_reading(const Lattice& lattice, const PathStep& step, int j) {
  const Evidence& evidence = lattice.evidence();
  const PreparedEvidence& e = evidence.rooms()[static_cast<std::size_t>(j)];
  const Element& element = placed_element(lattice, step);
  Explained best{j, Reading::aside, 0};
  double most = -1;
  for (std::size_t r = 0; r < element.rooms.size(); ++r) {
    const Extent room = room_extent(lattice.grid(), step.cell, step.width, element.rooms[r]);
    for (const Reading how : {Reading::whole, Reading::swapped, Reading::start_only, Reading::end_only}) {
      const double weight = evidence.reading(e, how, room) * evidence.type_factor(e, element.rooms[r].type);
      if (weight <= most) continue;
      most = weight;
      best.how = how;
      best.room = static_cast<int>(r);
    }
  }
  return best;
}

/// A linear least-squares problem over wall positions, term by term: ((a x_i + b x_j - value) / sd)^2.
class WallProblem {
 public:
  explicit WallProblem(const std::vector<double>& grid_starts)
      : starts_(grid_starts), unknowns_(static_cast<int>(grid_starts.size()) - 2) {
    rhs_ = Eigen::VectorXd::Zero(unknowns_);
  }

  void add(std::size_t i, double a, std::size_t j, double b, double value, double sd) {
    const double weight = 1 / (sd * sd);
    const std::size_t at[2] = {i, j};
    const double factor[2] = {a, b};
    for (int p = 0; p < 2; ++p)
      if (!is_unknown(at[p])) value -= factor[p] * starts_[at[p]];
    for (int p = 0; p < 2; ++p) {
      if (!is_unknown(at[p]) || factor[p] == 0) continue;
      rhs_[row(at[p])] += weight * factor[p] * value;
      for (int q = 0; q < 2; ++q)
        if (is_unknown(at[q]) && factor[q] != 0)
          entries_.emplace_back(row(at[p]), row(at[q]), weight * factor[p] * factor[q]);
    }
  }

  std::vector<double> solve() const {
    std::vector<double> solved = starts_;
    if (unknowns_ <= 0) return solved;
    Eigen::SparseMatrix<double> matrix(unknowns_, unknowns_);
    matrix.setFromTriplets(entries_.begin(), entries_.end());
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factored(matrix);
    const Eigen::VectorXd x = factored.solve(rhs_);
    for (int i = 0; i < unknowns_; ++i) solved[static_cast<std::size_t>(i) + 1] = x[i];
    return solved;
  }

 private:
  bool is_unknown(std::size_t i) const { return i > 0 && i + 1 < starts_.size(); }
  static int row(std::size_t i) { return static_cast<int>(i) - 1; }

  const std::vector<double>& starts_;
  int unknowns_;
  Eigen::VectorXd rhs_;
  std::vector<Eigen::Triplet<double>> entries_;
};

const Normal& fitting_component(const Mixture& mixture, double width_m) {
  const Mixture::Component* best = &mixture.components.front();
  double most = -std::numeric_limits<double>::infinity();
  for (const Mixture::Component& c : mixture.components) {
    const double u = (width_m - c.normal.mean_m) / c.normal.sd_m;
    const double fit = std::log(c.weight / c.normal.sd_m) - 0.5 * u * u;
    if (fit <= most) continue;
    most = fit;
    best = &c;
  }
  return best->normal;
}

void add_width_prior(WallProblem& problem, const Lattice& lattice, const PathStep& step, std::size_t i) {
  const Grid& grid = lattice.grid();
  const Element& element = placed_element(lattice, step);
  const double width_m = grid.width_m(step.width);
  switch (element.kind) {
    case Element::Width::mixture: {
      const Normal& normal = fitting_component(element.mixture, width_m);
      problem.add(i, -1, i + 1, 1, normal.mean_m + grid.wall_m, normal.sd_m);
      return;
    }
    case Element::Width::uniform:
      problem.add(i, -1, i + 1, 1, width_m + grid.wall_m, kFreeSd_m);
      return;
    case Element::Width::share: {
      // width = share(gross end - start - wall)
      const double whole = grid.cells * grid.step_m - grid.wall_m;
      problem.add(i, -1 + element.share.slope, i + 1, 1,
                  element.share.constant + element.share.slope * whole + grid.wall_m, element.share_sd_m);
      return;
    }
  }
}

/// Position of a room's wall = p * (element's start) + q * (next element's start) + constant.
struct WallPosition {
  double start = 1;
  double next = 0;
  double constant = 0;
};

WallPosition wall_position(const Affine& offset, double wall_m) {
  return {1 - offset.slope, offset.slope, offset.constant - offset.slope * wall_m};
}

void add_evidence(WallProblem& problem, const Lattice& lattice, const PathStep& step,
                  const Explained& explained, std::size_t i) {
  const PreparedEvidence& e = lattice.evidence().rooms()[static_cast<std::size_t>(explained.evidence)];
  const double wall_m = lattice.grid().wall_m;
  const ElementRoom& room = placed_element(lattice, step).rooms[static_cast<std::size_t>(explained.room)];
  WallPosition start = wall_position(room.start, wall_m);
  WallPosition end =
      wall_position({room.start.constant + room.width.constant, room.start.slope + room.width.slope}, wall_m);
  if (explained.how == Reading::opens) start = wall_position({0, 0}, wall_m);
  if (explained.how == Reading::closes) end = wall_position({0, 1}, wall_m);
  const auto add = [&](double a, double b, double value, double sd) {
    problem.add(i, a * start.start + b * end.start, i + 1, a * start.next + b * end.next,
                value - a * start.constant - b * end.constant, sd);
  };
  switch (explained.how) {
    case Reading::whole:
    case Reading::swapped:
      if (explained.how == Reading::whole) add(-1, 1, e.width_m, e.width_sd_m);
      if (explained.how == Reading::swapped) add(-1, 1, e.other_m, e.other_sd_m);
      if (e.has_centre) add(0.5, 0.5, e.centre_m, e.centre_sd_m);
      return;
    case Reading::start_only:
    case Reading::opens:
      add(1, 0, e.start_wall_m(), e.wall_sd_m);
      return;
    case Reading::end_only:
    case Reading::closes:
      add(0, 1, e.end_wall_m(), e.wall_sd_m);
      return;
    case Reading::aside:
      return;
  }
}

}  // namespace

const Element& placed_element(const Lattice& lattice, const PathStep& step) {
  const Arc& arc = lattice.arcs(step.state, step.cell)[static_cast<std::size_t>(step.arc)];
  return lattice.row().elements[static_cast<std::size_t>(arc.element)];
}

std::vector<std::vector<Explained>> explain(const Lattice& lattice, const std::vector<PathStep>& path) {
  std::vector<std::vector<Explained>> all;
  for (const PathStep& step : path) {
    std::vector<Explained>& explained = all.emplace_back();
    if (step.matched < 0) continue;
    if (step.evidence_state % 2 == 1) {
      explained.push_back({step.matched, Reading::closes, 0});
      continue;
    }
    for (int j = step.evidence_state / 2; j <= step.matched; ++j) {
      const PreparedEvidence& e = lattice.evidence().rooms()[static_cast<std::size_t>(j)];
      if (j == step.matched && step.target_evidence == 2 * j + 1) {
        explained.push_back({j, Reading::opens, 0});
        continue;
      }
      const bool near = e.first_start <= step.cell && step.cell <= e.last_start;
      const double weight =
          near ? belongs(lattice, step.cell, step.width, placed_element(lattice, step), e) : 0;
      if (j == step.matched || e.again * weight > e.aside)
        explained.push_back(best_reading(lattice, step, j));
    }
  }
  return all;
}

std::vector<double> refine(const Lattice& lattice, const std::vector<PathStep>& path,
                           const std::vector<std::vector<Explained>>& explained) {
  const Grid& grid = lattice.grid();
  std::vector<double> starts;
  for (const PathStep& step : path) starts.push_back(grid.position_m(step.cell));
  starts.push_back(grid.cells * grid.step_m);

  std::vector<bool> held(path.size(), false);
  for (std::size_t trial = 0; trial <= path.size(); ++trial) {
    WallProblem problem(starts);
    for (std::size_t i = 0; i < path.size(); ++i) {
      add_width_prior(problem, lattice, path[i], i);
      for (const Explained& e : explained[i]) add_evidence(problem, lattice, path[i], e, i);
      if (held[i]) problem.add(i, -1, i + 1, 1, kLeastWidth_m + grid.wall_m, kHoldSd_m);
    }
    const std::vector<double> solved = problem.solve();
    bool positive = true;
    for (std::size_t i = 0; i < path.size(); ++i) {
      const double width_m = solved[i + 1] - solved[i] - grid.wall_m;
      if (width_m > 0) continue;
      if (held[i]) return starts;  // even held it does not stay positive: the grid's widths do
      positive = false;
      held[i] = true;
    }
    if (positive) return solved;
  }
  return starts;
}

}  // namespace gramap
