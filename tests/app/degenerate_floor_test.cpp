// Floor files with every fault that people's drawings have, through the command: each is refused in one exact
// message, or mended and said.
#include <doctest/doctest.h>

#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/app/project.h"

using namespace gramap;
using test::has;
using test::Project;
namespace fs = std::filesystem;

namespace {

std::string rectangle(double x0, double y0, double x1, double y1) {
  char text[400];
  std::snprintf(text, sizeof text, "[[%.10g,%.10g],[%.10g,%.10g],[%.10g,%.10g],[%.10g,%.10g],[%.10g,%.10g]]",
                x0, y0, x1, y0, x1, y1, x0, y1, x0, y0);
  return text;
}

std::string feature(const std::string& properties, const std::string& type, const std::string& coordinates) {
  return R"({"type":"Feature","properties":{)" + properties + R"(},"geometry":{"type":")" + type +
         R"(","coordinates":)" + coordinates + "}}";
}

std::string area(const std::string& properties, const std::string& rings) {
  return feature(properties, "Polygon", "[" + rings + "]");
}

/// The parts of a floor with one hallway and a space on each side; a case replaces what it spoils.
/// Coordinates are multiplied and moved.
struct Drawing {
  explicit Drawing(double by = 1, double x = 0, double y = 0) : scale(by), shift_x(x), shift_y(y) {}
  double scale, shift_x, shift_y;
  std::string ring(double x0, double y0, double x1, double y1) const {
    return rectangle(x0 * scale + shift_x, y0 * scale + shift_y, x1 * scale + shift_x, y1 * scale + shift_y);
  }
  std::string line(double x0, double y0, double x1, double y1) const {
    char text[200];
    std::snprintf(text, sizeof text, "[[%.10g,%.10g],[%.10g,%.10g]]", x0 * scale + shift_x,
                  y0 * scale + shift_y, x1 * scale + shift_x, y1 * scale + shift_y);
    return text;
  }
  std::string whole = ring(0, 0, 15.67, 11.92);
  std::string outline = area(R"("kind":"outline")", whole);
  std::string hallway = area(R"("kind":"hallway","id":"H")", ring(0.36, 5.31, 15.31, 7.21));
  std::string north = area(R"("kind":"space","id":"north","hallway":"H")", ring(0.36, 7.36, 15.31, 11.56));
  std::string north_line = feature(R"("kind":"reference_line","id":"L","space":"north")", "LineString",
                                   line(0.36, 7.36, 15.31, 7.36));
  std::string more;
  std::string members = R"("coordinate_units":"m","walls":{"inner":0.15,"outer":0.36},)";

  std::string text() const {
    std::string features;
    for (const std::string& one : {outline, hallway, north, north_line, more})
      if (!one.empty()) features += (features.empty() ? "" : ",\n") + one;
    return R"({"type":"FeatureCollection",)" + members + "\"features\":[\n" + features + "\n]}";
  }
};

struct Case {
  std::string name, floor;
  std::string said;  ///< what standard error begins with, behind the file's name
};

template <typename Spoil>
Case spoilt(const std::string& name, const std::string& said, Spoil spoil) {
  Drawing drawing;
  spoil(drawing);
  return {name, drawing.text(), said};
}

/// A drawing at another scale and place.
std::string moved(double scale, double x, double y, const std::string& members) {
  Drawing drawing(scale, x, y);
  drawing.members = members;
  return drawing.text();
}

std::string fixed(const std::string& id, const std::string& ring) {
  return area(R"("kind":"fixed","type":"Stairs","id":")" + id + "\"", ring);
}

std::vector<Case> refused() {
  const std::string metres = R"("coordinate_units":"m",)";
  const Drawing good;
  const auto holes = [&good](const std::string& rings) {
    return [&good, rings](Drawing& d) { d.outline = area(R"("kind":"outline")", good.whole + "," + rings); };
  };
  const auto hallway = [](const std::string& properties, const std::string& ring) {
    return [properties, ring](Drawing& d) { d.hallway = area(properties, ring); };
  };
  const std::string h = R"("kind":"hallway","id":"H")";
  return {
      spoilt("hallway touches the outline",
             ": hallway 'H' touches the floor's outline at (0.00, 7.21), which leaves no outer wall there",
             hallway(h, rectangle(0, 5.31, 15.31, 7.21))),
      spoilt("hallway is the outline", ": hallway 'H' and space 'north' overlap by 62.8 m² at (",
             hallway(h, good.whole)),
      spoilt("hallway outside of the outline",
             ": hallway 'H' reaches 28.4 m² out of the floor's outline at (",
             hallway(h, rectangle(100.36, 5.31, 115.31, 7.21))),
      spoilt("line of no length", ": feature 4 (reference_line 'L'): its line has no length",
             [](Drawing& d) {
               d.north_line = feature(R"("kind":"reference_line","id":"L","space":"north")", "LineString",
                                      "[[3,7.36],[3,7.36]]");
             }),
      spoilt("line of a millimetre", ": the reference line of space 'north' has no length",
             [](Drawing& d) {
               d.north_line = feature(R"("kind":"reference_line","id":"L","space":"north")", "LineString",
                                      "[[3,7.36],[3.001,7.36]]");
             }),
      spoilt(
          "line off the space",
          ": feature 4 (reference_line 'L'): the line does not run along the border of space 'north' (to 5 "
          "cm)",
          [](Drawing& d) {
            d.north_line = feature(R"("kind":"reference_line","id":"L","space":"north")", "LineString",
                                   "[[0.36,9],[15.31,9]]");
          }),
      spoilt("space narrower than any room",
             ": space north: no layout of the rules of Side (cells, doubles, meeting, wet, store) fills its "
             "0.70 m",
             [](Drawing& d) {
               d.north =
                   area(R"("kind":"space","id":"north","hallway":"H")", rectangle(0.36, 7.36, 1.06, 11.56));
               d.north_line.clear();
             }),
      spoilt("space less deep than any room", ": space 'north' is only 0.04 m deep: no room fits into it",
             [](Drawing& d) {
               d.north =
                   area(R"("kind":"space","id":"north","hallway":"H")", rectangle(0.36, 7.36, 15.31, 7.40));
             }),
      spoilt("outline that crosses itself in its middle",
             ": feature 1 (outline): its polygon crosses or touches itself: the edge from (15.670, 0.000) to "
             "(0.000, 11.920) meets the edge from (15.670, 11.920) to (0.000, 0.000)",
             [](Drawing& d) {
               d.outline = area(R"("kind":"outline")", "[[0,0],[15.67,0],[0,11.92],[15.67,11.92],[0,0]]");
             }),
      spoilt("outline with a spike",
             ": feature 1 (outline): its polygon runs back on itself at (8.000, 14.000)",
             [](Drawing& d) {
               d.outline = area(R"("kind":"outline")",
                                "[[0,0],[15.67,0],[15.67,11.92],[8,11.92],[8,14],[8,11.92],[0,11.92],[0,0]]");
             }),
      spoilt("outline of no area", ": feature 1 (outline): its polygon encloses no area",
             [](Drawing& d) { d.outline = area(R"("kind":"outline")", "[[0,0],[5,5],[15,15],[0,0]]"); }),
      spoilt("two outlines", ": feature 2 (outline): the floor has a second outline",
             [](Drawing& d) { d.outline += "," + d.outline; }),
      spoilt("hole outside of the outline",
             ": feature 1 (outline): its hole 1 lies outside of it, at (20.000, 20.000)",
             holes(rectangle(20, 20, 25, 25))),
      spoilt("hole across the outline",
             ": feature 1 (outline): its hole 1 crosses or touches its outer ring near (10.000, 8.000)",
             holes(rectangle(10, 8, 25, 10))),
      spoilt("hole at the outline",
             ": feature 1 (outline): its hole 1 crosses or touches its outer ring near (5.000, 0.000)",
             holes(rectangle(5, 0, 6, 2))),
      spoilt("hole that crosses itself",
             ": feature 1 (outline): its hole 1 crosses or touches itself: the edge from (5.000, 1.000) to "
             "(6.000, 2.000) meets the edge from (6.000, 1.000) to (5.000, 2.000)",
             holes("[[5,1],[6,2],[6,1],[5,2],[5,1]]")),
      spoilt("hole of no area", ": feature 1 (outline): its hole 1 encloses no area",
             holes("[[5,1],[6,2],[5,1]]")),
      spoilt("holes that overlap",
             ": feature 1 (outline): its holes 1 and 2 cross or touch near (6.000, 2.000)",
             holes(rectangle(5, 1, 7, 3) + "," + rectangle(6, 2, 8, 4))),
      spoilt("a hole in a hole", ": feature 1 (outline): its holes 1 and 2 lie in one another",
             holes(rectangle(5, 1, 8, 4) + "," + rectangle(6, 2, 7, 3))),
      spoilt("hole in the hallway", ": hallway 'H' reaches 0.5 m² out of the floor's outline at (",
             holes(rectangle(5, 6, 6, 6.5))),
      spoilt("hallway with a hole", ": feature 2 (hallway 'H'): its polygon has a hole",
             hallway(h, rectangle(0.36, 5.31, 15.31, 7.21) + "," + rectangle(5, 6, 6, 6.5))),
      spoilt("two rooms that overlap", ": fixed room 'A' and fixed room 'B' overlap by 1 m² at (",
             [](Drawing& d) {
               d.more = fixed("A", rectangle(2, 2, 5, 4)) + "," + fixed("B", rectangle(4, 3, 6, 5));
             }),
      spoilt("one room twice", ": fixed room 'A' and fixed room 'B' overlap by 6 m² at (",
             [](Drawing& d) {
               d.more = fixed("A", rectangle(2, 2, 5, 4)) + "," + fixed("B", rectangle(2, 2, 5, 4));
             }),
      spoilt("space over the hallway", ": hallway 'H' and space 'north' overlap by ",
             [](Drawing& d) {
               d.north =
                   area(R"("kind":"space","id":"north","hallway":"H")", rectangle(0.36, 6, 15.31, 11.56));
               d.north_line = feature(R"("kind":"reference_line","id":"L","space":"north")", "LineString",
                                      "[[0.36,6],[15.31,6]]");
             }),
      spoilt("two hallways of one id", ": feature 3 (hallway 'H'): the id 'H' is used twice",
             [](Drawing& d) { d.hallway += "," + d.hallway; }),
      spoilt("a fixed room with a hallway's id", ": feature 5 (fixed 'H'): the id 'H' is used twice",
             [](Drawing& d) { d.more = fixed("H", rectangle(1, 1, 3, 3)); }),
      spoilt("two spaces of one id", ": feature 4 (space 'north'): the id 'north' is used twice",
             [](Drawing& d) { d.north += "," + d.north; }),
      spoilt("no kind", ": feature 2 ('H'): it has no 'kind'",
             hallway(R"("id":"H")", rectangle(0.36, 5.31, 15.31, 7.21))),
      spoilt("no id", ": feature 2 (hallway): it has no 'id'",
             hallway(R"("kind":"hallway")", rectangle(0.36, 5.31, 15.31, 7.21))),
      spoilt("an id that is an object", ": feature 2 (hallway): it has no 'id'",
             hallway(R"("kind":"hallway","id":{"a":1})", rectangle(0.36, 5.31, 15.31, 7.21))),
      spoilt("a kind nobody knows", ": feature 2 (halway 'H'): its kind 'halway' is unknown",
             hallway(R"("kind":"halway","id":"H")", rectangle(0.36, 5.31, 15.31, 7.21))),
      spoilt("no geometry", ": feature 5 (fixed 'F'): it needs a Polygon, not a null geometry",
             [](Drawing& d) {
               d.more = R"({"type":"Feature","properties":{"kind":"fixed","id":"F"},"geometry":null})";
             }),
      spoilt("no properties", ": feature 5: it has no 'kind'",
             [](Drawing& d) { d.more = R"({"type":"Feature","properties":null,"geometry":null})"; }),
      spoilt("no feature", ": feature 5: it is not an object", [](Drawing& d) { d.more = "null"; }),
      spoilt("coordinates in the wrong depth",
             ": feature 2 (hallway 'H'): its coordinates are not a list of positions",
             [&h](Drawing& d) { d.hallway = feature(h, "Polygon", "[0.36,5.31,15.31,7.21]"); }),
      spoilt("a coordinate that is text", ": feature 2 (hallway 'H'): a position is not a pair of numbers",
             hallway(h, R"([["0.36",5.31],[15.31,5.31],[15.31,7.21],[0.36,5.31]])")),
      spoilt("a coordinate that is no number", ":3:106: this is not valid JSON here",
             hallway(h, "[[NaN,5.31],[15.31,5.31],[15.31,7.21],[0.36,5.31]]")),
      spoilt("an infinite coordinate", ": a number in the file is too large for any computer",
             hallway(h, "[[1e400,5.31],[15.31,5.31],[15.31,7.21],[0.36,5.31]]")),
      spoilt("a wall of no thickness", ": the collection's 'walls.inner' must be more than 0 and at most 5 m",
             [](Drawing& d) { d.members = R"("coordinate_units":"m","walls":{"inner":0},)"; }),
      spoilt("a ceiling below the floor",
             ": the collection's 'ceiling_height' must be more than 0 and at most 100 m",
             [](Drawing& d) { d.members = R"("coordinate_units":"m","ceiling_height":-1,)"; }),
      spoilt("an elevation that is no number", ": the collection's 'elevation' is not a number",
             [](Drawing& d) { d.members = R"("coordinate_units":"m","elevation":"nan",)"; }),
      {"degrees called metres", moved(1e-5, 13.7, 51, metres),
       ": the file says metres, but all of it lies within half a metre: these look like degrees"},
      {"metres not called so", moved(1, 400000, 5600000, ""),
       ": these do not look like longitude and latitude, which a file without \"coordinate_units\" holds"},
      {"small metres not called so", moved(1, 0, 0, ""),
       ": these do not look like longitude and latitude, which a file without \"coordinate_units\" holds"},
      {"millimetres", moved(1000, 0, 0, metres),
       ": the floor is more than 5 km wide: these do not look like metres"},
      {"centimetres", moved(100, 0, 0, metres),
       ": hallway 'H' is about 169 m wide: these do not look like metres"},
      {"coordinates of 10^9 metres", moved(1, 1e9, 1e9, metres),
       ": a coordinate is more than 100,000 km from the origin, farther than any map reaches"},
      {"nothing but an outline",
       R"({"type":"FeatureCollection","coordinate_units":"m","features":[)" + good.outline + "]}",
       ": the floor has neither spaces nor hallways to derive them from"},
      {"a hallway that leaves nothing",
       R"({"type":"FeatureCollection","coordinate_units":"m","features":[)" + good.outline + "," +
           area(h, rectangle(0.36, 0.36, 15.31, 11.56)) + "]}",
       ": beside the hallways nothing is left that could hold rooms"},
      {"no features", R"({"type":"FeatureCollection","coordinate_units":"m","features":[]})",
       ": the floor has neither spaces nor an outline to derive them from"},
      {"an empty file", "", ":1:1: the JSON ends too early"},
      {"a truncated file", good.text().substr(0, good.text().size() / 2), ":3:137: the JSON ends too early"},
      {"no JSON", "<kml/>", ":1:1: this is not valid JSON here"},
      {"another JSON", "[1, 2]", ": this is not a GeoJSON FeatureCollection"},
      {"brackets without end", std::string(200000, '['), ":1:200001: the JSON ends too early"},
  };
}

}  // namespace

TEST_CASE("every degenerate floor is refused in one message that says file, place and what to do") {
  const Project project;
  const fs::path file = project.office() / "floor.geojson";
  for (const Case& item : refused()) {
    CAPTURE(item.name);
    project.write(file, item.floor);
    const auto result = project.run("fit '" + file.string() + "' -q --rules '" + project.rules().string() +
                                    "' -o '" + project.model().string() + "'");
    CHECK_MESSAGE(result.code == 1, result.error);
    CHECK_MESSAGE(result.error.starts_with("gramap: " + file.string() + item.said), result.error);
    CHECK_MESSAGE(has(result.error, "\n  help: "), result.error);
    CHECK_FALSE(fs::exists(project.model()));
  }
}

TEST_CASE("what is only drawn unusually is mended; what changes the floor is said") {
  const Project project;
  const fs::path file = project.office() / "floor.geojson";
  Drawing drawing;
  std::string said;
  SUBCASE("as it should be") {}
  SUBCASE("areas drawn clockwise") {
    drawing.outline = area(R"("kind":"outline")", "[[0,0],[0,11.92],[15.67,11.92],[15.67,0],[0,0]]");
    drawing.hallway = area(R"("kind":"hallway","id":"H")",
                           "[[0.36,5.31],[0.36,7.21],[15.31,7.21],[15.31,5.31],[0.36,5.31]]");
    said = "note: areas drawn clockwise, which were turned round: 2\n";
  }
  SUBCASE("the line the wrong way round") {
    drawing.north_line = feature(R"("kind":"reference_line","id":"L","space":"north")", "LineString",
                                 "[[15.31,7.36],[0.36,7.36]]");
    said = "note: the reference line of space 'north' had the space on its right and was turned round\n";
  }
  SUBCASE("the line too short") {
    drawing.north_line = feature(R"("kind":"reference_line","id":"L","space":"north")", "LineString",
                                 "[[0.36,7.36],[9.36,7.36]]");
    said =
        "note: the reference line of space 'north' covers 9.00 m of the space's side of 14.95 m; beyond its "
        "ends the space stays without rooms\n";
  }
  SUBCASE("no line") {
    drawing.north_line.clear();
    said = "note: space 'north' has no reference line; its edge beside hallway 'H' is taken\n";
  }
  SUBCASE("points again and again, an open ring, unknown properties, numbers as ids") {
    drawing.hallway =
        area(R"("kind":"hallway","id":7,"colour":"red","tags":["a",1,null],"more":{"a":{"b":1}})",
             "[[0.36,5.31],[0.36,5.31],[0.36,5.31],[15.31,5.31],[15.31,7.21],[0.36,7.21]]");
    drawing.north = area(R"("kind":"space","id":"north","hallway":"7")", rectangle(0.36, 7.36, 15.31, 11.56));
  }
  SUBCASE("in degrees") {
    drawing = Drawing(1e-5, 13.7, 51);
    drawing.members.clear();
  }
  SUBCASE("two courtyards so near that one wall is between them") {
    drawing.outline = area(R"("kind":"outline")",
                           drawing.whole + "," + rectangle(2, 1, 5, 4) + "," + rectangle(5.4, 1, 8, 4));
  }
  project.write(file, drawing.text());
  const auto result = project.run("fit '" + file.string() + "' --rules '" + project.rules().string() +
                                  "' -o '" + project.model().string() + "'");
  CHECK_MESSAGE(result.code == 0, result.error);
  CHECK_MESSAGE(has(result.out, said), result.out);
  CHECK(has(result.out, "note:") == !said.empty());
  CHECK(project.run("verify '" + project.model().string() + "'").code == 0);
}

TEST_CASE("rooms of a known floor that overlap, or share an id, are named by export") {
  const Project project;
  const fs::path truth = project.office() / "truth.geojson";
  std::string said;
  SUBCASE("overlap") {
    project.write(truth, R"({"type":"FeatureCollection","coordinate_units":"m","features":[)" +
                             area(R"("kind":"room","id":"A","type":"Cell")", rectangle(1, 1, 4, 4)) + "," +
                             area(R"("kind":"room","id":"B","type":"Cell")", rectangle(3, 1, 6, 4)) + "]}");
    said = ": room 'A' and room 'B' overlap by 3 m² at (";
  }
  SUBCASE("one id twice") {
    project.write(truth, R"({"type":"FeatureCollection","coordinate_units":"m","features":[)" +
                             area(R"("kind":"room","id":"A","type":"Cell")", rectangle(1, 1, 3, 4)) + "," +
                             area(R"("kind":"room","id":"A","type":"Cell")", rectangle(4, 1, 6, 4)) + "]}");
    said = ": feature 2 (room 'A'): the id 'A' is used twice";
  }
  const auto result =
      project.run("export -q '" + project.office().string() + "' -o '" + project.model().string() + "'");
  CHECK_MESSAGE(result.code == 1, result.error);
  CHECK_MESSAGE(has(result.error, said), result.error);
  CHECK(has(result.error, "\n  help: "));
  CHECK_FALSE(fs::exists(project.model()));
}
