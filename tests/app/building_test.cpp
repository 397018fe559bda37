// A folder of floor folders is one building.
#include <cstddef>

#include "tests/app/project.h"

using namespace gramap;
using namespace gramap::test;

namespace {

/// The example as a building of two floors.
class Building : public Project {
 public:
  Building() {
    for (const char* name : {"eg", "og"}) {
      fs::create_directories(folder() / "house");
      fs::copy(office(), floor(name), fs::copy_options::recursive);
    }
    replace(floor_file("og"), "\"elevation\":0.0", "\"elevation\":3.1");
  }
  fs::path floor(const std::string& name) const { return folder() / "house" / name; }
  fs::path floor_file(const std::string& name) const { return floor(name) / "floor.geojson"; }
  Result fit_house(const std::string& more = "", const std::string& before = "") const {
    return run("fit '" + (folder() / "house").string() + "' -r '" + rules().string() + "' -o '" +
                   model().string() + "' " + more,
               before);
  }
};

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

}  // namespace

TEST_CASE("two floors are fitted in one run, with the same bytes from one thread and from many") {
  const Building building;
  const auto many = building.fit_house();
  CHECK_MESSAGE(many.code == 0, many.error);
  CHECK(count(many.out, "floor eg\n") == 1);
  CHECK(count(many.out, "floor og\n") == 1);
  const std::string bytes = read_file(building.model());
  CHECK(count(bytes, "\"kind\":\"floor\"") == 2);
  const auto one = building.fit_house("", "taskset -c 0");
  CHECK_MESSAGE(one.code == 0, one.error);
  CHECK(read_file(building.model()) == bytes);
  CHECK(building.run("verify '" + building.model().string() + "'").code == 0);
}

TEST_CASE("a floor that cannot be read, or stands in another, costs the building that floor only") {
  const Building building;
  SUBCASE("not GeoJSON") {
    building.write(building.floor_file("eg"), "{");
  }
  SUBCASE("no slab between") {
    building.replace(building.floor_file("og"), "3.1", "1.0");
  }
  const auto result = building.fit_house();
  CHECK_MESSAGE(result.code == 4, result.error);
  CHECK(has(result.error, "floor "));
  CHECK(has(result.error, "was set aside"));
  CHECK(count(read_file(building.model()), "\"kind\":\"floor\"") == 1);
  fs::remove(building.model());
  CHECK(building.fit_house("--strict").code == 1);
  CHECK(!fs::exists(building.model()));
}

TEST_CASE("stairs that do not stand on one another are said") {
  const Building building;
  const auto with_lift = [&](const std::string& name, const std::string& west, const std::string& east) {
    fs::remove_all(building.floor(name) / "scans");
    const fs::path file = building.floor_file(name);
    building.replace(file, "[[[0.36,7.36],[15.31,7.36],[15.31,11.56],[0.36,11.56],[0.36,7.36]]]",
                     "[[[2.6,7.36],[15.31,7.36],[15.31,11.56],[2.6,11.56],[2.6,7.36]]]");
    building.replace(file, "[[0.36,7.36],[15.31,7.36]]", "[[2.6,7.36],[15.31,7.36]]");
    building.replace(file, "\"features\":[",
                     "\"features\":[{\"type\":\"Feature\",\"properties\":{\"kind\":\"fixed\",\"id\":"
                     "\"lift\",\"type\":\"Lift\"},\"geometry\":{\"type\":\"Polygon\",\"coordinates\":[[[" +
                         west + ",7.36],[" + east + ",7.36],[" + east + ",9.0],[" + west + ",9.0],[" + west +
                         ",7.36]]]}},");
  };
  with_lift("eg", "0.36", "2.0");
  SUBCASE("apart") {
    with_lift("og", "0.66", "2.3");
    const auto result = building.fit_house();
    CHECK_MESSAGE(result.code == 0, result.error);
    CHECK_MESSAGE(has(result.out, "do not stand on one another"), result.out);
  }
  SUBCASE("one above the other") {
    with_lift("og", "0.36", "2.0");
    const auto result = building.fit_house();
    CHECK_MESSAGE(result.code == 0, result.error);
    CHECK(!has(result.out, "do not stand on one another"));
  }
}

TEST_CASE("options of one floor are refused for a building") {
  const Building building;
  CHECK(building.fit_house("--scans '" + (building.office() / "scans").string() + "'").code == 1);
  const auto result = building.fit_house("--without N1");
  CHECK(result.code == 1);
  CHECK(has(result.error, "FLOOR/ROOM"));
}
