// The most probable sequences of rooms: types in order, whatever their widths.
//
// What is optimal is the sequence, summed over all widths, derivations and associations, not the single
// layout with the highest density: that one depends on the grid's step and favours few rooms over many,
// because every free wall costs it one more small mass. Within a sequence the best layout is well defined.
//
// The search grows prefixes from the start of the line. The sum over all layouts that begin with a prefix is
// known exactly (the prefix's own sums times the backward sums), and bounds all sequences that it begins: a
// prefix below the worst sequence that is wanted is dropped, as is one that others dominate at every node
// (but for a share of 1e-10 of its own sum: no sequence that it begins can be better than theirs by more).
#pragma once

#include <memory>
#include <tuple>
#include <vector>

#include "grammar/inference.h"

namespace gramap {

/// What an element shows of itself: its rooms' types, and where across the space they lie.
struct ElementLook {
  std::vector<int> types;
  std::vector<double> depths_m;
  bool operator==(const ElementLook&) const = default;
};
ElementLook look(const Element& element);

/// A node at the end of a prefix.
struct LayerNode {
  int cell = 0;
  int state = 0;
  int evidence_state = 0;
  std::size_t node = 0;
  double sum = 0;  ///< over all paths of the prefix to the node, divided by exp(Prefix::log_weight)

  auto place() const { return std::tie(cell, evidence_state, state); }
};

/// The first elements of a sequence. The looks are indices into looks_of(row).
struct Prefix {
  std::shared_ptr<const Prefix> before;  ///< without the last element; null: the empty one
  int look = -1;
  std::vector<LayerNode> layer;  ///< by cell, evidence state, state; sums add up to 1
  double log_weight = 0;         ///< ln of the sum over all paths of the prefix
  double log_posterior = 0;      ///< ln of the probability that the layout begins with it
  double mean_cell = 0;          ///< where it ends, on average
};

struct SearchLimits {
  int sequences = 1;  ///< how many to find
  int beam = 24;      ///< prefixes that are carried on from about the same place; beyond it the search is no
                      ///< longer exact
};

/// By element of the row, the index of its look; elements that look alike share one.
std::vector<int> looks_of(const Row& row);

/// The most probable sequences, best first, as prefixes that end at the end of the space.
std::vector<std::shared_ptr<const Prefix>> most_probable_sequences(const Lattice& lattice,
                                                                   const NodeTable& forward,
                                                                   const NodeTable& backward,
                                                                   const std::vector<double>& posteriors,
                                                                   const SearchLimits& limits);

/// The sequence of these looks, or null when no layout of the lattice has it.
std::shared_ptr<const Prefix> sequence_of(const Lattice& lattice, const NodeTable& forward,
                                          const NodeTable& backward, const std::vector<double>& posteriors,
                                          const std::vector<int>& looks);

}  // namespace gramap
