// Each stage starts again from the files of the one before.
#include <cmath>
#include <cstdio>
#include <sstream>

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

TEST_CASE(
    "half of a building unlike any rule file: any_building keeps what was scanned, learned rules derive the "
    "rest") {
  const Project project;
  const fs::path floor = project.folder() / "clinic", seen = project.folder() / "seen",
                 rules = project.folder() / "own.grammar";
  REQUIRE(project
              .run("simulate " GRAMAP_SOURCE_DIR "/tests/app/clinic.geojson --seed 9 --points 20000 -o '" +
                   floor.string() + "'")
              .code == 0);
  for (const char* room : {"A3", "A5", "A6", "B2", "B4", "B5"}) fs::remove_all(floor / "scans" / room);
  REQUIRE(project.run("perceive '" + floor.string() + "' -o '" + seen.string() + "'").code == 0);
  const auto fit_with = [&](const std::string& rule_file) {
    return project.run("fit -q '" + floor.string() + "' --scans '" + seen.string() + "' --rules '" +
                       rule_file + "' -o '" + project.model().string() + "'");
  };
  const auto guessed = fit_with(GRAMAP_SOURCE_DIR "/rules/any_building.grammar");
  REQUIRE_MESSAGE((guessed.code == 0 || guessed.code == 4), guessed.error);
  REQUIRE(project.run("learn '" + project.model().string() + "' -o '" + rules.string() + "'").code == 0);
  const auto derived = fit_with(rules.string());
  REQUIRE_MESSAGE((derived.code == 0 || derived.code == 4), derived.error);
  for (const auto& [table, derived_within_m] : {std::pair{guessed.out, 0.2}, {derived.out, 0.1}}) {
    std::istringstream lines(table);
    int rooms = 0;
    for (std::string line; std::getline(lines, line);) {
      std::istringstream words(line);
      std::string space, room, type, origin, extracted;
      double fitted_m = 0;
      if (!(words >> space >> room >> type >> origin >> extracted >> fitted_m) || space[0] != 'H') continue;
      INFO(line);
      ++rooms;
      if (origin == "observed") CHECK(std::abs(fitted_m - std::stod(extracted)) < 0.01);
      // All rooms that nobody scanned are 3.30 m wide, but one of 3.24 m.
      if (origin == "derived") CHECK(std::abs(fitted_m - 3.30) < derived_within_m);
    }
    CHECK(rooms == 12);
  }
}
