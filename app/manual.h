// The command's manual, made from the option table.
#pragma once

#include <string>
#include <vector>

#include "app/option_table.h"

namespace gramap {

/// gramap.1: what it is, its verbs, its exit codes. `version` as in "gramap 0.1.0".
std::string manual_page(const std::vector<VerbRow>& verbs, const std::string& version);

/// gramap-VERB.1
std::string manual_page(const VerbRow& verb, const std::string& version);

/// docs/verbs/VERB.md
std::string markdown_page(const VerbRow& verb);

}  // namespace gramap
