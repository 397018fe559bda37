// What a path through the lattice says of every evidence, and the widths off the grid that explain it best.
#pragma once

#include <vector>

#include "grammar/inference.h"

namespace gramap {

/// An evidence that an element explains.
struct Explained {
  int evidence = 0;  ///< into Evidence::rooms()
  Reading how = Reading::whole;
  int room = 0;  ///< into Element::rooms
};

/// By path step: the evidence that it explains. Evidence not listed belongs to no room.
std::vector<std::vector<Explained>> explain(const Lattice& lattice, const std::vector<PathStep>& path);

/// The element that a step places.
const Element& placed_element(const Lattice& lattice, const PathStep& step);

/// Where each element starts, metres along the line, and, last, the length and one wall more: the most
/// probable widths off the grid for this sequence of elements and this explanation. Widths are normal around
/// their types' (the component that fits best on the grid) and around what was observed; what is sought are
/// the positions of the walls between, so the sum of widths and walls is the length by construction, and the
/// least-squares problem is tridiagonal. Widths stay positive.
std::vector<double> refine(const Lattice& lattice, const std::vector<PathStep>& path,
                           const std::vector<std::vector<Explained>>& explained);

}  // namespace gramap
