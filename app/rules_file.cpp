#include "app/rules_file.h"

#include <algorithm>
#include <cstdio>
#include <string>

#include "geometry/error.h"
#include "geometry/file.h"
#include "grammar/language.h"

namespace gramap {

RuleSet read_rules(const std::filesystem::path& path) {
  const std::string text = read_file(path);
  const CheckedRules checked = check_rules(text, path.string());
  std::fputs(render(checked.diagnostics, text, path.string()).c_str(), stderr);
  if (checked.rules) return *checked.rules;
  const auto errors = std::count_if(checked.diagnostics.begin(), checked.diagnostics.end(),
                                    [](const Diagnostic& d) { return d.severity == Severity::error; });
  throw InputError({path.string()},
                   std::to_string(errors) + (errors == 1 ? " error" : " errors") + " in this rule file",
                   "mend what is listed above; gramap check reads the rule file alone");
}

}  // namespace gramap
