// The manual, the completions and the pages of docs/verbs, as `gramap document` makes them.
#include <doctest/doctest.h>

#include <cstdlib>
#include <filesystem>
#include <set>
#include <string>

#include "geometry/file.h"

using namespace gramap;
namespace fs = std::filesystem;

namespace {

/// The pages of this build, in a folder that goes away.
struct Documents {
  Documents() {
    std::string name = (fs::temp_directory_path() / "gramap documents XXXXXX").string();
    folder = ::mkdtemp(name.data());
    REQUIRE(std::system(("'" GRAMAP_COMMAND "' document '" + folder.string() + "'").c_str()) == 0);
  }
  ~Documents() { fs::remove_all(folder); }
  fs::path folder;
};

std::set<std::string> names_in(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.insert(entry.path().filename().string());
  return names;
}

bool there_is(const char* program) {
  return std::system((std::string("command -v ") + program + " >/dev/null 2>&1").c_str()) == 0;
}

}  // namespace

TEST_CASE("docs/verbs says what the options are now") {
  const Documents documents;
  const fs::path committed = GRAMAP_SOURCE_DIR "/docs/verbs";
  CHECK(names_in(committed) == names_in(documents.folder / "verbs"));
  for (const std::string& name : names_in(documents.folder / "verbs"))
    CHECK_MESSAGE(read_file(committed / name) == read_file(documents.folder / "verbs" / name),
                  "docs/verbs/" << name << " is old: run `make docs`");
}

TEST_CASE("every verb has its manual page, and the verbs for makers have none") {
  const Documents documents;
  const std::set<std::string> pages = names_in(documents.folder / "man");
  CHECK(pages.contains("gramap.1"));
  CHECK(pages.contains("gramap-fit.1"));
  CHECK_FALSE(pages.contains("gramap-document.1"));
  for (const std::string& page : pages) {
    const std::string text = read_file(documents.folder / "man" / page);
    CHECK(text.starts_with(".TH "));
    CHECK(text.find(".SH SEE ALSO") != std::string::npos);
  }
  CHECK(read_file(documents.folder / "man" / "gramap-fit.1").find("\\-\\-output") != std::string::npos);
}

TEST_CASE("bash completes verbs, options and choices, and leaves files to itself") {
  if (!there_is("bash")) {
    MESSAGE("skipped: there is no bash here");
    return;
  }
  const Documents documents;
  const auto completed = [&](const std::string& words, int at) {
    const fs::path script = documents.folder / "script", out = documents.folder / "out";
    write_file(script, "source '" + (documents.folder / "completions" / "gramap").string() +
                           "'\nCOMP_WORDS=(" + words + ")\nCOMP_CWORD=" + std::to_string(at) +
                           "\n_gramap\necho \"${COMPREPLY[*]}\"\n");
    REQUIRE(std::system(("bash '" + script.string() + "' >'" + out.string() + "'").c_str()) == 0);
    return read_file(out);
  };
  CHECK(completed("gramap pe", 1) == "perceive\n");
  CHECK(completed("gramap fit --ru", 2) == "--rules --rules-csv\n");
  CHECK(completed("gramap fit --frame r", 3) == "room\n");
  CHECK(completed("gramap fit my_fl", 2) == "\n");
}
