// The kind of file that an option names, by its ending.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

namespace gramap {

/// Refuses, as wrong usage, names that end in none of `endings` (".glb", …; "": names without an ending, as
/// devices and "-" are).
inline CLI::Validator ending_in(std::vector<std::string> endings) {
  const auto fault = [endings = std::move(endings)](const std::string& path) -> std::string {
    const std::string type = std::filesystem::path(path).extension().string();
    std::string said;
    for (const std::string& ending : endings) {
      if (type == ending) return "";
      if (!ending.empty()) said += (said.empty() ? "" : ", ") + ending;
    }
    return path + ": the format '" + type + "' is not written here; the name may end in " + said;
  };
  return CLI::Validator(fault, "");
}

}  // namespace gramap
