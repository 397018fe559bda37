// Any bytes as a rule file: what its `hallways` block grows in outlines of several shapes. What has to hold:
// no crash and no endless growth; a network is refused with a message, or is one simple ring inside the
// outline; the same seed grows it again.
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "floor/grow_hallways.h"
#include "geometry/error.h"
#include "geometry/polygon.h"
#include "grammar/language.h"

namespace {

using namespace gramap;

constexpr double kWall_m = 0.2, kOuterWall_m = 0.3;

void require(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "does not hold: %s\n", what);
  std::abort();
}

Polygon rectangle(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

void check_growth(const FloorGroundTruth& floor, const HallwayGrammar& grammar, std::uint64_t seed) {
  Polygon ring;
  try {
    ring = grow_hallways(floor, grammar, kWall_m, kOuterWall_m, seed);
  } catch (const InputError& error) {
    require(*error.what() != 0, "a message");
    return;
  }
  require(ring.size() >= 4 && signed_area(ring) > 0, "a ring, counter-clockwise");
  for (const Vec2& point : ring) {
    require(point.allFinite(), "finite");
    require(contains(floor.outline, point), "inside the outline");
    for (const Polygon& court : floor.courtyards) require(!contains(court, point), "outside the courtyards");
  }
  require(grow_hallways(floor, grammar, kWall_m, kOuterWall_m, seed) == ring, "the same again");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  const CheckedRules checked = check_rules(text, "fuzz");
  if (!checked.rules || !checked.rules->hallways) return 0;
  FloorGroundTruth floor;
  floor.outline = {{0, 0}, {40, 0}, {40, 36}, {25, 36}, {25, 15}, {0, 15}};
  check_growth(floor, *checked.rules->hallways, 1);
  floor.outline = rectangle(0, 0, 45, 45);
  floor.courtyards = {rectangle(15, 15, 30, 30)};
  check_growth(floor, *checked.rules->hallways, 2);
  floor.courtyards.clear();
  check_growth(floor, *checked.rules->hallways, 3);
  return 0;
}
