// The rules of a space as a finite automaton that emits a row of elements (rooms, or units with nested
// splits) from the start of the reference line to its end: what derivation, fit and learning compute with.
//
// A state is the list of what is still to be placed, the rule used last (where an `after` block cares), the
// room placed last (where a left context cares) and the room that has to come next (where a right context
// asks for it). Symbols are rewritten in place, leftmost first, so a state's list stays finite exactly when
// symbols recur only in last place; rules for which it does not are refused, by name.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "grammar/condition.h"
#include "grammar/grid.h"
#include "grammar/rules.h"

namespace gramap {

/// constant + slope * x.
struct Affine {
  double constant = 0;
  double slope = 0;
  double at(double x) const { return constant + slope * x; }
};

/// `ElementRoom::type` of the room that the rules do not foresee.
inline constexpr int kBackgroundType = -1;

/// Standard deviation of a size that is written without one (and of shares of what is left), metres.
inline constexpr double kDefaultTolerance_m = 0.01;

/// One room of an element, in the element's own frame: start and width along the line are affine in the
/// element's clear width.
struct ElementRoom {
  int type = kBackgroundType;  ///< into RuleSet::rooms
  int rule = -1;               ///< the rule that places it; -1: background
  int use = -1;                ///< into Element::uses, when a rule inside the element places it
  Affine start{0, 0};
  Affine width{0, 1};
  double depth_start_m = 0;  ///< from the hallway wall
  double depth_m = -1;       ///< < 0: the whole depth
  bool at_hallway = true;
};

/// The use of a rule inside an element, where a symbol is given a scope of its own.
struct InnerUse {
  int rule = 0;
  int parent = -1;  ///< into Element::uses; -1: the rule that the element stands in
};

/// One element of the row.
struct Element {
  enum class Width {
    mixture,  ///< `mixture`
    uniform,  ///< all alike between `least_m` and `most_m`
    share,    ///< normal around `share` of the clear length that is left, `share_sd_m`
  };
  Width kind = Width::mixture;
  Mixture mixture;
  double least_m = 0;
  double most_m = 0;
  Affine share;
  double share_sd_m = kDefaultTolerance_m;
  std::vector<ElementRoom> rooms;  ///< in the order in which they are reported; one, but for units
  std::vector<InnerUse> uses;      ///< the rules that rewrote symbols inside a unit, parents first

  int first_type() const { return rooms.front().type; }
  /// The type of the room that ends the element at the hallway.
  int last_type() const;
};

/// One step of a leftmost derivation; with the rules it determines the derivation tree.
struct DerivationStep {
  enum class Kind { rewrite, background, again, stop };
  Kind kind = Kind::rewrite;
  int rule = -1;  ///< for `rewrite`
};

/// An element placed, and the state after it. Arcs of several states share emissions.
struct Emission {
  int element = 0;
  int target = 0;
};

/// From a state, at positions of one class: the steps taken, then the element that is placed.
struct Arc {
  int element = 0;
  int target = 0;
  int emission = 0;  ///< into Row::emissions: element and target
  double probability = 0;
  std::vector<DerivationStep> steps;
};

struct Row {
  std::vector<Element> elements;
  std::vector<Emission> emissions;
  /// Positions with the same class have the same conditions true.
  std::vector<int> position_class;
  std::vector<std::vector<std::vector<Arc>>> arcs;  ///< [state][position class]; state 0 is the start
  /// What `after` blocks weighed: the rule used last, and a rule that competed behind it.
  std::set<std::pair<int, int>> sequels;
  std::vector<double> accept;  ///< probability that the derivation ends in this state when the space is full
};

/// Whether an item is written out in the row (a symbol is rewritten, a repeat repeated, a nested split along
/// the row opened) rather than placed as one element. `takes_rest`: it is the last item of a row that has all
/// that is left of the space.
bool is_written_out(const Item& item, bool takes_rest);

/// By symbol, whether it can come back when it is rewritten.
std::vector<bool> recursive_symbols(const RuleSet& rules);

/// Why rules cannot be turned into a row.
struct RowFault {
  int rule = -1;  ///< into RuleSet::rules; -1: none in particular
  std::string message;
};

struct CompiledRow {
  Row row;
  std::optional<RowFault> fault;  ///< when set, `row` is not usable
};

CompiledRow compile_row(const RuleSet& rules, const SpaceAttributes& space, const Grid& grid);

/// What is wrong with the rules whatever the space, for `check`: recursion that is not reducible to a row,
/// sizes without a scope, constructs that a row cannot hold.
std::optional<RowFault> check_row(const RuleSet& rules);

}  // namespace gramap
