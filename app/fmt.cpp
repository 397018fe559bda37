#include <CLI/CLI.hpp>
#include <cstdio>
#include <iostream>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include "app/verbs.h"
#include "geometry/file.h"
#include "grammar/format.h"

namespace gramap {

Verb declare_fmt(CLI::App& gramap) {
  struct Options {
    std::vector<std::string> paths;
    bool check = false;
    bool to_stdout = false;
  };
  auto options = std::make_shared<Options>();
  CLI::App* verb = gramap.add_subcommand("fmt", "Write rule files in their canonical form, comments kept");
  verb->add_option("rules", options->paths,
                   "The rule files; - reads standard input and writes standard output")
      ->required();
  auto* check =
      verb->add_flag("--check", options->check,
                     "Write nothing; name the files that are not in canonical form, and exit with 1");
  verb->add_flag("--stdout", options->to_stdout, "Write to standard output, not over the files")
      ->excludes(check);
  return [options] {
    bool sound = true;
    for (const std::string& path : options->paths) {
      const bool from_stdin = path == "-";
      const std::string text =
          from_stdin ? std::string(std::istreambuf_iterator<char>(std::cin), {}) : read_file(path);
      const FormattedRules formatted = format_rules(text);
      std::fputs(render(formatted.diagnostics, text, path).c_str(), stderr);
      if (!formatted.text) {
        sound = false;
        continue;
      }
      if (options->check) {
        if (*formatted.text == text) continue;
        std::fprintf(stderr, "%s: not in canonical form; `gramap fmt %s` writes it\n", path.c_str(),
                     path.c_str());
        sound = false;
      } else if (options->to_stdout || from_stdin) {
        write_file("-", *formatted.text);
      } else if (*formatted.text != text) {
        write_file(path, *formatted.text);
      }
    }
    return static_cast<int>(sound ? kDone : kInputFault);
  };
}

}  // namespace gramap
