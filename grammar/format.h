// The canonical form of a rule file.
//
// Each statement begins a line. A block stays on its statement's line if it was written so and the line is at
// most 110 characters long; otherwise each of its parts has a line of its own, two spaces in. Neighbouring
// rules, rooms and `after` blocks stand in columns, and so do comments behind neighbouring statements. One
// empty line at most is kept between statements. Comments are kept: one within a statement moves before it.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "grammar/diagnostic.h"

namespace gramap {

struct FormattedRules {
  std::optional<std::string> text;      ///< none when the file cannot be read as a rule file
  std::vector<Diagnostic> diagnostics;  ///< why
};

/// Text in, canonical text out; only the syntax has to be right.
FormattedRules format_rules(std::string_view text);

}  // namespace gramap
