#include "app/manual.h"

namespace gramap {
namespace {

/// Text that means itself in troff: no escapes, no control line, ASCII hyphens where people copy options
/// from.
std::string troff(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (c == '\\')
      safe += "\\e";
    else if (c == '-')
      safe += "\\-";
    else
      safe += c;
  }
  return !safe.empty() && (safe[0] == '.' || safe[0] == '\'') ? "\\&" + safe : safe;
}

std::string heading(const std::string& page, const std::string& version) {
  return ".TH " + page + " 1 \"\" \"" + version + "\" \"gramap manual\"\n";
}

std::string option_names(const OptionRow& option, const char* between) {
  std::string text;
  for (const std::string& name : option.names) text += (text.empty() ? "" : between) + name;
  return text;
}

/// Text that means itself in a cell of a Markdown table.
std::string cell(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (c == '|' || c == '<' || c == '*' || c == '_') safe += '\\';
    safe += c;
  }
  return safe;
}

}  // namespace

std::string manual_page(const std::vector<VerbRow>& verbs, const std::string& version) {
  std::string page = heading("GRAMAP", version);
  page +=
      ".SH NAME\ngramap \\- noisy room scans and an interior grammar in, a complete, gap\\-free 3D floor "
      "out\n"
      ".SH SYNOPSIS\n.B gramap\n.I VERB\n[OPTIONS]\n"
      ".SH DESCRIPTION\nA grammar says what a building can look like, scans of rooms say what was seen. "
      "gramap finds the "
      "most probable complete floor that explains both and writes it as glTF.\n.PP\nThe main job:\n.PP\n.nf\n"
      "gramap fit FLOOR \\-\\-rules RULES \\-\\-scans DIR \\-o floor.glb\n.fi\n.SH VERBS\n";
  for (const VerbRow& verb : verbs)
    page += ".TP\n.B " + troff(verb.name) + "\n" + troff(verb.description) + "\n";
  page +=
      ".SH EXIT STATUS\n.TP\n.B 0\nDone: complete and verified.\n.TP\n.B 1\nThe input is at fault, said "
      "where and why; nothing "
      "was written.\n.TP\n.B 2\nWrong usage.\n.TP\n.B 3\nA defect of gramap.\n.TP\n.B 4\nWritten, but some "
      "input had to be set "
      "aside.\n.SH FILES\n.TP\n.I /usr/share/gramap/rules\nRule files, and how to write one "
      "(README.md).\n.TP\n"
      ".I /usr/share/gramap/examples\nSmall complete projects.\n.SH SEE ALSO\n";
  for (const VerbRow& verb : verbs)
    page += ".BR gramap\\-" + troff(verb.name) + " (1)" + (&verb == &verbs.back() ? "\n" : ",\n");
  return page;
}

std::string manual_page(const VerbRow& verb, const std::string& version) {
  std::string page = heading("GRAMAP-" + verb.name, version);
  page += ".SH NAME\ngramap\\-" + troff(verb.name) + " \\- " + troff(verb.description) + "\n.SH SYNOPSIS\n" +
          troff(usage_line(verb)) + "\n.SH OPTIONS\n";
  for (const OptionRow& option : verb.options) {
    page += ".TP\n\\fB" + troff(option_names(option, ", ")) + "\\fR";
    if (!option.positional && !option.argument.empty()) page += " \\fI" + troff(option.argument) + "\\fR";
    const std::string also = remarks(option);
    page += "\n" + troff(option.description) + (also.empty() ? "" : " [" + troff(also) + "]") + "\n";
  }
  return page + ".SH SEE ALSO\n.BR gramap (1)\n";
}

std::string markdown_page(const VerbRow& verb) {
  std::string page = "# gramap " + verb.name + "\n\n" + cell(verb.description) + ".\n\n```\n" +
                     usage_line(verb) + "\n```\n\n| option | takes | what it does |\n| --- | --- | --- |\n";
  for (const OptionRow& option : verb.options) {
    const std::string also = remarks(option);
    page += "| `" + option_names(option, "`, `") + "` | " + cell(option.positional ? "" : option.argument) +
            " | " + cell(option.description) + (also.empty() ? "" : " (" + cell(also) + ")") + " |\n";
  }
  return page + "\nMade by `make docs` from the options as they are declared in `app/`.\n";
}

}  // namespace gramap
