// The floor files and RLS files of real buildings are read as what their READMEs say of them.
#include <doctest/doctest.h>

#include "floor/floor_of_truth.h"
#include "floor/ground_truth.h"
#include "floor/model.h"
#include "floor/read_indoor.h"
#include "floor/rls_csv.h"
#include "floor/verify.h"
#include "geometry/polygon.h"
#include "tests/shared/shared_data.h"

using namespace gramap;

TEST_CASE("both institute floors are read with their truth") {
  for (const char* name : {"institute-1og", "institute-2og"}) {
    const auto folder = test::shared_data(name);
    if (!folder) return;
    const FloorGroundTruth floor = read_floor(*folder);
    const FloorTruth truth = read_truth(*folder);
    CHECK(floor.spaces.size() == 3);
    CHECK(floor.hallways.size() == 2);
    CHECK(floor.fixed.size() == 1);
    CHECK(floor.inner_wall_m == 0.2);
    CHECK(floor.remarks.empty());
    CHECK(truth.rooms.size() == 22);
    double rooms_m2 = 0, spaces_m2 = 0;
    for (const TrueRoom& room : truth.rooms)
      if (room.type != "Hallway") rooms_m2 += signed_area(room.outline);
    for (const Space& space : floor.spaces) spaces_m2 += signed_area(space.outline);
    // 19 rooms of 4.40 m depth in three spaces: 16 inner walls of 0.20 m between them.
    CHECK(spaces_m2 - rooms_m2 == doctest::Approx(16 * 0.2 * 4.4));
  }
}

TEST_CASE("the real RLS files: four shared walls, one of them before its segment") {
  const auto folder = test::shared_data("stuttgart-rls");
  if (!folder) return;
  const std::vector<RlsSegment> segments = read_rls(*folder / "rls.csv", *folder / "rules.csv");
  REQUIRE(segments.size() == 8);
  int shared = 0;
  for (const RlsSegment& segment : segments) shared += segment.shares_last_wall;
  CHECK(shared == 4);
  CHECK(segments[5].walls_m.front() == doctest::Approx(-0.105389));
  CHECK(segments[6].next == 7);
  CHECK(segments[7].next == 0);
  CHECK(segments[1].next == 2);
  CHECK(segments[4].next == 5);
}

TEST_CASE("levels of the university, as crowds drew them, are modelled whole") {
  for (const char* name : {"apb/level0.geojson", "apb/level2.geojson"}) {
    const auto file = test::shared_data(name);
    if (!file) return;
    CAPTURE(name);
    const IndoorFloor level = only_level(*file);
    const VerifyReport report = verify(build_model(floor_of_truth(level.floor, level.truth)));
    INFO(to_text(report));
    CHECK(report.ok());
  }
}
