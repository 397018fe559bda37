// Each stage starts again from the files of the one before.
#include <cstdio>

#include "floor/ground_truth.h"
#include "geometry/polygon.h"
#include "tests/app/project.h"

using namespace gramap;
using namespace gramap::test;

TEST_CASE("a fit takes what perceive wrote instead of the scans") {
  const Project project;
  const std::string seen = (project.folder() / "seen").string();
  REQUIRE(project.run("perceive '" + project.office().string() + "' -o '" + seen + "'").code == 0);
  const std::string fit = "fit '" + (project.office() / "floor.geojson").string() + "' -r '" +
                          project.rules().string() + "' -q -o '" + project.model().string() + "' --scans ";
  const auto from_scans = project.run(fit + "'" + (project.office() / "scans").string() + "'");
  const auto from_files = project.run(fit + "'" + seen + "'");
  CHECK(from_scans.code == 0);
  CHECK_MESSAGE(from_files.code == 0, from_files.error);
  // The table says widths to a millimetre; perceive's files hold a tenth of one, which can tip a sum of
  // areas.
  const auto table = [](const std::string& out) { return out.substr(0, out.find("areas:")); };
  CHECK(table(from_files.out) == table(from_scans.out));

  project.write(project.folder() / "seen" / "N1.json", "");
  const auto spoiled = project.run(fit + "'" + seen + "'");
  CHECK_MESSAGE(spoiled.code == 4, spoiled.error);
  CHECK(has(spoiled.error, "N1.json"));
}

TEST_CASE("a fitted floor's GeoJSON, fitted again, gives back its rooms") {
  const Project project;
  REQUIRE(project.fit("").code == 0);
  const std::string drawn = (project.folder() / "drawn.geojson").string();
  REQUIRE(project.run("export '" + project.model().string() + "' -q -o '" + drawn + "'").code == 0);
  const std::string again = (project.folder() / "again.glb").string();
  const auto result = project.run("fit '" + drawn + "' -r '" + project.rules().string() +
                                  "' --drawn-rooms -q -o '" + again + "'");
  CHECK_MESSAGE(result.code == 0, result.error);
  const std::string redrawn = (project.folder() / "redrawn.geojson").string();
  REQUIRE(project.run("export '" + again + "' -q -o '" + redrawn + "'").code == 0);
  const auto rooms = [](const std::string& file) {
    std::vector<std::string> list;
    for (const TrueRoom& room : read_truth(file).rooms) {
      char text[100];
      std::snprintf(text, sizeof text, "%s %s %.1f m2", room.id.c_str(), room.type.c_str(),
                    signed_area(room.outline));
      list.push_back(text);
    }
    return list;
  };
  CHECK(rooms(redrawn) == rooms(drawn));
  CHECK(rooms(redrawn).size() == 10);  // the hallway is one
}
