#include <CLI/CLI.hpp>
#include <charconv>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "app/verbs.h"
#include "geometry/error.h"
#include "geometry/file.h"
#include "grammar/language.h"
#include "grammar/lengths.h"

namespace gramap {
namespace {

struct Lengths {
  double least_m = 0;
  double most_m = 0;
};

/// "A..B" in metres.
Lengths parse_lengths(const std::string& text) {
  Lengths lengths;
  const auto read = [](const std::string& number, double& value) {
    const char* const end = number.data() + number.size();
    return std::from_chars(number.data(), end, value).ptr == end && !number.empty();
  };
  const std::size_t dots = text.find("..");
  const bool sound = dots != std::string::npos && read(text.substr(0, dots), lengths.least_m) &&
                     read(text.substr(dots + 2), lengths.most_m) && lengths.least_m > 0 &&
                     lengths.most_m >= lengths.least_m && lengths.most_m <= 1000;
  if (!sound) throw CLI::ValidationError("--lengths", "write the shortest and the longest in metres: 3..40");
  return lengths;
}

constexpr double kStep_m = 0.1;

/// The lengths that cannot be filled, as faults of the file.
void add_lengths(const RuleSet& rules, const SpaceProblem& space, const Lengths& lengths,
                 std::vector<Diagnostic>& diagnostics) {
  for (const UnfillableRange& range :
       unfillable_ranges(rules, space, lengths.least_m, lengths.most_m, kStep_m)) {
    char text[120];
    std::snprintf(text, sizeof text, "no derivation fills spaces from %.2f m to %.2f m", range.first_m,
                  range.last_m);
    diagnostics.push_back({Severity::error,
                           "E0801",
                           text,
                           {0, 0},
                           {},
                           {},
                           "give the rules a room that fits, or a `background`"});
  }
}

/// Prints what the rules do with spaces of these lengths; false when some cannot be filled.
bool report_lengths(const RuleSet& rules, const std::string& path, const SpaceProblem& space,
                    const Lengths& lengths) {
  const auto ranges = unfillable_ranges(rules, space, lengths.least_m, lengths.most_m, kStep_m);
  for (const UnfillableRange& range : ranges)
    std::printf("%s: no derivation fills spaces from %.2f m to %.2f m\n", path.c_str(), range.first_m,
                range.last_m);
  if (ranges.empty())
    std::printf("%s: spaces of every length from %.2f m to %.2f m can be filled\n", path.c_str(),
                lengths.least_m, lengths.most_m);
  for (const double length_m : {lengths.least_m, (lengths.least_m + lengths.most_m) / 2, lengths.most_m}) {
    std::vector<RuleFrequency> uses;
    try {
      uses = rule_frequencies(rules, space, length_m);
    } catch (const InputError&) {
      continue;  // said above
    }
    std::printf("\nspaces of %.2f m\n%-24s %10s %10s %16s\n", length_m, "rule", "in file", "here",
                "uses a layout");
    for (std::size_t i = 0; i < uses.size(); ++i)
      std::printf("%-24s %9.1f%% %9.1f%% %16.3f\n", rules.rules[i].name.c_str(), 100 * uses[i].stated,
                  100 * uses[i].share, uses[i].expected);
    if (lengths.most_m == lengths.least_m) break;
  }
  return ranges.empty();
}

}  // namespace

Verb declare_check(CLI::App& gramap) {
  struct Options {
    std::vector<std::string> paths;
    std::string format = "text";
    std::string lengths;
    SpaceProblem space;
    bool no_facade = false;
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
  auto* lengths = verb->add_option(
      "--lengths", options->lengths,
      "A..B in metres: name the lengths of spaces between them (every 10 cm) that no derivation can fill, "
      "and, as text, how often each rule shows in spaces of lengths A, B and between, beside its number in "
      "the file");
  options->space.depth_m = 5;
  verb->add_option("--depth", options->space.depth_m, "Clear depth of the spaces of --lengths, metres")
      ->check(CLI::PositiveNumber)
      ->needs(lengths)
      ->capture_default_str();
  verb->add_option("--hallway", options->space.hallway, "The hallway that the spaces of --lengths lie on")
      ->needs(lengths);
  verb->add_flag("--no-facade", options->no_facade, "The spaces of --lengths have no façade")->needs(lengths);
  return [options] {
    bool sound = true;
    options->space.facade = !options->no_facade;
    const Lengths range = options->lengths.empty() ? Lengths() : parse_lengths(options->lengths);
    for (const std::string& path : options->paths) {
      const std::string text = read_file(path);
      CheckedRules checked = check_rules(text, path);
      sound = sound && checked.rules.has_value();
      if (options->format == "json") {
        const std::size_t faults = checked.diagnostics.size();
        if (checked.rules && !options->lengths.empty())
          add_lengths(*checked.rules, options->space, range, checked.diagnostics);
        sound = sound && checked.diagnostics.size() == faults;
        std::fputs(to_json(checked.diagnostics, text, path).c_str(), stdout);
        continue;
      }
      std::fputs(render(checked.diagnostics, text, path).c_str(), stderr);
      if (checked.rules && !options->lengths.empty())
        sound = report_lengths(*checked.rules, path, options->space, range) && sound;
    }
    return static_cast<int>(sound ? kDone : kInputFault);
  };
}

}  // namespace gramap
