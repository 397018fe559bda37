// What the world does to a run: full disks, kills, files that lie or vanish, odd names. Nothing may be lost,
// no message may be wrong, and nothing may be written outside of the output paths.
#include <sys/resource.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <set>
#include <thread>

#include "tests/app/project.h"

using namespace gramap;
using namespace gramap::test;

namespace {

std::set<std::string> names_in(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    names.insert(entry.path().lexically_relative(folder).string());
  return names;
}

std::string quoted(const fs::path& path) {
  return "'" + path.string() + "'";
}

/// 2 GiB of address space: far more than any of these inputs may need, far less than their headers ask for.
const char* const kLittleMemory = "ulimit -v 2097152; ulimit -t 60;";

/// The sanitizers reserve address space of their own.
bool memory_can_be_limited() {
#if defined(__SANITIZE_ADDRESS__)
  return false;
#else
  return true;
#endif
}

/// A GLB with this JSON and, when there are any, these bytes of data.
std::string glb(std::string json, const std::string& data = "") {
  while (json.size() % 4) json += ' ';
  const auto word = [](std::size_t value) {
    std::string bytes;
    for (int i = 0; i < 4; ++i) bytes += static_cast<char>(value >> (8 * i) & 255);
    return bytes;
  };
  std::string chunks = word(json.size()) + "JSON" + json;
  if (!data.empty()) chunks += word(data.size()) + std::string("BIN\0", 4) + data;
  return "glTF" + word(2) + word(12 + chunks.size()) + chunks;
}

}  // namespace

TEST_CASE("a full disk: the old model stays, nothing else is left") {
  const Project project;
  project.write(project.model(), "the old model");
  const std::set<std::string> before = names_in(project.office());
  const auto result = project.run(project.fit_arguments(project.model().string()), "ulimit -f 16;");
  CHECK_MESSAGE(result.code == 1, result.error);
  CHECK_MESSAGE(has(result.error, project.model().string()), result.error);
  CHECK(has(result.error, "cannot be written"));
  CHECK(read_file(project.model()) == "the old model");
  CHECK(names_in(project.office()) == before);
  CHECK(names_in(project.folder()).size() == before.size() + 4);  // office/, the model, out, error
}

TEST_CASE("a full device as output, and behind standard output") {
  const Project project;
  const auto result = project.run(project.fit_arguments("/dev/full"));
  CHECK_MESSAGE(result.code == 1, result.error);
  CHECK(has(result.error, "No space left"));
  const auto table = project.run("derive " + quoted(project.rules()) + " --length 30 >/dev/full; exit $?; :");
  CHECK_MESSAGE(table.code == 1, table.error);
  CHECK(fs::is_character_file("/dev/full"));
}

TEST_CASE("a folder that may not be written to") {
  const Project project;
  fs::create_directory(project.folder() / "locked");
  project.write(project.folder() / "locked" / "model.glb", "the old model");
  fs::permissions(project.folder(), fs::perms::all);
  fs::permissions(project.folder() / "locked", fs::perms::owner_read | fs::perms::owner_exec |
                                                   fs::perms::others_read | fs::perms::others_exec);
  // Permissions mean nothing to root, so root becomes nobody.
  const std::string as_nobody =
      ::geteuid() == 0 ? "setpriv --reuid 65534 --regid 65534 --clear-groups --" : "";
  if (project.run("--version", as_nobody).code != 0) {
    MESSAGE("skipped: root cannot become nobody here, or nobody cannot run the command");
    return;
  }
  const auto result =
      project.run(project.fit_arguments((project.folder() / "locked" / "model.glb").string()), as_nobody);
  CHECK_MESSAGE(result.code == 1, result.error);
  CHECK_MESSAGE(has(result.error, "Permission denied"), result.error);
  CHECK(has(result.error, "permissions"));
  CHECK(read_file(project.folder() / "locked" / "model.glb") == "the old model");
}

TEST_CASE("killed at any moment: the old model or the new one, whole") {
  const Project project;
  REQUIRE(project.fit("-q").code == 0);
  const std::string whole = read_file(project.model());
  for (const char* signal : {"INT", "TERM", "KILL"}) {
    int killed = 0;
    for (int i = 0; i < 6; ++i) {
      project.write(project.model(), "the old model");
      const std::string after_s = std::to_string(0.02 + 0.12 * i);
      const auto result = project.run(project.fit_arguments(project.model().string()) + "-q",
                                      "timeout -s " + std::string(signal) + " " + after_s);
      killed += result.code != 0;
      const std::string now = read_file(project.model());
      CHECK((now == "the old model" || now == whole));
      if (result.code == 0) CHECK(now == whole);
    }
    CHECK(killed > 0);
  }
}

TEST_CASE("killed while it writes many files: each is whole or not there") {
  const Project project;
  const std::string simulate =
      "simulate " + quoted(project.office() / "plan.geojson") + " --points 3000 --seed 1 -o ";
  const fs::path all = project.folder() / "all", some = project.folder() / "some";
  REQUIRE(project.run(simulate + quoted(all)).code == 0);
  for (int i = 0; i < 5; ++i) {
    fs::remove_all(some);
    project.run(simulate + quoted(some), "timeout -s KILL " + std::to_string(0.05 + 0.1 * i));
    if (!fs::exists(some)) continue;
    for (const std::string& name : names_in(some))
      if (fs::is_regular_file(some / name))
        CHECK_MESSAGE(read_file(some / name) == read_file(all / name), name);
  }
}

TEST_CASE("headers that promise 10^12 points ask for no memory") {
  if (!memory_can_be_limited()) return;
  const Project project;
  const fs::path room = project.scans("N1");
  for (const auto& entry : fs::directory_iterator(room)) fs::remove(entry);
  const std::string vertices =
      "element vertex 999999999999\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
  std::string name, text;
  SUBCASE("binary PLY") {
    name = "scan000.ply";
    text = "ply\nformat binary_little_endian 1.0\n" + vertices + "0123456789ab";
  }
  SUBCASE("PLY in text") {
    name = "scan000.ply";
    text = "ply\nformat ascii 1.0\n" + vertices + "1 2 3\n";
  }
  SUBCASE("PLY with an element of nothing before the points") {
    name = "scan000.ply";
    text = "ply\nformat binary_little_endian 1.0\nelement nothing 999999999999\n" + vertices;
  }
  SUBCASE("PCD") {
    name = "scan000.pcd";
    text =
        "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 999999\nHEIGHT 999999\nDATA "
        "binary\n012345678";
  }
  SUBCASE("compressed PCD") {
    name = "scan000.pcd";
    text =
        "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 357913941\nHEIGHT 1\nDATA "
        "binary_compressed\n" +
        std::string("\xff\xff\xff\xff\xfc\xff\xff\xff", 8);
  }
  project.write(room / name, text);
  const auto result = project.run("perceive " + quoted(room), kLittleMemory);
  CHECK_MESSAGE(result.code == 1, result.error);
  CHECK_MESSAGE(has(result.error, name), result.error);
}

TEST_CASE("models that promise more than they hold") {
  if (!memory_can_be_limited()) return;
  const Project project;
  const fs::path model = project.folder() / "lies.glb";
  const std::string floor =
      R"("asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"name":"f","mesh":0,"extras":{"gramap":{"kind":"floor"}}}])";
  const std::string mesh = R"(,"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}])";
  SUBCASE("an accessor of 10^12 numbers") {
    project.write(
        model,
        glb("{" + floor + mesh +
                R"(,"accessors":[{"componentType":5126,"type":"VEC3","count":1000000000000,"bufferView":0}],)"
                R"("bufferViews":[{"buffer":0,"byteLength":12}],"buffers":[{"byteLength":12}]})",
            "0123456789ab"));
  }
  SUBCASE("a buffer of 10^12 bytes") {
    project.write(model, glb("{" + floor + R"(,"buffers":[{"byteLength":1000000000000}]})"));
  }
  SUBCASE("2^31 accessors' worth of indices") {
    project.write(
        model,
        glb("{" + floor + mesh +
            R"(,"accessors":[{"componentType":5125,"type":"SCALAR","count":2147483647,"bufferView":9}]})"));
  }
  for (const char* verb : {"verify", "explain", "view"}) {
    const auto result = project.run(std::string(verb) + " " + quoted(model), kLittleMemory);
    INFO(verb);
    CHECK_MESSAGE((result.code == 1 || result.code == 2), result.error);
  }
}

TEST_CASE("a floor file of enormous numbers is refused, in bounded memory") {
  if (!memory_can_be_limited()) return;
  const Project project;
  project.replace(project.office() / "floor.geojson", "15.67", "1e12");
  const auto result = project.run(project.fit_arguments(project.model().string()), kLittleMemory);
  CHECK_MESSAGE(result.code == 1, result.error);
}

TEST_CASE("a file larger than the memory is said to be too large") {
  if (!memory_can_be_limited()) return;
  const Project project;
  fs::resize_file(project.rules(), 1'000'000'000'000ull);  // sparse
  const auto result = project.run("check " + quoted(project.rules()), kLittleMemory);
  CHECK_MESSAGE(result.code == 1, result.error);
  CHECK_MESSAGE(has(result.error, "memory"), result.error);
}

TEST_CASE("files that come and go while they are read cost a room, never the run") {
  const Project project;
  const fs::path victim = project.scans("N1") / "scan000.xyz", kept = project.folder() / "kept";
  fs::copy_file(victim, kept);
  std::atomic<bool> done = false;
  std::thread vandal([&] {
    while (!done) {
      std::error_code ignored;
      fs::remove(victim, ignored);
      fs::copy_file(kept, victim, ignored);
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  });
  for (int i = 0; i < 3; ++i) {
    const auto result = project.fit("-q");
    CHECK_MESSAGE((result.code == 0 || result.code == 4), result.error);
    CHECK(read_file(project.model()).substr(0, 4) == "glTF");
  }
  done = true;
  vandal.join();
}

TEST_CASE("links that lead in circles or nowhere") {
  const Project project;
  fs::create_symlink("loop", project.folder() / "loop");
  const std::string loop = (project.folder() / "loop").string();
  for (const std::string& arguments :
       {"fit '" + loop + "' -r '" + project.rules().string() + "' -o x.glb", "check '" + loop + "'",
        "perceive '" + loop + "'", "verify '" + loop + "'", project.fit_arguments(loop)}) {
    const auto result = project.run(arguments);
    INFO(arguments);
    CHECK_MESSAGE(result.code == 1, result.error);
    CHECK_MESSAGE(has(result.error, loop), result.error);
    CHECK_FALSE(has(result.error, "internal"));
  }
  // A room that is a circle, a scans folder that holds itself, and a scan that is gone.
  fs::create_symlink("circle", project.office() / "scans" / "circle");
  fs::create_directory_symlink(project.office() / "scans", project.office() / "scans" / "again");
  fs::create_symlink("gone.xyz", project.scans("N2") / "scan009.xyz");
  const auto result = project.fit("-q");
  CHECK_MESSAGE(result.code == 4, result.error);
  CHECK_MESSAGE(has(result.error, "scan009.xyz"), result.error);
}

TEST_CASE("an output that is a link is written where the link points") {
  const Project project;
  project.write(project.folder() / "real.glb", "the old model");
  fs::create_symlink("real.glb", project.model());
  REQUIRE(project.fit("-q").code == 0);
  CHECK(fs::is_symlink(project.model()));
  CHECK(read_file(project.folder() / "real.glb").substr(0, 4) == "glTF");
}

TEST_CASE("a locale that writes decimal commas changes no byte") {
  const Project project;
  REQUIRE(project.fit("-q").code == 0);
  const std::string model = read_file(project.model());
  // A locale of our own making where the system has the sources of one; the bare name elsewhere.
  const std::string locales = quoted(project.folder());
  std::ignore =
      std::system(("cd " + locales + " && localedef -i de_DE -f UTF-8 ./de_DE.UTF-8 >made 2>&1").c_str());
  const auto result = project.run(project.fit_arguments(project.model().string()) + "-q --pose-sigma 0.25",
                                  "LOCPATH=" + locales + " LC_ALL=de_DE.UTF-8 LANGUAGE=de");
  CHECK_MESSAGE(result.code == 0, result.error);
  CHECK(read_file(project.model()) == model);
}

TEST_CASE("names in an input never lead outside of the output folder") {
  const Project project;
  const fs::path plan = project.office() / "plan.geojson", out = project.folder() / "deep" / "down" / "out";
  fs::create_directories(out.parent_path());
  project.run("--version");
  const fs::path elsewhere = project.folder() / "elsewhere";
  for (const std::string& name :
       {std::string("../../x"), elsewhere.string(), std::string(".."), std::string("a/b")}) {
    fs::copy_file(GRAMAP_SOURCE_DIR "/examples/office/plan.geojson", plan,
                  fs::copy_options::overwrite_existing);
    std::string text = read_file(plan);
    for (std::size_t at = 0; (at = text.find("\"N1\"", at)) != std::string::npos;)
      text.replace(at, 4, "\"" + name + "\"");
    project.write(plan, text);
    const std::set<std::string> before = names_in(project.folder());
    const auto result = project.run("simulate " + quoted(plan) + " --points 200 -o " + quoted(out));
    CHECK_MESSAGE(result.code == 1, result.error);
    CHECK_MESSAGE(has(result.error, name), result.error);
    CHECK(names_in(project.folder()) == before);
  }
  CHECK_FALSE(fs::exists(elsewhere));
}
