// Golden files: whole texts that a test compares with. Run a test with GRAMAP_UPDATE_GOLDEN=1 in the
// environment to write them anew; then read the difference.
#pragma once

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "geometry/file.h"

namespace gramap::test {

/// The file's text; writes `actual` there first when goldens are to be updated.
inline std::string golden(const std::filesystem::path& path, const std::string& actual) {
  if (std::getenv("GRAMAP_UPDATE_GOLDEN") != nullptr) write_file(path, actual);
  return std::filesystem::exists(path) ? read_file(path) : "(there is no " + path.string() + ")";
}

/// Files of one ending under a folder, sorted.
inline std::vector<std::filesystem::path> files_in(const std::filesystem::path& folder,
                                                   const std::string& ending) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.is_regular_file() && entry.path().extension() == ending) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

/// All rule files that come with gramap.
inline std::vector<std::filesystem::path> shipped_rule_files() {
  const std::filesystem::path root = GRAMAP_SOURCE_DIR;
  std::vector<std::filesystem::path> files = files_in(root / "rules", ".grammar");
  for (const auto& file : files_in(root / "examples", ".grammar")) files.push_back(file);
  return files;
}

}  // namespace gramap::test
