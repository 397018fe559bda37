// The command's verbs and options as plain rows, read back from where they are declared: what --help, the
// manual pages and the shell completions are all made from, so that none can say something else.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace gramap {

struct OptionRow {
  std::vector<std::string> names;    ///< "-o", "--output"; the bare name of a positional
  std::string argument;              ///< TEXT, NUMBER, or the choices joined by |; empty for a flag
  std::vector<std::string> choices;  ///< when only these are taken
  std::string range;                 ///< what a number must be: "> 0", "0.3 to 3"; or empty
  std::string default_value;
  std::string description;
  bool positional = false, required = false, repeated = false;
};

struct VerbRow {
  std::string name, description;
  std::vector<OptionRow> options;  ///< positionals first
};

OptionRow option_row(const CLI::Option& option);

/// All verbs but the hidden ones, by name.
std::vector<VerbRow> option_table(const CLI::App& gramap);

/// "gramap fit [OPTIONS] FLOOR"
std::string usage_line(const VerbRow& verb);

/// The remarks in brackets after a description: "required; default: 0.25; > 0"; or empty.
std::string remarks(const OptionRow& option);

/// Makes --help print the rows, here and in every verb declared afterwards.
void set_help(CLI::App& gramap);

}  // namespace gramap
