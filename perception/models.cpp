#include "perception/models.h"

#include <string>
#include <string_view>
#include <vector>

#include "geometry/embedded.h"
#include "perception/furniture.h"
#include "perception/openings.h"

GRAMAP_EMBEDDED(openings_forest)
GRAMAP_EMBEDDED(furniture_forest)

namespace gramap {

namespace {

Forest forest_of(std::string_view text, const std::string& task, const std::vector<std::string>& features,
                 const std::vector<std::string>& classes) {
  return forest_from_text(std::string(text), task, features, classes, "models/" + task + ".forest");
}

}  // namespace

const Forest& shipped_openings_forest() {
  static const Forest forest =
      forest_of(embedded_openings_forest(), "openings", opening_feature_names(), opening_class_names());
  return forest;
}

const Forest& shipped_furniture_forest() {
  static const Forest forest =
      forest_of(embedded_furniture_forest(), "furniture", furniture_feature_names(), furniture_class_names());
  return forest;
}

}  // namespace gramap
