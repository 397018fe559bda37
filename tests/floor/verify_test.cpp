// The proof fails where a model is not what it claims: each test spoils one thing in a sound model.
#include "floor/verify.h"

#include <doctest/doctest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>

#include "floor/floor_of_truth.h"
#include "tests/support/rectangle.h"

using namespace gramap;
using test::rectangle;

namespace {

/// A room with a door and a window beside a hallway.
FloorModel sound_model() {
  FloorGroundTruth floor;
  floor.ceiling_height_m = 2.6;
  floor.outline = rectangle(0, 0, 6.6, 6.7);
  floor.hallways = {{"H", "", rectangle(0.3, 0.3, 6.3, 2.3)}};
  FloorTruth truth;
  truth.rooms = {{"1", "Office", "", rectangle(0.3, 2.5, 6.3, 6.4), 0, 2.6}};
  FittedFloor fitted = floor_of_truth(floor, truth);
  fitted.rooms.front().openings.push_back({"door", Origin::given, {2, 2.5}, {3, 2.5}, 0, 2.1});
  fitted.rooms.front().openings.push_back({"window", Origin::given, {4, 6.4}, {3, 6.4}, 0.9, 2.1});
  return build_model(fitted);
}

/// The codes of the faults of a model that was spoiled; text and JSON must say them, too.
std::set<std::string> faults_of(const FloorModel& model) {
  const VerifyReport report = verify(model);
  const std::string text = to_text(report);
  const auto data = nlohmann::json::parse(to_json(report));
  CHECK(data["ok"] == report.ok());
  CHECK(data["faults"].size() == report.faults.size());
  std::set<std::string> codes;
  for (std::size_t i = 0; i < report.faults.size(); ++i) {
    const VerifyFault& fault = report.faults[i];
    CHECK(text.find("fault [" + fault.code + "] " + fault.message) != std::string::npos);
    CHECK(data["faults"][i]["code"] == fault.code);
    codes.insert(fault.code);
  }
  return codes;
}

using Codes = std::set<std::string>;

}  // namespace

TEST_CASE("a sound model has no fault, and its report says what was counted") {
  const FloorModel model = sound_model();
  CHECK(faults_of(model).empty());
  const auto data = nlohmann::json::parse(to_json(verify(model)));
  CHECK(data["areas_m2"]["exact"] == true);
  CHECK(data["areas_m2"]["rooms"].get<double>() == doctest::Approx(6 * 3.9));
  CHECK(data["areas_m2"]["outline"].get<double>() == doctest::Approx(6.6 * 6.7));
  CHECK(data["parts"]["doors"] == 1);
  CHECK(data["parts"]["windows"] == 1);
}

TEST_CASE("a plan that does not fill its outline, or fills it twice, is no plan") {
  FloorModel gap = sound_model();
  gap.plan.cells.front().triangles.pop_back();
  CHECK(faults_of(gap) == Codes{"gap"});

  FloorModel twice = sound_model();
  twice.plan.cells.front().triangles.push_back(twice.plan.cells.back().triangles.front());
  CHECK(faults_of(twice) == Codes{"gap"});

  FloorModel rooms = sound_model();
  rooms.plan.faults.push_back({PlanFault::Kind::overlap, 1, 0, {1, 2}, 0.5});
  rooms.plan.faults.push_back({PlanFault::Kind::outside_outline, 1, -1, {1, 2}, 0.5});
  CHECK(faults_of(rooms) == Codes{"overlap", "bounds"});
}

TEST_CASE("a solid that is open, inside out or not finite is named") {
  FloorModel open = sound_model();
  open.slab.triangles.pop_back();
  CHECK(faults_of(open).count("open") == 1);
  CHECK(verify(open).faults.front().message.find("slab") == 0);

  FloorModel inside_out = sound_model();
  for (Triangle& triangle : inside_out.rooms.front().volume.triangles) std::swap(triangle[0], triangle[1]);
  CHECK(faults_of(inside_out) == Codes{"orientation"});

  FloorModel twisted = sound_model();
  std::swap(twisted.slab.triangles.front()[0], twisted.slab.triangles.front()[1]);
  CHECK(faults_of(twisted).count("orientation") == 1);

  FloorModel doubled = sound_model();
  append(doubled.slab, Mesh(doubled.slab));
  CHECK(faults_of(doubled).count("manifold") == 1);

  FloorModel endless = sound_model();
  endless.walls.front().solid.points.front().x() = std::nan("");
  CHECK(faults_of(endless).count("degenerate") == 1);

  // A corner pulled through the opposite faces: closed as before, but it cuts itself.
  FloorModel pierced = sound_model();
  pierced.rooms.front().volume.points.front() += Vec3(100, 100, 100);
  CHECK_FALSE(faults_of(pierced).empty());
}

TEST_CASE("an opening without a cut in a wall, or beyond the wall's head, is named") {
  FloorModel loose = sound_model();
  loose.openings.front().wall = -1;
  CHECK(faults_of(loose) == Codes{"opening"});

  FloorModel uncut = sound_model();
  for (PlanCell& cell : uncut.plan.cells) cell.opening = -1;
  CHECK(faults_of(uncut) == Codes{"opening"});
  CHECK(verify(uncut).faults.size() == 2);

  FloorModel high = sound_model();
  high.openings.front().fitted.head_m = high.height_m;
  CHECK(faults_of(high) == Codes{"opening"});
}

TEST_CASE("a room that no door leads to is a warning, not a fault") {
  FloorModel model = sound_model();
  model.openings.front().other = "1";  // the only door leads back into its room
  const VerifyReport report = verify(model);
  CHECK(report.ok());
  REQUIRE(report.warnings.size() == 1);
  CHECK(report.warnings.front().code == "unreachable");
  CHECK(to_text(report).find("warning [unreachable] no door leads to ") != std::string::npos);
}
