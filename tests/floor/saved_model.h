// Models that tests write stay in the build folder: Khronos' validator and the viewer's test look at them.
#pragma once

#include <filesystem>
#include <string>

#include "geometry/file.h"

namespace gramap::test {

inline std::filesystem::path saved(const std::string& name, const std::string& bytes) {
  const std::filesystem::path path = std::filesystem::path(GRAMAP_MODELS_DIR) / name;
  write_file(path, bytes);
  return path;
}

}  // namespace gramap::test
