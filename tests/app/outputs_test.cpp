// What derive, fmt and perceive write besides their main result.
#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

#include "tests/app/project.h"

using namespace gramap::test;
using gramap::read_file;

namespace {

std::string quoted(const fs::path& path) {
  return " '" + path.string() + "'";
}

std::vector<std::string> lines(const std::string& text) {
  std::vector<std::string> all;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) all.push_back(line);
  return all;
}

std::size_t times(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += part.size()) ++count;
  return count;
}

struct Stretch {
  double start_m, width_m;
};

/// The rooms of a tree as `derive --text` prints it.
std::vector<Stretch> rooms_of(const std::string& tree) {
  std::vector<Stretch> rooms;
  for (const std::string& line : lines(tree)) {
    const std::size_t at = line.find(" at ");
    Stretch room{};
    if (at == std::string::npos) continue;
    REQUIRE(std::sscanf(line.c_str() + at, " at %lf m, %lf m wide", &room.start_m, &room.width_m) == 2);
    rooms.push_back(room);
  }
  return rooms;
}

}  // namespace

TEST_CASE("derive prints the same layout as a line, as a tree and as a picture") {
  const Project project;
  const std::string derive = "derive" + quoted(project.rules()) + " --length 12 --seed 5";
  const auto line = project.run(derive), tree = project.run(derive + " --text");
  REQUIRE_MESSAGE(line.code == 0, line.error);
  REQUIRE(tree.code == 0);
  const std::vector<Stretch> rooms = rooms_of(tree.out);
  REQUIRE(rooms.size() > 1);
  CHECK(rooms.front().start_m == 0);
  CHECK(rooms.back().start_m + rooms.back().width_m == doctest::Approx(12));
  for (std::size_t i = 1; i < rooms.size(); ++i)
    CHECK(rooms[i].start_m > rooms[i - 1].start_m + rooms[i - 1].width_m);  // a wall lies between
  const std::string svg = project.run(derive + " --samples 3 --svg -").out;
  for (const Stretch& room : rooms) {
    char width[20];
    std::snprintf(width, sizeof width, " %.2f", room.width_m);
    CHECK(has(line.out, width));
    CHECK(has(svg, width));
  }
  const auto three = project.run(derive + " --samples 3");
  REQUIRE(lines(three.out).size() == 3);
  CHECK(lines(three.out).front() + "\n" == line.out);  // more samples change none before them
  const std::size_t drawn = rooms_of(project.run(derive + " --samples 3 --text").out).size();
  CHECK(times(svg, "<polygon") == drawn);
  CHECK(times(svg, "<g transform") == drawn);
}

TEST_CASE("derive's statistics of many layouts agree with what the rules promise") {
  const Project project;
  const auto result =
      project.run("derive" + quoted(project.rules()) + " --length 12 --samples 400 --stats --seed 3");
  REQUIRE_MESSAGE(result.code == 0, result.error);
  int rows = 0;
  for (const std::string& line : lines(result.out)) {
    char name[40];
    double expected = 0, drawn = 0, error = 0;
    if (std::sscanf(line.c_str(), "%39s %lf %lf +- %lf", name, &expected, &drawn, &error) != 4) continue;
    ++rows;
    CHECK_MESSAGE(std::abs(expected - drawn) <= 4.5 * error + 0.01, line);
  }
  CHECK(rows == 12);  // seven kinds of room, five rules
}

TEST_CASE("derive takes a floor: every space of it is filled and drawn, once") {
  const Project project;
  const std::string derive =
      "derive" + quoted(project.rules()) + " --floor" + quoted(project.office()) + " --seed 2";
  const auto tree = project.run(derive + " --samples 2 --text");
  REQUIRE_MESSAGE(tree.code == 0, tree.error);
  CHECK(times(tree.out, ", sample 1\n") == times(tree.out, ", sample 2\n"));
  CHECK(times(tree.out, ", sample 1\n") == 2);
  const auto one = project.run(derive + " --text");
  const fs::path picture = project.folder() / "derived.svg";
  REQUIRE(project.run(derive + " --samples 2 --svg" + quoted(picture)).code == 0);
  CHECK(times(read_file(picture), "<g transform") >= rooms_of(one.out).size());
}

TEST_CASE("fmt writes the canonical form over a file, to standard output, or only looks") {
  const Project project;
  const std::string canonical = project.run("fmt --stdout" + quoted(project.rules())).out;
  CHECK(canonical == read_file(project.rules()));
  CHECK(project.run("fmt --check" + quoted(project.rules())).code == 0);

  const fs::path untidy = project.folder() / "untidy.grammar", wrong = project.folder() / "wrong.grammar";
  project.write(untidy, "\n\n   " + canonical);
  const auto looked = project.run("fmt --check" + quoted(untidy));
  CHECK(looked.code == 1);
  CHECK(has(looked.error, "untidy.grammar: not in canonical form; `gramap fmt "));
  CHECK(read_file(untidy) == "\n\n   " + canonical);
  CHECK(project.run("fmt -", "cat" + quoted(untidy) + " |").out == canonical);

  // A file that is no rule file costs the run its success, but not the other file its form.
  project.write(wrong, "grammar ) broken");
  const auto both = project.run("fmt" + quoted(wrong) + quoted(untidy));
  CHECK(both.code == 1);
  CHECK(has(both.error, "wrong.grammar:1:"));
  CHECK(read_file(wrong) == "grammar ) broken");
  CHECK(read_file(untidy) == canonical);
}

TEST_CASE("perceive shows what its stages saw, and what each wall looks like") {
  const Project project;
  const fs::path debug = project.folder() / "debug", walls = project.folder() / "walls";
  const auto result = project.run("perceive" + quoted(project.scans("N1")) + " -v --debug" + quoted(debug) +
                                  " --wall-images" + quoted(walls));
  REQUIRE_MESSAGE(result.code == 0, result.error);
  CHECK(has(result.error, "planes"));  // -v names the stages
  const auto room = nlohmann::json::parse(result.out);
  const std::size_t count = room["walls"].size();
  REQUIRE(count >= 4);

  const std::string list = read_file(debug / "planes.txt");
  CHECK(times(list, ", in the outline") >= 4);
  CHECK(times(list, "  floor\n") >= 1);
  CHECK(times(list, "  ceiling\n") >= 1);
  const std::string ply = read_file(debug / "planes.ply"), end = "end_header\n";
  std::size_t points = 0;
  REQUIRE(std::sscanf(ply.c_str() + ply.find("element vertex"), "element vertex %zu", &points) == 1);
  CHECK(points > 1000);
  CHECK(ply.size() == ply.find(end) + end.size() + 15 * points);
  const std::string plan = read_file(debug / "plan.svg");
  CHECK(plan.rfind("<svg", 0) == 0);
  CHECK(plan.substr(plan.size() - 7) == "</svg>\n");
  for (const char* kind : {"door", "window"}) {
    const auto is_kind = [&](const auto& opening) { return opening["kind"] == kind; };
    CHECK(times(plan, std::string("<title>") + kind) ==
          static_cast<std::size_t>(std::count_if(room["openings"].begin(), room["openings"].end(), is_kind)));
  }

  CHECK(static_cast<std::size_t>(std::distance(fs::directory_iterator(walls), fs::directory_iterator())) ==
        count);
  for (std::size_t i = 0; i < count; ++i)
    CHECK(read_file(walls / ("N1_wall" + std::to_string(i) + ".png")).substr(1, 3) == "PNG");
}
