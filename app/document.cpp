// `gramap document`, for the build: the manual pages, the completions and the pages of docs/verbs, from the
// option table.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>

#include "app/completions.h"
#include "app/manual.h"
#include "app/verbs.h"
#include "geometry/error.h"
#include "geometry/file.h"
#include "version.h"

namespace gramap {
namespace {

namespace fs = std::filesystem;

void write_pages(const std::vector<VerbRow>& verbs, const fs::path& folder) {
  const std::string version = "gramap " GRAMAP_VERSION;
  for (const char* part : {"man", "completions", "verbs"}) make_folder(folder / part);
  write_file(folder / "man" / "gramap.1", manual_page(verbs, version));
  for (const VerbRow& verb : verbs) {
    write_file(folder / "man" / ("gramap-" + verb.name + ".1"), manual_page(verb, version));
    write_file(folder / "verbs" / (verb.name + ".md"), markdown_page(verb));
  }
  write_file(folder / "completions" / "gramap", bash_completions(verbs));
  write_file(folder / "completions" / "_gramap", zsh_completions(verbs));
  write_file(folder / "completions" / "gramap.fish", fish_completions(verbs));
}

}  // namespace

Verb declare_document(CLI::App& gramap) {
  auto folder = std::make_shared<std::string>();
  CLI::App* verb =
      gramap.add_subcommand("document", "Write the manual pages, completions and pages of the verbs");
  verb->group("");  // no verb for users
  verb->add_option("folder", *folder, "Folder to write man/, completions/ and verbs/ to")->required();
  return [&gramap, folder] {
    write_pages(option_table(gramap), *folder);
    return static_cast<int>(kDone);
  };
}

}  // namespace gramap
