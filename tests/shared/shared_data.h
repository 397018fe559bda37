// Where the data beside the repository is, if it is there.
#pragma once

#include <cstdio>
#include <filesystem>
#include <optional>

namespace gramap::test {

/// The folder or file `name` of ../shared/data; nothing, said on standard error, when it is not there.
inline std::optional<std::filesystem::path> shared_data(const std::filesystem::path& name) {
  const std::filesystem::path path =
      std::filesystem::path(GRAMAP_SOURCE_DIR) / ".." / "shared" / "data" / name;
  if (std::filesystem::exists(path)) return path;
  std::fprintf(stderr, "skipped: %s is not there\n", path.c_str());
  return std::nullopt;
}

}  // namespace gramap::test
