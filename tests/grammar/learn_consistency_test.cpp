// Learning is consistent: rows derived from a shipped rule file give back rules that promise the same.
//
// GRAMAP_CONSISTENCY_FLOORS sets how many floors are derived from each file (a few by default;
// bench_consistency prints the table for 200).
#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>

#include "grammar/format.h"
#include "tests/grammar/learn_back.h"

using namespace gramap;
using namespace gramap::test;

namespace {

/// A chain of rooms does not know of conditions on the length that is left, nor of bounds on repeats: numbers
/// of rooms may differ by this share for it.
constexpr double kChain = 0.05;

int floors_to_derive() {
  const char* const asked = std::getenv("GRAMAP_CONSISTENCY_FLOORS");
  return asked ? std::max(2, std::atoi(asked)) : 30;
}

}  // namespace

TEST_CASE("rules learned from derived floors promise what the rules promised that the floors came from") {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(GRAMAP_SOURCE_DIR "/rules")) {
    if (entry.path().extension() != ".grammar") continue;
    CAPTURE(entry.path().filename().string());
    ++files;
    const Consistency found = learn_back(entry.path(), floors_to_derive());
    for (const Diagnostic& diagnostic : found.diagnostics) MESSAGE(diagnostic.message);
    CHECK(found.diagnostics.empty());
    CHECK(format_rules(found.text).text == found.text);
    for (const TypeConsistency& type : found.types) {
      CAPTURE(type.type);
      CHECK(std::abs(type.rooms.mean() - type.rooms_again.mean()) <=
            4 * standard_error(type.rooms, type.rooms_again) + kChain * type.rooms.mean());
      if (type.width_m.count < 5 || type.width_again_m.count < 5) continue;
      // How often which of a type's widths is used is a matter of numbers of rooms again.
      const double slack_m = type.has_one_width ? 0.02 : kChain * type.width_m.mean();
      CHECK(std::abs(type.width_m.mean() - type.width_again_m.mean()) <=
            4 * standard_error(type.width_m, type.width_again_m) + slack_m);
    }
  }
  CHECK(files >= 7);
}
