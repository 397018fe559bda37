#include "perception/models.h"

#include "perception/furniture.h"
#include "perception/openings.h"

namespace gramap {

// Made from the model files by cmake/EmbedFile.cmake.
extern const unsigned char openings_model[], furniture_model[];
extern const unsigned long openings_model_size, furniture_model_size;

namespace {

Forest forest_of(const unsigned char* bytes, unsigned long size, const std::string& task,
                 const std::vector<std::string>& features, const std::vector<std::string>& classes) {
  const std::string text(reinterpret_cast<const char*>(bytes), size);
  return forest_from_text(text, task, features, classes, "models/" + task + ".forest");
}

}  // namespace

const Forest& shipped_openings_forest() {
  static const Forest forest = forest_of(openings_model, openings_model_size, "openings",
                                         opening_feature_names(), opening_class_names());
  return forest;
}

const Forest& shipped_furniture_forest() {
  static const Forest forest = forest_of(furniture_model, furniture_model_size, "furniture",
                                         furniture_feature_names(), furniture_class_names());
  return forest;
}

}  // namespace gramap
