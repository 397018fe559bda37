// One consistent set of colours for model, viewer and plan.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace gramap {

struct PaletteEntry {
  std::string name;
  std::array<double, 4> rgba;  ///< sRGB, 0 to 1
  double roughness = 0.9;
  double metallic = 0;
};

/// In the order of `Material`.
const std::vector<PaletteEntry>& palette();

enum class Material {
  floor_observed,
  floor_derived,
  floor_hallway,
  floor_fixed,
  ceiling,
  wall_inner,
  wall_outer,
  mass,
  slab,
  door,
  frame,
  glass,
  sill,
  furniture,
  furniture_derived,
  seat,
  metal,
  confidence_first,  ///< the first of `kConfidenceSteps` from certain to unsure
};
constexpr int kConfidenceSteps = 6;

/// The step for a standard deviation: 1 cm and less is the first, 50 cm and more the last, logarithmic
/// between.
Material confidence_material(double sigma_m);

}  // namespace gramap
