// Any bytes as a rule file: parse, check, format, derive. What has to hold: no crash, diagnostics that lie in
// the file and can be rendered, fmt(fmt(x)) = fmt(x), parse(fmt(x)) = parse(x), and layouts that fill their
// space exactly.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "geometry/error.h"
#include "grammar/derive.h"
#include "grammar/format.h"
#include "grammar/language.h"
#include "tests/support/syntax_text.h"

namespace {

using namespace gramap;

constexpr double kLength_m = 12;

void require(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "does not hold: %s\n", what);
  std::abort();
}

void check_diagnostics(const std::vector<Diagnostic>& diagnostics, const std::string& text) {
  std::size_t last = 0;
  for (const Diagnostic& d : diagnostics) {
    require(last <= d.span.begin && d.span.begin <= d.span.end && d.span.end <= text.size(),
            "spans in order");
    last = d.span.begin;
    require(!d.message.empty() && !render({d}, text, "fuzz").empty(), "a message");
  }
  to_json(diagnostics, text, "fuzz");
}

void check_format(const std::string& text) {
  const FormattedRules once = format_rules(text);
  if (!once.text) return;
  const FormattedRules twice = format_rules(*once.text);
  require(twice.text && *twice.text == *once.text, "fmt(fmt(x)) = fmt(x)");
  require(test::to_text(syntax::parse(*once.text)) == test::to_text(syntax::parse(text)),
          "parse(fmt(x)) = parse(x)");
}

void check_derive(const RuleSet& rules) {
  SpaceProblem space;
  space.id = "space";
  space.length_m = kLength_m;
  space.depth_m = 5;
  try {
    const SpaceDeriver deriver(rules, space, 0.05);
    for (const Derivation& derivation : deriver.draw(3, 1)) {
      int cells = 0;
      for (const PathStep& step : derivation.path) cells += step.width;
      require(cells == deriver.lattice().grid().cells, "a layout fills its space");
      double end_m = 0;
      for (const PlacedRoom& room : derivation.rooms) {
        require(std::isfinite(room.width_m) && room.width_m > 0, "a room has a width");
        end_m = std::max(end_m, room.start_m + room.width_m);
      }
      require(std::abs(end_m - kLength_m) < 1e-9, "the last room ends with the space");
    }
  } catch (const InputError&) {  // no layout fills this length
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  const CheckedRules checked = check_rules(text, "fuzz");
  check_diagnostics(checked.diagnostics, text);
  check_format(text);
  if (checked.rules) check_derive(*checked.rules);
  return 0;
}
