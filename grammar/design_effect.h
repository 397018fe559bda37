// Rooms of one row, or of one floor, have more in common than any rule says.
#pragma once

namespace gramap {

/// How many of `count` things out of so many groups tell no more than one drawn by itself (Kish 1965).
inline double design_effect(double count, double groups) {
  constexpr double likeness = 0.5;  // of two of the same group, 0 to 1
  return 1 + likeness * (count / groups - 1);
}

}  // namespace gramap
