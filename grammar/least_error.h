// The layout of least expected error: where several layouts are about as probable, the most probable one may
// be a bad answer, for it is far from all the others. What people want to know is how wide the rooms are.
#pragma once

#include <cstdint>
#include <vector>

#include "grammar/inference.h"
#include "grammar/space.h"

namespace gramap {

/// Rooms at the hallway, from the start of the reference line to its end.
using Stretches = std::vector<Stretch>;

struct DrawnLayout {
  Stretches rooms;
  std::vector<int> elements;  ///< of the row, one after the other
};

/// `count` layouts drawn from the posterior: `backward` has the sums of what can follow each node; drawn from
/// the start on. The same seed gives the same layouts.
std::vector<DrawnLayout> draw_layouts(const Lattice& lattice, const NodeTable& backward, int count,
                                      std::uint64_t seed);

/// The rooms at the hallway of a sequence's elements that start at `starts_m`, the last ending at `end_m`.
Stretches stretches_of(const Lattice& lattice, const std::vector<PathStep>& path,
                       const std::vector<double>& starts_m, double end_m);

/// Sum over the true rooms of |width of the found room that overlaps it best (intersection over union) - its
/// width|, metres; a room that nothing overlaps counts whole. Both in order.
double width_error_m(const Stretches& truth, const Stretches& found);

/// The candidate with the least mean error when each of the layouts drawn is taken for the truth (minimum
/// Bayes risk; Bickel and Doksum, Mathematical Statistics, 1977); of equals the first.
std::size_t least_error(const std::vector<Stretches>& candidates, const std::vector<DrawnLayout>& drawn);

}  // namespace gramap
