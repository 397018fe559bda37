// The layouts of a space and their evidence as one lattice: nodes (cell n, row state, evidence state), edges
// = one element placed from cell n to a later one. An edge's weight is the probability of the derivation's
// steps x the element's width mass x the doors in it x the evidence that it explains; a path's weight is the
// joint probability of layout, association and evidence. Every algorithm of the fit and of derivation is a
// pass over these edges.
//
// Evidence state 2j: evidence j is the next one to explain; 2j+1: the last room and the next one were read as
// evidence j together. A room explains none, one or several of the next evidences, the last of them for sure;
// those skipped on the way belong to no room. Evidence that no room starting at a cell or later can explain
// is skipped there, so that each association is exactly one path.
#pragma once

#include <deque>
#include <utility>
#include <vector>

#include "grammar/evidence.h"
#include "grammar/row.h"

namespace gramap {

/// Probability masses of an element's gross widths first, first + stride, first + 2 stride, …, in cells.
struct WidthMass {
  int first = 1;
  std::vector<double> mass;
  int stride = 1;
  int last() const { return first + stride * (static_cast<int>(mass.size()) - 1); }
};

inline constexpr double kMassSigmas = 5;

/// The mass of a mixture of normals, each cut off at kMassSigmas and none narrower than half a step (so that
/// means survive the rounding); in stretches without gaps.
std::vector<WidthMass> mixture_mass(const Mixture& mixture, const Grid& grid);

/// Edges of one element from one node to one evidence state: target cells first_cell + i * stride.
struct Move {
  int target_evidence = 0;
  int first_cell = 0;
  int stride = 1;
  int count = 0;
  const double* sum = nullptr;  ///< weights with the associations inside added up,
  const double* max = nullptr;  ///< or with the best of them
  int matched = -1;             ///< the last evidence that the room explains (or opens, closes); -1: none

  int last_cell() const { return first_cell + stride * (count - 1); }
};

/// Cells that are worth a look, by evidence state; see `Lattice::restrict`.
struct NodeMask {
  std::vector<std::vector<bool>> alive;  // [evidence state][cell - first cell of the state]
};

/// Widths of an element at a cell, with the likelihood of the doors: those that end where something is alive.
struct Prior {
  struct Stretch {
    int first = 1;
    int stride = 1;
    int count = 0;
    const double* mass = nullptr;
  };
  std::vector<Stretch> stretches;
  /// What the stretches point to, where it is not the same for all cells.
  std::vector<WidthMass> made;
  std::vector<double> seen;  ///< with doors
};

/// Not for several threads at once: what one pass has worked out is kept for the next.
class Lattice {
 public:
  /// How often its edges are asked for: what is asked for once only is not kept.
  enum class Passes { one, several };

  Lattice(const Row& row, const Grid& grid, const Evidence& evidence, Passes passes = Passes::several);

  const Row& row() const { return row_; }
  const Grid& grid() const { return grid_; }
  const Evidence& evidence() const { return evidence_; }
  int states() const { return static_cast<int>(row_.arcs.size()); }
  int evidence_states() const { return static_cast<int>(first_cell_.size()); }

  /// The cells at which an evidence state is alive, inclusive.
  int first_cell(int evidence_state) const { return first_cell_[static_cast<std::size_t>(evidence_state)]; }
  int last_cell(int evidence_state) const { return last_cell_[static_cast<std::size_t>(evidence_state)]; }
  /// Evidence states that may be alive at a cell: first .. last, inclusive.
  std::pair<int, int> alive(int cell) const { return alive_[static_cast<std::size_t>(cell)]; }

  /// Leaves out of every pass what the mask does not hold.
  void restrict(NodeMask mask);
  bool is_alive(int cell, int evidence_state) const {
    const auto e = static_cast<std::size_t>(evidence_state);
    if (cell < first_cell_[e] || cell > last_cell_[e]) return false;
    return mask_.alive.empty() || mask_.alive[e][static_cast<std::size_t>(cell - first_cell_[e])];
  }

  /// The first cell from this one on at which any evidence state is alive; beyond the end when none is.
  int next_alive(int cell) const {
    return next_alive_.empty() ? cell : next_alive_[static_cast<std::size_t>(cell)];
  }

  std::size_t nodes() const { return nodes_; }
  std::size_t node(int cell, int state, int evidence_state) const {
    const auto e = static_cast<std::size_t>(evidence_state);
    const auto length = static_cast<std::size_t>(last_cell_[e] - first_cell_[e]) + 1;
    return offset_[e] + static_cast<std::size_t>(state) * length +
           static_cast<std::size_t>(cell - first_cell_[e]);
  }
  int end_evidence() const { return evidence_states() - 1; }

  const std::vector<Arc>& arcs(int state, int cell) const {
    return row_.arcs[static_cast<std::size_t>(state)]
                    [static_cast<std::size_t>(row_.position_class[static_cast<std::size_t>(cell)])];
  }

  /// The prior of an element at a cell. Valid until the next call with another cell.
  const Prior& prior(int cell, int element) const;
  /// Evidence is considered for rooms that start at this cell up to this one, exclusive.
  int reach(int cell) const { return reach_[static_cast<std::size_t>(cell)]; }
  /// The most cells that an edge spans.
  int longest() const { return longest_; }
  /// The least cells that an edge spans.
  int shortest() const { return shortest_; }
  /// Where a path begins: evidence that no room can explain is skipped with this weight.
  std::pair<int, double> start() const;

 private:
  std::size_t make_prior(int cell, int element, Prior& prior) const;
  void add_alive(int cell, const WidthMass& mass, Prior& prior) const;
  void add_alive(int cell, const Prior::Stretch& stretch, Prior& prior) const;
  void add_uniform(int cell, int element, Prior& prior) const;
  void weigh_doors(int cell, const Element& element, Prior& prior) const;
  double doors(int cell, const Element& element, int width) const;
  bool needs_fine_steps(int cell, int first, int last) const;

  const Row& row_;
  Grid grid_;
  const Evidence& evidence_;
  Passes passes_;
  std::vector<std::vector<WidthMass>> masses_;  // of mixtures, by element
  struct Even {
    std::vector<double> fine, coarse;  // the same value throughout
  };
  std::vector<Even> even_;  // masses of uniform widths, by element
  std::vector<int>
      fine_before_;  // [cell]: cells before it where walls may be known to better than a coarse step
  std::vector<std::pair<int, int>> fine_widths_;  // of background rooms
  std::vector<int> first_cell_;
  std::vector<int> last_cell_;
  std::vector<std::pair<int, int>> alive_;
  std::vector<int> reach_;
  std::vector<std::size_t> offset_;
  std::size_t nodes_ = 0;
  NodeMask mask_;                // empty: all
  std::vector<int> next_alive_;  // [cell], to one beyond the end; empty: all are
  int longest_ = 0;
  int shortest_ = 1;

  struct LastPrior {
    int cell = -1;
    Prior prior;
  };
  mutable std::deque<Prior> priors_;
  mutable std::vector<const Prior*> kept_;  // [cell * elements + element], into priors_
  mutable std::size_t kept_values_ = 0;
  mutable std::vector<LastPrior> last_;  // [element]; of those that are not kept
};

/// The edges that leave a cell; made when asked for, kept until another cell is asked for.
class Edges {
 public:
  explicit Edges(const Lattice& lattice) : lattice_(lattice) {}

  /// The moves of an element from an evidence state at a cell. Their weights are without the arc's
  /// probability. Valid until another cell is asked for.
  const std::vector<Move>& moves(int cell, int element, int evidence_state);

 private:
  struct Known {
    int element = 0;
    int evidence_state = 0;
    std::vector<Move> moves;
  };
  using Stretch = Prior::Stretch;

  double* store(int count);
  bool weigh(const PreparedEvidence& e, const Element& element, const Stretch& widths, double* weights) const;
  void add(std::vector<Move>& moves, int evidence_state, const Stretch& sum, const double* max, int matched);
  void add_matches(std::vector<Move>& moves, const Element& element, const Stretch& prior, int next);

  const Lattice& lattice_;
  int cell_ = -1;
  std::deque<std::vector<double>> buffers_;
  std::size_t buffer_count_ = 0;
  std::deque<Known> known_;
  std::size_t known_count_ = 0;
};

/// Weight of evidence `e` belonging to the element when it takes `width` cells from `cell`: any of its rooms,
/// all alike.
double belongs(const Lattice& lattice, int cell, int width, const Element& element,
               const PreparedEvidence& e);

/// Clear extent of the element's room, or of the whole element.
Extent room_extent(const Grid& grid, int cell, int width, const ElementRoom& room);
Extent element_extent(const Grid& grid, int cell, int width);

}  // namespace gramap
