// A program of somebody else's: fits a floor without scans and writes it, with nothing but the installed
// package.
#include <cstdio>
#include <vector>

#include "floor/fit_floor.h"
#include "floor/gltf.h"
#include "floor/ground_truth.h"
#include "floor/model.h"
#include "floor/verify.h"
#include "geometry/error.h"
#include "geometry/file.h"
#include "grammar/language.h"

int main(int argc, char** argv) try {
  if (argc != 4) return 2;
  const gramap::CheckedRules rules = gramap::check_rules(gramap::read_file(argv[2]), argv[2]);
  if (!rules.rules) return 1;
  const gramap::FloorGroundTruth floor = gramap::read_floor(argv[1]);
  std::vector<gramap::SetAsideInput> set_aside;
  const auto problems = gramap::space_problems(floor, *rules.rules, {}, {}, set_aside);
  const gramap::FittedFloor fitted = gramap::fit_floor(floor, *rules.rules, problems, {});
  const gramap::FloorModel model = gramap::build_model(fitted);
  if (!gramap::verify(model).ok()) return 3;
  gramap::write_file(argv[3], gramap::to_glb(model, {}));
  std::printf("%zu rooms\n", fitted.rooms.size());
} catch (const gramap::InputError& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
