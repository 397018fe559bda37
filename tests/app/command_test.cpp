// The command as a user meets it: exit codes, messages, and what is left on disk.
#include "tests/app/project.h"

using namespace gramap;
using namespace gramap::test;

namespace {

/// Every cloud of the project with its coordinates multiplied.
void scale_clouds(const Project& project, double factor) {
  for (const auto& room : fs::directory_iterator(project.office() / "scans"))
    for (const auto& entry : fs::directory_iterator(room.path())) {
      if (entry.path().extension() != ".xyz") continue;
      std::ifstream in(entry.path());
      std::string text;
      for (double x, y, z; in >> x >> y >> z;)
        text += std::to_string(factor * x) + " " + std::to_string(factor * y) + " " +
                std::to_string(factor * z) + "\n";
      in.close();
      project.write(entry.path(), text);
    }
}

}  // namespace

TEST_CASE("the example fits: a table, a verified model, exit 0, the same bytes again") {
  const Project project;
  const auto result = project.fit();
  CHECK_MESSAGE(result.code == 0, result.error);
  CHECK(has(result.out, "observed"));
  CHECK(has(result.out, "derived"));
  CHECK(has(result.out, "exactly"));
  const std::string model = read_file(project.model());
  CHECK(model.substr(0, 4) == "glTF");
  CHECK(project.fit().code == 0);
  CHECK(read_file(project.model()) == model);
}

TEST_CASE("a fitted floor as GeoJSON gives back the same rooms to evaluate, to learn and to fit") {
  const Project project;
  const auto quoted = [](const fs::path& path) { return " '" + path.string() + "'"; };
  const fs::path floor = project.folder() / "fitted.geojson", learned = project.folder() / "learned.grammar";
  const auto first = project.fit("-q");
  REQUIRE_MESSAGE(first.code == 0, first.error);
  REQUIRE(project.run("export -q" + quoted(project.model()) + " -o" + quoted(floor)).code == 0);
  const auto judged = project.run("evaluate" + quoted(project.model()) + quoted(floor));
  CHECK(judged.code == 0);
  CHECK_MESSAGE(has(judged.out, "5 of 5 rooms, all in order"), judged.out);
  CHECK_MESSAGE(has(judged.out, "4 of 4 rooms, all in order"), judged.out);
  const auto rules = project.run("learn" + quoted(floor) + " -o" + quoted(learned));
  CHECK_MESSAGE(rules.code == 0, rules.error);
  CHECK_MESSAGE(has(rules.error + rules.out, "from 9 rooms in 2 spaces"), rules.error);
  const auto again = project.run("fit -q" + quoted(floor) + " --scans" + quoted(project.office() / "scans") +
                                 " --rules" + quoted(project.rules()) + " -o" + quoted(project.model()));
  CHECK_MESSAGE(again.code == 0, again.error);
  CHECK(again.out == first.out);
}

TEST_CASE("one bad room is said and derived instead: exit 4") {
  const Project project;
  std::string why;
  SUBCASE("a pose of five numbers") {
    project.write(project.scans("N1") / "scan000.pose", "1 2 3\n4 5\n");
    why = "scan000.pose";
  }
  SUBCASE("a cloud with NaN") {
    project.write(project.scans("N1") / "scan000.xyz", "1 2 3\nnan 1 2\n");
    why = "scan000.xyz:2";
  }
  SUBCASE("an empty cloud") {
    project.write(project.scans("N1") / "scan000.xyz", "");
    why = "scan000.xyz";
  }
  SUBCASE("a room that lies in no space") {
    for (const auto& entry : fs::directory_iterator(project.scans("N1")))
      if (entry.path().extension() == ".pose") project.write(entry.path(), "50000 0 50000\n0 0 0\n");
    why = "N1";
  }
  const auto result = project.fit();
  CHECK_MESSAGE(result.code == 4, result.error);
  CHECK(has(result.error, "N1 was set aside"));
  CHECK_MESSAGE(has(result.error, why), result.error);
  CHECK(has(result.out, "north_1"));
  CHECK(read_file(project.model()).substr(0, 4) == "glTF");
}

TEST_CASE("one bad room is left out of what compress packs: exit 4; nothing but bad rooms: exit 1") {
  const Project project;
  const fs::path scans = project.office() / "scans", packed = project.folder() / "packed";
  const auto compress = [&] {
    return project.run("compress '" + project.office().string() + "' -o '" + packed.string() + "'");
  };
  project.write(project.scans("N1") / "scan000.xyz", "1 2 3\nnan 1 2\n");
  const auto result = compress();
  CHECK_MESSAGE(result.code == 4, result.error);
  CHECK_MESSAGE(has(result.error, "scan000.xyz:2"), result.error);
  CHECK(!fs::exists(packed / "N1"));
  std::size_t rooms = 0;
  for (const auto& room : fs::directory_iterator(scans)) {
    if (room.path().filename() == "N1") continue;
    ++rooms;
    for (const auto& scan : fs::directory_iterator(room.path())) {
      fs::path name = scan.path().filename();
      if (name.extension() == ".xyz") name.replace_extension(".gpc");
      CHECK_MESSAGE(fs::exists(packed / room.path().filename() / name), name.string());
    }
  }
  CHECK(rooms == 5);
  // What was packed is a floor's scans: the bad room is derived, the others are as they were.
  fs::remove_all(scans);
  fs::rename(packed, scans);
  const auto fitted = project.fit();
  CHECK_MESSAGE(fitted.code == 0, fitted.error);
  CHECK(has(fitted.out, "north_1"));

  for (const auto& room : fs::directory_iterator(scans))
    for (const auto& scan : fs::directory_iterator(room.path()))
      if (scan.path().extension() == ".gpc") project.write(scan.path(), "nothing that was ever packed");
  CHECK(compress().code == 1);
  CHECK(!fs::exists(packed));
}

TEST_CASE("rooms are perceived the same in any frame") {
  const Project project;
  const auto table = [&](const std::string& more) {
    const std::string office = "'" + project.office().string() + "'";
    const auto result =
        project.run("perceive " + office + " --truth " + office + " --no-openings --no-furniture" + more);
    CHECK_MESSAGE(result.code == 0, result.error);
    return result.out.substr(0, result.out.find("\ndoors and windows"));
  };
  const auto number_after = [](const std::string& text, const std::string& words) {
    const std::size_t at = text.find(words);
    REQUIRE(at != std::string::npos);
    return std::stod(text.substr(at + words.size()));
  };
  for (const std::string more : {"", " --own-frames 1", " --own-frames 2"}) {
    CAPTURE(more);
    const std::string text = table(more);
    CHECK(has(text, "6 of 10 rooms"));
    CHECK(number_after(text, "width and depth: mean error ") < 5);
    CHECK(number_after(text, "height: mean error ") < 1);
    CHECK(number_after(text, "walls found: at least ") == 100);
    CHECK(number_after(text, "false walls: ") == 0);
  }
  CHECK(table(" --own-frames 1") == table(" --own-frames 1"));
  // The frames are other ones: the outline, unlike the table, says so.
  const auto outline = [&](const std::string& more) {
    return project.run("perceive '" + project.scans("N1").string() + "' --no-openings --no-furniture" + more)
        .out;
  };
  CHECK(outline("") != outline(" --own-frames 1"));
  CHECK(outline(" --own-frames 1") != outline(" --own-frames 2"));
}

TEST_CASE("what was seen and has no place in the model is said, and kept in it: exit 4") {
  const Project project;
  // Nothing of a window stands below a ceiling this low.
  project.replace(project.office() / "floor.geojson", "\"ceiling_height\":2.8", "\"ceiling_height\":0.8");
  const auto result = project.fit();
  CHECK_MESSAGE(result.code == 4, result.error);
  CHECK_MESSAGE(has(result.error, "warning: the window of room_N1 at ("), result.error);
  CHECK(has(result.error, ") was set aside: it has no height"));
  CHECK(has(result.out, "set aside: the window of room_N1"));
  CHECK(has(read_file(project.model()), "it has no height"));
  CHECK(project.fit("--strict").code == 1);
}

TEST_CASE("an input that cannot be used leaves the old model untouched: exit 1, one message") {
  const Project project;
  project.write(project.model(), "the old model");
  std::string arguments, why;
  SUBCASE("an unknown room in a rule") {
    project.replace(project.rules(), "{ Meeting }", "{ Meating }");
    why = "did you mean `Meeting`";
  }
  SUBCASE("a space that no derivation fills") {
    project.write(
        project.rules(),
        "grammar g; wall inner 0.15 m; room A { width 4.00 m +- 1 cm; } start S; a: S -> A S : 1;\n");
    why = "north";
  }
  SUBCASE("every cloud in millimetres") {
    scale_clouds(project, 1000);
    why = "millimet";
  }
  SUBCASE("a floor file that is no JSON") {
    project.write(project.office() / "floor.geojson", "{");
    why = "floor.geojson";
  }
  SUBCASE("no floor file") {
    fs::remove(project.office() / "floor.geojson");
    why = "floor.geojson";
  }
  SUBCASE("a room to leave out that is not there") {
    arguments = "--without N9";
    why = "N9";
  }
  SUBCASE("one bad room and --strict") {
    project.write(project.scans("N1") / "scan000.pose", "1 2 3\n4 5\n");
    arguments = "--strict";
    why = "scan000.pose";
  }
  const auto result = project.fit(arguments);
  CHECK_MESSAGE(result.code == 1, result.error);
  CHECK_MESSAGE(has(result.error, why), result.error);
  CHECK(read_file(project.model()) == "the old model");
}

TEST_CASE("wrong usage: exit 2 and where to find help") {
  const Project project;
  for (const char* arguments : {"", "nonsense", "fit", "fit --rules x", "check", "plan"}) {
    const auto result = project.run(arguments);
    INFO(arguments);
    CHECK(result.code == 2);
    CHECK(has(result.error, "--help"));
  }
  CHECK(project.run("--help").code == 0);
  CHECK(project.run("--version").code == 0);
}

TEST_CASE("segments are not fitted with options of a floor's scans: exit 2, both options named") {
  const Project project;
  const std::string fit = "fit --rls a.csv --rules-csv b.csv --rules c.grammar -o d.glb ";
  for (const char* option :
       {"--drawn-rooms", "--scans .", "--without N1", "--frame room", "--pose-sigma 1", "--hallway-seed 2"}) {
    const auto result = project.run(fit + option);
    INFO(option);
    CHECK(result.code == 2);
    CHECK(has(result.error, "--rls"));
    CHECK(has(result.error, std::string(option).substr(0, std::string(option).find(' '))));
  }
}

TEST_CASE("an output folder that is not there, and an output that is a folder: exit 1") {
  const Project project;
  for (const std::string output : {"/nowhere/model.glb", "/"}) {
    const auto result = project.run(project.fit_arguments(output));
    CHECK_MESSAGE(result.code == 1, result.error);
    CHECK(has(result.error, output));
  }
}

TEST_CASE("a name that ends as no format that the verb writes is wrong usage; fit writes .gltf as text") {
  const Project project;
  for (const char* ending : {".geojson", ".obj", ".GLB"}) {
    const std::string output = project.model().string() + ending;
    const auto result = project.run(project.fit_arguments(output));
    CHECK_MESSAGE(result.code == 2, result.error);
    CHECK(has(result.error, ".glb, .gltf"));
    CHECK_FALSE(fs::exists(output));
  }
  const auto exported = project.run("export '" + project.office().string() + "' -o '" +
                                    (project.folder() / "model.obj").string() + "'");
  CHECK(exported.code == 2);
  CHECK(has(exported.error, ".glb, .gltf, .svg, .geojson"));
  const std::string text = (project.folder() / "model.gltf").string();
  CHECK(project.run(project.fit_arguments(text) + "-q").code == 0);
  CHECK(read_file(text).front() == '{');
  CHECK(project.run("verify '" + text + "'").code == 0);
}

TEST_CASE("plan names rooms that nobody scanned") {
  const Project project;
  const auto result = project.run("plan '" + project.office().string() + "' --rules '" +
                                  project.rules().string() + "' --target 0.5");
  CHECK_MESSAGE(result.code == 0, result.error);
  CHECK(has(result.out, "scan next"));
}

TEST_CASE("check --lengths names the lengths that nothing fills, as text and as data") {
  const Project project;
  const fs::path rules = project.office() / "rigid.grammar";
  project.write(rules,
                "grammar rigid;\nwall inner 0.20 m, outer 0.30 m;\nroom Cell { width 2.80 m +- 2 cm; }\n"
                "start Row;\ncells: Row -> repeat { Cell };\n");
  const std::string file = " '" + rules.string() + "' ";
  const auto text = project.run("check" + file + "--lengths 2.8..6.2");
  CHECK(text.code == 1);
  CHECK(has(text.out, "no derivation fills spaces from"));
  CHECK(has(text.out, "cells"));  // the table of frequencies
  const auto json = project.run("check" + file + "--lengths 2.8..6.2 --diagnostics=json");
  CHECK(json.code == 1);
  CHECK(has(json.out, "E0801"));
  std::string one = project.run("check" + file + "--lengths 2.8..5.6 --diagnostics=json").out;
  one.replace(one.find(rules.string()), rules.string().size(), "FILE");
  CHECK(one == R"([
  {
    "file": "FILE",
    "severity": "error",
    "code": "E0801",
    "message": "no derivation fills spaces from 3.00 m to 5.50 m",
    "span": {
      "start": {
        "byte": 0,
        "line": 1,
        "column": 1
      },
      "end": {
        "byte": 0,
        "line": 1,
        "column": 1
      }
    },
    "labels": [],
    "notes": [],
    "help": "give the rules a room that fits, or a `background`"
  }
]
)");
  CHECK(project.run("check" + file + "--lengths 2.8..2.8").code == 0);
  CHECK(project.run("check" + file + "--lengths 3..6").code == 1);
  CHECK(project.run("check" + file + "--lengths 3..").code == 2);
  CHECK(project.run("check" + file + "--lengths 2.8..2.8 --diagnostics=json").code == 0);
  CHECK(project.run("check" + file + "--lengths 9..3").code == 2);
}
