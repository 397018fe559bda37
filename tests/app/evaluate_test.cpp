// `gramap learn` and `gramap evaluate` by the command: the figures computed on paper come out as JSON; what a
// plan's reader set aside is said.
#include <doctest/doctest.h>

#include "floor/gltf.h"
#include "floor/model.h"
#include "tests/app/project.h"
#include "tests/floor/drawn_plan.h"
#include "tests/floor/judged_by_hand.h"

using namespace gramap;
using test::DrawnPlan;
using test::has;
using test::Project;
namespace fs = std::filesystem;

TEST_CASE("the figures of a model and its truth as JSON are those computed on paper") {
  const Project project;
  const auto [floor, truth, fitted] = test::judged_by_hand();
  project.write(project.model(), to_glb(build_model(fitted), {}));
  const fs::path folder = project.folder() / "by hand";
  fs::create_directory(folder);
  project.write(folder / "floor.geojson", to_geojson(floor, {}));
  project.write(folder / "truth.geojson", to_geojson({}, truth));
  const auto judged =
      project.run("evaluate '" + project.model().string() + "' '" + folder.string() + "' --json -");
  CHECK(judged.code == 0);
  CHECK(judged.error.empty());
  std::string json;  // without blanks
  for (const char c : judged.out)
    if (c != ' ' && c != '\n') json += c;
  for (const char* part : {
           R"({"buffer":0.05,"completeness":0.611613,"correctness":0.5925},)",
           R"({"buffer":0.1,"completeness":0.774194,"correctness":0.75})",
           R"("median_distance":0.01)",
           R"("true_width":3.0,"error":0.04,"iou":0.982928})",
           R"("true_width":3.0,"error":0.04,"iou":0.957277})",
           R"("true_width":3.0,"error":-0.08,"iou":0.969499})",
           R"("derived":{"count":2,"mean_abs":0.06,"median_abs":0.06,"rms":0.063246,"worst":0.08,)",
           R"("within_1_sigma":0.333333,"within_2_sigma":0.666667,"within_3_sigma":1.0,)",
           R"({"least":0.8,"most":0.95,"count":2,"right":0,"mean_probability":0.875},)",
           R"({"kind":"door","matched":2,"truth":4,"model":3,"recall":0.5,"precision":0.666667})",
           R"({"kind":"window","matched":1,"truth":1,"model":2,"recall":1.0,"precision":0.5})",
           R"("class_right":0.5)",
       }) {
    INFO(std::string(part));
    CHECK(has(json, part));
  }
}

TEST_CASE("what a plan's reader sets aside is said by learn and evaluate, and the rest is learned from") {
  const Project project;
  const DrawnPlan plan;
  const auto level = [&](const std::string& name) {
    const std::string on = R"(,"level":")" + name + "\"";
    std::string text = DrawnPlan::feature(R"("indoor":"corridor")" + on, plan.box(0, 0, 24, 2));
    for (int i = 0; i < 6; ++i)
      text += "," +
              DrawnPlan::feature(R"("indoor":"room","room":"3d lab")" + on, plan.box(4 * i, 2, 4 * i + 4, 7));
    return text + "," + DrawnPlan::feature(R"("indoor":"room","ref":"bad")" + on, R"("geometry":null)");
  };
  const fs::path file = project.folder() / "plan.geojson", rules = project.folder() / "learned.grammar";
  project.write(file, DrawnPlan::collection(level("0")));
  const auto learned = project.run("learn '" + file.string() + "' -o '" + rules.string() + "'");
  CHECK(learned.code == 4);
  CHECK(has(learned.error,
            "gramap: warning: plan level 0: plan.geojson feature 8 ('bad') was set aside: it has no "
            "geometry\n"));
  CHECK(has(learned.error, "from 6 rooms in 1 space"));
  const auto checked = project.run("check '" + rules.string() + "'");
  CHECK(checked.code == 0);
  CHECK(checked.error.empty());
  CHECK(project.run("fmt --check '" + rules.string() + "'").code == 0);

  // Levels of one plan are floors to leave out.
  const std::string cross = "evaluate --shares 0.5 --draws 1 --grid 0.1 --cross '" + file.string() + "'";
  CHECK(has(project.run(cross).error, "there is only one floor, and none to learn from"));
  project.write(file, DrawnPlan::collection(level("0") + "," + level("1")));
  const auto crossed = project.run(cross);
  CHECK(crossed.code == 4);
  CHECK(has(crossed.out, "leave one floor out: 2 floors"));
  CHECK(has(crossed.error, "plan level 1: plan.geojson feature 16 ('bad') was set aside"));

  // How probable the level left out is, beside rules written by hand: three lines a level, the learned first.
  const auto likely = project.run("evaluate --likelihood --grid 0.1 --cross '" + file.string() +
                                  "' --rules " GRAMAP_SOURCE_DIR "/rules/any_building.grammar");
  CHECK(likely.out.starts_with("log likelihood of the floor left out, nats per room\n"));
  const auto nats = [&](const std::string& name) {
    const std::size_t at = likely.out.find(name);
    REQUIRE(at != std::string::npos);
    return std::stod(likely.out.substr(at + name.size()));
  };
  CHECK(nats("learned on the others ") > nats("any_building.grammar "));
  CHECK(nats("learned on the others ") >= nats("made uniform "));
}

TEST_CASE("floors that are none to learn from are refused with what they are") {
  const Project project;
  const auto refusal = [&](const std::string& name) {
    const auto result = project.run("learn '" + (project.folder() / name).string() + "' -o /dev/null");
    CHECK(result.code == 1);
    return result.error;
  };
  project.write(project.folder() / "empty.geojson", DrawnPlan::collection(""));
  CHECK(has(refusal("empty.geojson"), "the floor has no rooms to learn from"));
  project.write(project.folder() / "map.geojson", DrawnPlan::collection(DrawnPlan::feature(
                                                      R"("building":"yes")", DrawnPlan().box(0, 0, 9, 9))));
  CHECK(has(refusal("map.geojson"), "no feature of it has a 'kind', an 'indoor' tag or a 'feature_type'"));
  project.write(project.folder() / "archive.zip", "PK\x03\x04...");
  CHECK(has(refusal("archive.zip"), "the zip archive has no directory"));
  fs::create_directories(project.folder() / "download" / "venue");
  project.write(project.folder() / "download" / "venue" / "unit.geojson", DrawnPlan::collection(""));
  CHECK(has(refusal("download"), "download/venue"));
  // Our own truth is refused as a whole: whoever drew it for gramap can mend it.
  const std::string kinds = R"("coordinate_units":"m",)";
  project.write(project.folder() / "mixed.geojson",
                R"({"type":"FeatureCollection",)" + kinds + R"("features":[)" +
                    DrawnPlan::feature(R"("kind":"room","id":"r")", R"("geometry":null)") + "," +
                    DrawnPlan::feature(R"("indoor":"room","level":"0")", R"("geometry":null)") + "]}");
  CHECK(has(refusal("mixed.geojson"), "feature 2: it has no 'kind'"));
}
