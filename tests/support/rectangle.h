#pragma once

#include "geometry/types.h"

namespace gramap::test {

/// Counter-clockwise.
inline Polygon rectangle(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

}  // namespace gramap::test
