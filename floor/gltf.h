// glTF 2.0 out: node tree, names and `extras.gramap` as documented in the README. Metres, +Y up: plan (x, y)
// and height z become (x, z, -y).
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "floor/model.h"

namespace gramap {

/// How a model came about, kept in its root's extras so that the run can be itemised and repeated.
struct RunInfo {
  std::string version;    ///< gramap's
  std::string rule_file;  ///< its name, without folders
  std::vector<std::pair<std::string, std::string>> options;
  std::uint64_t seed = 0;
  double score = 0;
  std::vector<std::pair<std::string, std::string>> input_hashes;  ///< name, hash
};

struct GltfOptions {
  bool confidence_colours = false;  ///< rooms coloured by their width's σ instead of by kind
  bool room_volumes = false;        ///< closed room volumes besides the faces
};

/// The model as a binary glTF file's bytes. Throws std::logic_error when a number is not finite.
std::string to_glb(const FloorModel& model, const RunInfo& run, const GltfOptions& options = {});
std::string to_glb(const std::vector<FloorModel>& storeys, const RunInfo& run,
                   const GltfOptions& options = {});

/// The same as JSON with the data embedded.
std::string to_gltf(const std::vector<FloorModel>& storeys, const RunInfo& run,
                    const GltfOptions& options = {});

}  // namespace gramap
