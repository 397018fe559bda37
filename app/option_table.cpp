#include "app/option_table.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <sstream>

namespace gramap {
namespace {

/// The choices in what CLI11 calls the type of an option: "TEXT:{m,cm}", "ENUM:value in {auto->0,room->1} OR
/// {0,1}".
std::vector<std::string> choices_in(const std::string& type) {
  std::vector<std::string> choices;
  const std::size_t open = type.find('{'), close = type.find('}');
  if (open == std::string::npos || close == std::string::npos) return choices;
  std::istringstream list(type.substr(open + 1, close - open - 1));
  for (std::string choice; std::getline(list, choice, ',');)
    choices.push_back(choice.substr(0, choice.find("->")));
  return choices;
}

/// What a number must be: "FLOAT:FLOAT in [0.3 - 3]", "INT:POSITIVE".
std::string range_in(const std::string& type) {
  if (type.find("NONNEGATIVE") != std::string::npos) return "at least 0";
  if (type.find("POSITIVE") != std::string::npos) return "more than 0";
  const std::size_t open = type.find('['), close = type.find(']');
  if (open == std::string::npos || close == std::string::npos) return "";
  std::string range = type.substr(open + 1, close - open - 1);
  const std::size_t dash = range.find(" - ");
  return dash == std::string::npos ? range : range.replace(dash, 3, " to ");
}

std::string joined(const std::vector<std::string>& parts, const char* between) {
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : between) + part;
  return text;
}

std::string argument_of(const std::string& type, const std::vector<std::string>& choices) {
  if (!choices.empty()) return joined(choices, "|");
  if (type.starts_with("FLOAT")) return "NUMBER";
  if (type.starts_with("INT") || type.starts_with("UINT")) return "N";
  return "TEXT";
}

std::string upper(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](char c) { return c >= 'a' && c <= 'z' ? c - 32 : c; });
  return text;
}

/// CLI11's layout, with the rows' words in it.
class Help : public CLI::Formatter {
 public:
  std::string make_option_opts(const CLI::Option* option) const override {
    const OptionRow row = option_row(*option);
    return row.positional || row.argument.empty() ? "" : " " + row.argument + (row.repeated ? " ..." : "");
  }
  std::string make_option_desc(const CLI::Option* option) const override {
    const OptionRow row = option_row(*option);
    const std::string also = remarks(row);
    return row.description + (also.empty() ? "" : " [" + also + "]");
  }
};

}  // namespace

OptionRow option_row(const CLI::Option& option) {
  OptionRow row;
  row.positional = option.get_positional();
  if (row.positional) {
    row.names = {option.get_name(true)};
  } else {
    for (const std::string& name : option.get_snames()) row.names.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) row.names.push_back("--" + name);
  }
  row.required = option.get_required();
  row.description = option.get_description();
  if (option.get_items_expected_max() == 0) return row;  // a flag
  const std::string type = option.get_type_name();
  row.choices = choices_in(type);
  row.range = range_in(type);
  row.argument = argument_of(type, row.choices);
  row.default_value = option.get_default_str();
  row.repeated = option.get_expected_max() > 1;
  return row;
}

std::vector<VerbRow> option_table(const CLI::App& gramap) {
  std::vector<VerbRow> verbs;
  for (const CLI::App* app : gramap.get_subcommands([](const CLI::App*) { return true; })) {
    if (app->get_group().empty()) continue;
    VerbRow verb{app->get_name(), app->get_description(), {}};
    for (const CLI::Option* option : app->get_options()) verb.options.push_back(option_row(*option));
    std::stable_partition(verb.options.begin(), verb.options.end(),
                          [](const OptionRow& row) { return row.positional; });
    verbs.push_back(std::move(verb));
  }
  std::sort(verbs.begin(), verbs.end(), [](const VerbRow& a, const VerbRow& b) { return a.name < b.name; });
  return verbs;
}

std::string usage_line(const VerbRow& verb) {
  std::string line = "gramap " + verb.name;
  for (const OptionRow& option : verb.options) {
    if (!option.positional) continue;
    const std::string name = upper(option.names[0]) + (option.repeated ? "..." : "");
    line += option.required ? " " + name : " [" + name + "]";
  }
  for (const OptionRow& option : verb.options)
    if (!option.positional && option.required)
      line += " " + option.names.front() + (option.argument.empty() ? "" : " " + option.argument);
  return line + " [OPTIONS]";
}

std::string remarks(const OptionRow& option) {
  std::vector<std::string> parts;
  if (option.required) parts.push_back("required");
  if (!option.range.empty()) parts.push_back(option.range);
  if (!option.default_value.empty() && option.default_value != "\"\"" && option.default_value != "[]")
    parts.push_back("default: " + option.default_value);
  return joined(parts, "; ");
}

void set_help(CLI::App& gramap) {
  gramap.formatter(std::make_shared<Help>());
}

}  // namespace gramap
