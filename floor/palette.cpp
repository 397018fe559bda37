#include "floor/palette.h"

#include <algorithm>
#include <cmath>

namespace gramap {

const std::vector<PaletteEntry>& palette() {
  static const std::vector<PaletteEntry> entries = {
      {"floor_observed", {0.80, 0.66, 0.48, 1}, 0.7},
      {"floor_derived", {0.58, 0.70, 0.84, 1}, 0.8},
      {"floor_hallway", {0.72, 0.72, 0.70, 1}, 0.6},
      {"floor_fixed", {0.60, 0.58, 0.56, 1}, 0.8},
      {"ceiling", {0.90, 0.90, 0.89, 1}},
      {"wall_inner", {0.93, 0.91, 0.87, 1}},
      {"wall_outer", {0.88, 0.83, 0.76, 1}},
      {"mass", {0.58, 0.57, 0.55, 1}},
      {"slab", {0.62, 0.61, 0.60, 1}},
      {"door", {0.62, 0.42, 0.25, 1}, 0.6},
      {"frame", {0.97, 0.97, 0.97, 1}, 0.5},
      {"glass", {0.55, 0.75, 0.85, 0.35}, 0.05},
      {"sill", {0.88, 0.88, 0.86, 1}, 0.4},
      {"furniture", {0.72, 0.55, 0.36, 1}, 0.6},
      {"furniture_derived", {0.55, 0.62, 0.70, 1}, 0.8},
      {"seat", {0.25, 0.33, 0.45, 1}, 0.9},
      {"metal", {0.40, 0.42, 0.44, 1}, 0.4, 0.5},
      {"sigma_1", {0.16, 0.55, 0.35, 1}},
      {"sigma_2", {0.50, 0.72, 0.36, 1}},
      {"sigma_3", {0.86, 0.82, 0.35, 1}},
      {"sigma_4", {0.94, 0.63, 0.26, 1}},
      {"sigma_5", {0.88, 0.40, 0.22, 1}},
      {"sigma_6", {0.70, 0.16, 0.18, 1}},
  };
  return entries;
}

Material confidence_material(double sigma_m) {
  const double share = std::log(std::max(sigma_m, 1e-4) / 0.01) / std::log(50.0);  // 0 at 1 cm, 1 at 50 cm
  const int step =
      std::clamp(static_cast<int>(std::floor(share * kConfidenceSteps)), 0, kConfidenceSteps - 1);
  return static_cast<Material>(static_cast<int>(Material::confidence_first) + step);
}

}  // namespace gramap
