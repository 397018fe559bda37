#include "geometry/say.h"

#include <cstdio>

namespace gramap {

std::string said_metres(double length_m) {
  char text[340];  // the largest double has 309 digits
  std::snprintf(text, sizeof text, "%.2f m", length_m);
  return text;
}

std::string said_count(std::size_t count, const std::string& one, const std::string& many) {
  return std::to_string(count) + " " + (count == 1 ? one : many.empty() ? one + "s" : many);
}

std::string said_point(const Vec2& point, int decimals) {
  char text[680];
  std::snprintf(text, sizeof text, "(%.*f, %.*f)", decimals, point.x(), decimals, point.y());
  return text;
}

}  // namespace gramap
