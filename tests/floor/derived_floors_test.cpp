// Random floors of every shipped rule file, on hallways of every shape, with spaces derived from them: each
// becomes a model that passes the proof. GRAMAP_DERIVED_FLOORS sets how many a rule file (20 unless set).
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "floor/fit_floor.h"
#include "floor/furnish.h"
#include "floor/gltf.h"
#include "floor/spaces.h"
#include "floor/verify.h"
#include "geometry/error.h"
#include "geometry/file.h"
#include "geometry/polygon.h"
#include "grammar/derive.h"
#include "grammar/language.h"
#include "tests/support/rectangle.h"

using namespace gramap;
using test::rectangle;

namespace {

/// A hallway (0: straight, 1: L, 2: T, 3: a ring around a courtyard) of about the given length, turned by an
/// angle.
FloorGroundTruth floor_of_shape(int shape, double length_m, double angle_rad, const RuleSet& rules) {
  FloorGroundTruth floor;
  floor.name = "shape " + std::to_string(shape);
  const double l = length_m, d = 6, w = 2, e = rules.outer_wall_m;
  const auto add = [&floor](Polygon ring) {
    floor.hallways.push_back({"H" + std::to_string(floor.hallways.size() + 1), "", std::move(ring)});
  };
  switch (shape) {
    case 0:
      floor.outline = rectangle(0, 0, l, 2 * d + w);
      add(rectangle(e, d, l - e, d + w));
      break;
    case 1:
      floor.outline = {{0, 0}, {l, 0}, {l, 2 * d + w}, {2 * d + w, 2 * d + w}, {2 * d + w, l}, {0, l}};
      add({{d, d}, {l - e, d}, {l - e, d + w}, {d + w, d + w}, {d + w, l - e}, {d, l - e}});
      break;
    case 2:
      floor.outline = rectangle(0, 0, l, 3 * d + w);
      add({{e, d},
           {l - e, d},
           {l - e, d + w},
           {l / 2 + w / 2, d + w},
           {l / 2 + w / 2, 3 * d + w - e},
           {l / 2 - w / 2, 3 * d + w - e},
           {l / 2 - w / 2, d + w},
           {e, d + w}});
      break;
    default:
      floor.outline = rectangle(0, 0, l, l);
      add(rectangle(d, d, l - d, d + w));
      add(rectangle(d, l - d - w, l - d, l - d));
      add(rectangle(d, d + w, d + w, l - d - w));
      add(rectangle(l - d - w, d + w, l - d, l - d - w));
      if (l > 4 * d + 2 * w + 4)
        floor.courtyards = {rectangle(2 * d + w, 2 * d + w, l - 2 * d - w, l - 2 * d - w)};
  }
  const auto turn = [angle_rad](Polygon& ring) {
    for (Vec2& p : ring)
      p = Vec2(std::cos(angle_rad) * p.x() - std::sin(angle_rad) * p.y(),
               std::sin(angle_rad) * p.x() + std::cos(angle_rad) * p.y());
  };
  turn(floor.outline);
  for (Polygon& ring : floor.courtyards) turn(ring);
  for (Hallway& hallway : floor.hallways) turn(hallway.outline);
  derive_spaces(floor, rules.inner_wall_m, rules.outer_wall_m);
  return floor;
}

FittedRoom room_in(const Space& space, const PlacedRoom& placed, int number) {
  FittedRoom room;
  room.id = space.id + "_" + std::to_string(number);
  room.type = placed.type;
  room.space = space.id;
  room.start_m = placed.start_m;
  room.width_m = placed.width_m;
  room.outline = slab(space, placed.start_m, placed.start_m + placed.width_m);
  return room;
}

}  // namespace

TEST_CASE("random floors of every shipped rule file build, and pass the proof") {
  const char* wish = std::getenv("GRAMAP_DERIVED_FLOORS");
  const int wanted = wish ? std::max(4, std::atoi(wish)) : 20;
  std::vector<std::filesystem::path> files{std::filesystem::path(GRAMAP_SOURCE_DIR) /
                                           "examples/office/office.grammar"};
  for (const auto& entry :
       std::filesystem::directory_iterator(std::filesystem::path(GRAMAP_SOURCE_DIR) / "rules"))
    if (entry.path().extension() == ".grammar") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  for (const std::filesystem::path& file : files) {
    CAPTURE(file);
    const RuleSet rules = *check_rules(read_file(file), file.string()).rules;
    int made = 0;
    for (int shape = 0; shape < 4; ++shape) {
      CAPTURE(shape);
      FloorGroundTruth floor = floor_of_shape(shape, 42 + 1.37 * shape, 0.3 * shape, rules);
      std::vector<std::vector<Derivation>> drawn;
      std::vector<SpaceProblem> problems;
      const int count = wanted / 4;
      for (std::size_t s = 0; s < floor.spaces.size(); ++s) {
        SpaceProblem problem;
        problem.id = floor.spaces[s].id;
        problem.length_m = (floor.spaces[s].end - floor.spaces[s].start).norm();
        problem.depth_m = 5;
        problem.hallway = floor.spaces[s].hallway;
        problems.push_back(problem);
        try {
          drawn.push_back(SpaceDeriver(rules, problem).draw(count, 1 + s));
        } catch (const InputError&) {  // too short for any of the rules' rooms: left as it is
          drawn.emplace_back();
        }
      }
      for (int i = 0; i < count; ++i) {
        CAPTURE(i);
        FittedFloor fitted;
        fitted.floor = floor;
        fitted.inner_wall_m = rules.inner_wall_m;
        fitted.outer_wall_m = rules.outer_wall_m;
        fitted.height_m = rules.height_m;
        for (const Hallway& hallway : floor.hallways) {
          fitted.hallways.emplace_back();
          fitted.hallways.back().id = hallway.id;
          fitted.hallways.back().outline = hallway.outline;
        }
        for (std::size_t s = 0; s < drawn.size(); ++s) {
          int number = 0;
          if (!drawn[s].empty())
            for (const PlacedRoom& placed : drawn[s][static_cast<std::size_t>(i)].rooms)
              if (placed.depth_m < 0) fitted.rooms.push_back(room_in(floor.spaces[s], placed, ++number));
        }
        furnish(fitted, rules, problems, {});
        const FloorModel model = build_model(fitted);
        const VerifyReport report = verify(model);
        INFO(to_text(report));
        REQUIRE(report.ok());
        REQUIRE(report.totals.area_exact);
        ++made;
        if (i == 0)
          write_file(std::filesystem::path(GRAMAP_MODELS_DIR) /
                         ("derived_" + file.stem().string() + "_" + std::to_string(shape) + ".glb"),
                     to_glb(model, {}));
      }
    }
    CHECK(made == wanted / 4 * 4);
  }
}
