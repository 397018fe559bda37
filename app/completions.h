// Completions of verbs, options and their choices for the common shells, made from the option table.
#pragma once

#include <string>
#include <vector>

#include "app/option_table.h"

namespace gramap {

std::string bash_completions(const std::vector<VerbRow>& verbs);
std::string zsh_completions(const std::vector<VerbRow>& verbs);
std::string fish_completions(const std::vector<VerbRow>& verbs);

}  // namespace gramap
