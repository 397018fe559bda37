// Any bytes as a model file: read, or refused with a message; triangles name vertices that are there.
#include <cstdint>
#include <cstdlib>

#include "floor/read_model.h"
#include "geometry/error.h"
#include "tests/fuzz/memory_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace gramap;
  const fuzz::MemoryFile file({reinterpret_cast<const char*>(data), size});
  try {
    const ReadModel model = read_model(file.path());
    if (model.storeys.empty()) std::abort();
    for (const ReadNode& node : model.nodes)
      for (const auto& triangle : node.mesh.triangles)
        for (const auto vertex : triangle)
          if (static_cast<std::size_t>(vertex) >= node.mesh.points.size()) std::abort();
  } catch (const InputError& error) {
    if (!*error.what()) std::abort();
  }
  return 0;
}
