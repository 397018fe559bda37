// Text to rule set: parse, check, format. Diagnostics are data; see diagnostic.h.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "grammar/diagnostic.h"
#include "grammar/rules.h"

namespace gramap {

struct CheckedRules {
  std::optional<RuleSet> rules;         ///< none when there is an error among the diagnostics
  std::vector<Diagnostic> diagnostics;  ///< all faults of the file, in file order
};

/// Parses and checks one rule file. `name` is what diagnostics call the file.
CheckedRules check_rules(std::string_view text, const std::string& name);

}  // namespace gramap
