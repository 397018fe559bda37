// How long `check` takes on rule files of growing length: rooms, constants and rules made up, all of them
// used. usage: bench_check [LINES...]   (1000 2000 5000 10000 unless given)
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "grammar/format.h"
#include "grammar/language.h"

namespace {

/// Of five lines: a constant, a room, a rule for it, a rule with a split, an `after` block.
std::string file_of(int lines) {
  std::string text = "grammar large;\nwall inner 0.20 m, outer 0.30 m;\nstart S0;\n";
  for (int i = 0; i < (lines - 3) / 5; ++i) {
    const std::string n = std::to_string(i), next = std::to_string((i + 1) % ((lines - 3) / 5));
    text += "let a" + n + " = 2.50 m + " + n + " mm;\n";
    text += "room R" + n + " { width a" + n + " +- 5 cm; door 1.00 x 2.10 m at 0.10 m; furniture table; }\n";
    text += "one" + n + ": S" + n + " : length > a" + n + " -> R" + n + " S" + next + " : 0.6;\n";
    text += "two" + n + ": S" + n + " -> split x { 3 m +- 5 cm : R" + n + ", ~ : S" + n + " } : 0.4;\n";
    text += "after two" + n + " { one" + n + " 0.7, others 0.3 }\n";
  }
  return text;
}

}  // namespace

int main(int count, char** arguments) {
  std::vector<int> sizes;
  for (int i = 1; i < count; ++i) sizes.push_back(std::atoi(arguments[i]));
  if (sizes.empty()) sizes = {1000, 2000, 5000, 10000};
  std::printf("%8s %10s %10s %8s\n", "lines", "check s", "fmt s", "faults");
  for (const int lines : sizes) {
    const std::string text = file_of(lines);
    const auto seconds = [](auto work) {
      const auto begin = std::chrono::steady_clock::now();
      work();
      return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    };
    gramap::CheckedRules checked;
    const double check_s = seconds([&] { checked = gramap::check_rules(text, "large"); });
    const double format_s = seconds([&] { gramap::format_rules(text); });
    std::printf("%8d %10.3f %10.3f %8zu\n", lines, check_s, format_s, checked.diagnostics.size());
    for (std::size_t i = 0; i < std::min<std::size_t>(3, checked.diagnostics.size()); ++i)
      std::printf("%s\n", gramap::render({checked.diagnostics[i]}, text, "large").c_str());
  }
}
