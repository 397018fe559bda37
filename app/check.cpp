#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "app/verbs.h"
#include "geometry/file.h"
#include "grammar/language.h"

namespace gramap {

Verb declare_check(CLI::App& gramap) {
  struct Options {
    std::vector<std::string> paths;
    std::string format = "text";
  };
  auto options = std::make_shared<Options>();
  CLI::App* verb = gramap.add_subcommand(
      "check", "Check rule files: all faults at once, each with its place and what to write");
  verb->add_option("rules", options->paths, "The rule files")->required();
  verb->add_option(
          "--diagnostics", options->format,
          "How faults are written: text (for people, to standard error) or json (to standard output)")
      ->check(CLI::IsMember({"text", "json"}))
      ->capture_default_str();
  return [options] {
    bool sound = true;
    for (const std::string& path : options->paths) {
      const std::string text = read_file(path);
      const CheckedRules checked = check_rules(text, path);
      sound = sound && checked.rules.has_value();
      if (options->format == "json") {
        std::fputs(to_json(checked.diagnostics, text, path).c_str(), stdout);
        continue;
      }
      for (const Diagnostic& diagnostic : checked.diagnostics)
        std::fputs((render(diagnostic, text, path) + "\n").c_str(), stderr);
    }
    return static_cast<int>(sound ? kDone : kInputFault);
  };
}

}  // namespace gramap
