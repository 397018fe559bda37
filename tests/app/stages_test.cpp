// Each stage starts again from the files of the one before.
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
