// A rule file for the verbs that use one.
#pragma once

#include <filesystem>

#include "grammar/rules.h"

namespace gramap {

/// Reads and checks a rule file. Warnings and errors are printed on standard error, all of them; with errors,
/// throws InputError.
RuleSet read_rules(const std::filesystem::path& path);

}  // namespace gramap
