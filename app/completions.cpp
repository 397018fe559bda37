#include "app/completions.h"

namespace gramap {
namespace {

std::string joined(const std::vector<std::string>& parts, const char* between) {
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : between) + part;
  return text;
}

/// Text inside single quotes of a shell; `also` are characters that mean something there to the completion
/// system.
std::string quoted(const std::string& text, const std::string& also = "") {
  std::string safe;
  for (const char c : text) {
    if (c == '\'')
      safe += "'\\''";
    else if (also.find(c) != std::string::npos)
      safe += std::string("\\") + c;
    else
      safe += c;
  }
  return "'" + safe + "'";
}

}  // namespace

std::string bash_completions(const std::vector<VerbRow>& verbs) {
  std::string verb_names, cases;
  for (const VerbRow& verb : verbs) {
    verb_names += (verb_names.empty() ? "" : " ") + verb.name;
    std::string words, choices;
    for (const OptionRow& option : verb.options) {
      if (option.positional) continue;
      words += (words.empty() ? "" : " ") + joined(option.names, " ");
      if (!option.choices.empty())
        choices +=
            "        " + joined(option.names, "|") + ") words='" + joined(option.choices, " ") + "' ;;\n";
    }
    cases += "    " + verb.name + ")\n      words='" + words + "'\n";
    if (!choices.empty()) cases += "      case $before in\n" + choices + "      esac\n";
    cases += "      ;;\n";
  }
  return "# bash completion for gramap\n"
         "_gramap() {\n"
         "  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} words\n"
         "  COMPREPLY=()\n"
         "  if [ \"$COMP_CWORD\" -eq 1 ]; then\n"
         "    COMPREPLY=($(compgen -W '" +
         verb_names +
         " --help --version' -- \"$word\"))\n"
         "    return\n"
         "  fi\n"
         "  case ${COMP_WORDS[1]} in\n" +
         cases +
         "  esac\n"
         "  case $word in\n"
         "    -*) ;;\n"
         "    *) case $words in -*) return ;; esac ;;  # a file\n"
         "  esac\n"
         "  COMPREPLY=($(compgen -W \"$words\" -- \"$word\"))\n"
         "}\n"
         "complete -o default -F _gramap gramap\n";
}

std::string zsh_completions(const std::vector<VerbRow>& verbs) {
  std::string names, cases;
  for (const VerbRow& verb : verbs) {
    names += "    " + quoted(verb.name + ":" + verb.description) + "\n";
    cases += "    " + verb.name + ") _arguments";
    for (const OptionRow& option : verb.options) {
      if (option.positional) continue;
      std::string action;
      if (!option.choices.empty())
        action = ":value:(" + joined(option.choices, " ") + ")";
      else if (!option.argument.empty())
        action = option.argument == "TEXT" ? ":file:_files" : ":number:";
      const std::string others = option.names.size() > 1 ? "(" + joined(option.names, " ") + ")" : "";
      for (const std::string& name : option.names)
        cases += " \\\n      " + quoted(others) + name + quoted("[" + option.description + "]" + action, "");
    }
    cases += " \\\n      '*:file:_files' ;;\n";
  }
  return "#compdef gramap\n"
         "_gramap_verbs=(\n" +
         names +
         ")\n"
         "if (( CURRENT == 2 )); then\n"
         "  _describe verb _gramap_verbs\n"
         "else\n"
         "  local verb=$words[2]\n"
         "  shift words\n"
         "  (( CURRENT-- ))\n"
         "  case $verb in\n" +
         cases +
         "  esac\n"
         "fi\n";
}

std::string fish_completions(const std::vector<VerbRow>& verbs) {
  std::string text = "# fish completion for gramap\n";
  for (const VerbRow& verb : verbs)
    text += "complete -c gramap -n __fish_use_subcommand -f -a " + verb.name + " -d " +
            quoted(verb.description) + "\n";
  for (const VerbRow& verb : verbs)
    for (const OptionRow& option : verb.options) {
      if (option.positional) continue;
      text += "complete -c gramap -n '__fish_seen_subcommand_from " + verb.name + "'";
      for (const std::string& name : option.names)
        text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
      if (!option.choices.empty())
        text += " -x -a '" + joined(option.choices, " ") + "'";
      else if (!option.argument.empty())
        text += option.argument == "TEXT" ? " -r" : " -x";
      text += " -d " + quoted(option.description) + "\n";
    }
  return text;
}

}  // namespace gramap
