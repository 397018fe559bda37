// The rooms of a path through the lattice.
#pragma once

#include <vector>

#include "grammar/inference.h"
#include "grammar/space.h"

namespace gramap {

/// Position, type, rule and place across the space of every room, element by element in the order of
/// Element::rooms; what a fit adds (deviations, probabilities, evidence) is left as it is. `starts_m` has the
/// start of each element, and the last element ends at `length_m`.
std::vector<PlacedRoom> placed_rooms(const RuleSet& rules, const Lattice& lattice,
                                     const std::vector<PathStep>& path, const std::vector<double>& starts_m,
                                     double length_m);

/// Whether the element's room is the element itself, not a part of it.
bool is_whole(const ElementRoom& room);

/// A rule's name, "background" for -1.
std::string rule_name(const RuleSet& rules, int rule);

}  // namespace gramap
