// Any bytes as a forest's model file: read, or refused with a message; what is read answers every sample.
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "geometry/error.h"
#include "perception/forest.h"
#include "perception/furniture.h"
#include "perception/openings.h"

namespace {

using namespace gramap;

void try_as(const std::string& text, const std::string& task, const std::vector<std::string>& features,
            const std::vector<std::string>& classes) {
  try {
    const Forest forest = forest_from_text(text, task, features, classes, "fuzz");
    for (const float value : {-1e30f, 0.0f, 0.7f, 1e30f}) {
      const std::vector<float> sample(features.size(), value);
      if (forest.votes(sample).size() != classes.size()) std::abort();
    }
  } catch (const InputError& error) {
    if (!*error.what()) std::abort();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  try_as(text, "openings", opening_feature_names(), opening_class_names());
  try_as(text, "furniture", furniture_feature_names(), furniture_class_names());
  return 0;
}
