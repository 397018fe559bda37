// Is a ring a simple polygon? Asked of every area in a floor file before anything is computed from it.
#pragma once

#include <optional>
#include <string>

#include "geometry/types.h"

namespace gramap {

/// The ring without its closing point and without points that repeat the one before (to a micrometre).
Polygon without_repeats(const Polygon& ring);

/// Where the ring crosses or touches itself, as a sentence for people; nothing when it is simple. `ring` has
/// no repeated neighbours. Edges are swept along x, so rings of thousands of points are quick.
std::optional<std::string> ring_fault(const Polygon& ring);

}  // namespace gramap
