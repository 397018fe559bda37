#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "app/verbs.h"
#include "geometry/error.h"

namespace gramap {

Verb declare_check(CLI::App& gramap) {
  auto path = std::make_shared<std::string>();
  CLI::App* verb = gramap.add_subcommand(
      "check", "Check a rule file: all faults at once, each with its place and what to write");
  verb->add_option("rules", *path, "The rule file")->required();
  return [path] { return static_cast<int>(kDone); };
}

}  // namespace gramap
