// Any bytes as a floor file, its truth included: read, or refused with a message; what is read is finite, and
// passes or fails the checks before a fit.
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "floor/ground_truth.h"
#include "floor/read_indoor.h"
#include "floor/spaces.h"
#include "geometry/error.h"
#include "tests/fuzz/memory_file.h"

namespace {

using namespace gramap;

void require_finite(const Polygon& points) {
  for (const Vec2& point : points)
    if (!point.allFinite()) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const fuzz::MemoryFile file({reinterpret_cast<const char*>(data), size});
  try {
    const FloorGroundTruth floor = read_floor(file.path());
    require_finite(floor.outline);
    for (const Space& space : floor.spaces) require_finite(space.outline);
    check_floor(floor, "fuzz");
  } catch (const InputError& error) {
    if (!*error.what()) std::abort();
  }
  try {
    const FloorTruth truth = read_truth(file.path());
    if (!to_geojson({}, truth).starts_with("{")) std::abort();
  } catch (const InputError& error) {
    if (!*error.what()) std::abort();
  }
  try {  // plans of several levels, which the two above refuse
    if (is_indoor_plan(file.path()))
      for (const IndoorFloor& level : read_indoor(file.path())) {
        for (const Space& space : level.floor.spaces) require_finite(space.outline);
        for (const TrueRoom& room : level.truth.rooms) require_finite(room.outline);
      }
  } catch (const InputError& error) {
    if (!*error.what()) std::abort();
  }
  return 0;
}
