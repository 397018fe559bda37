// The command as a user meets it: exit codes, messages, and what is left on disk.
#include <doctest/doctest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "geometry/file.h"

using namespace gramap;
namespace fs = std::filesystem;

namespace {

/// A copy of the shipped example in a folder of its own, so that tests can spoil it.
class Project {
 public:
  Project() {
    std::string name = (fs::temp_directory_path() / "gramap test äXXXXXX").string();
    folder_ = ::mkdtemp(name.data());
    fs::copy(GRAMAP_SOURCE_DIR "/examples/office", folder_ / "office", fs::copy_options::recursive);
  }
  ~Project() { fs::remove_all(folder_); }
  fs::path office() const { return folder_ / "office"; }
  fs::path scans(const std::string& room) const { return office() / "scans" / room; }
  fs::path model() const { return folder_ / "model.glb"; }
  fs::path rules() const { return office() / "office.grammar"; }

  struct Result {
    int code;
    std::string out, error;
  };
  Result run(const std::string& arguments) const {
    const std::string out = (folder_ / "out").string(), error = (folder_ / "error").string();
    const std::string command = std::string("'") + GRAMAP_COMMAND + "' " + arguments;
    const int status = std::system((command + " >'" + out + "' 2>'" + error + "'").c_str());
    return {WEXITSTATUS(status), read_file(out), read_file(error)};
  }
  std::string fit_arguments(const std::string& output) const {
    return "fit '" + office().string() + "' --rules '" + rules().string() + "' -o '" + output + "' ";
  }
  Result fit(const std::string& more = "") const { return run(fit_arguments(model().string()) + more); }
  void write(const fs::path& path, const std::string& text) const { std::ofstream(path) << text; }
  void replace(const fs::path& path, const std::string& from, const std::string& to) const {
    std::string text = read_file(path);
    const std::size_t at = text.find(from);
    REQUIRE(at != std::string::npos);
    text.replace(at, from.size(), to);
    write(path, text);
  }

 private:
  fs::path folder_;
};

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

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

TEST_CASE("an output folder that is not there, and an output that is a folder: exit 1") {
  const Project project;
  for (const std::string output : {"/nowhere/model.glb", "/"}) {
    const auto result = project.run(project.fit_arguments(output));
    CHECK_MESSAGE(result.code == 1, result.error);
    CHECK(has(result.error, output));
  }
}

TEST_CASE("plan names rooms that nobody scanned") {
  const Project project;
  const auto result = project.run("plan '" + project.office().string() + "' --rules '" +
                                  project.rules().string() + "' --target 0.5");
  CHECK_MESSAGE(result.code == 0, result.error);
  CHECK(has(result.out, "scan next"));
}
