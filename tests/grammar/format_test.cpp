// The canonical form: what it is, and what holds of it for any file.
#include <doctest/doctest.h>

#include "golden.h"
#include "grammar/format.h"
#include "grammar/language.h"
#include "grammar/token.h"
#include "random_rules.h"
#include "tests/support/syntax_text.h"

namespace gramap {
namespace {

std::string format(const std::string& text) {
  const FormattedRules formatted = format_rules(text);
  if (!formatted.diagnostics.empty()) MESSAGE(render(formatted.diagnostics, text, "t"));
  REQUIRE(formatted.text.has_value());
  return *formatted.text;
}

/// All that the parser sees, but for a block's last `;`, which may be left out.
std::string tokens_of(const std::string& text) {
  std::string all;
  for (const Token& token : tokenize(text).tokens) {
    if (token.text == "}" && all.ends_with(";\n")) all.resize(all.size() - 2);
    all += token.text + "\n";
  }
  return all;
}

std::size_t comments_of(const std::string& text) {
  return tokenize(text).comments.size();
}

TEST_CASE("formatting twice is formatting once, and what is said stays the same") {
  for (unsigned seed = 0; seed < 400; ++seed) {
    const std::string text = test::RandomRules(seed).file();
    CAPTURE(seed);
    CAPTURE(text);
    const std::string once = format(text);
    CHECK(format(once) == once);
    CHECK(tokens_of(once) == tokens_of(text));
    CHECK(test::to_text(syntax::parse(once)) == test::to_text(syntax::parse(text)));
    CHECK(comments_of(once) == comments_of(text));
    const auto before = check_rules(text, "t").diagnostics;
    const auto after = check_rules(once, "t").diagnostics;
    REQUIRE(before.size() == after.size());
    for (std::size_t i = 0; i < before.size(); ++i) CHECK(before[i].message == after[i].message);
  }
}

TEST_CASE("rule files that come with gramap are in canonical form and have no faults") {
  const auto files = test::shipped_rule_files();
  REQUIRE(files.size() >= 3);
  for (const auto& file : files) {
    CAPTURE(file.string());
    const std::string text = read_file(file);
    CHECK(format(text) == text);
    for (const Diagnostic& d : check_rules(text, file.string()).diagnostics)
      FAIL_CHECK(render({d}, text, file.string()));
  }
}

TEST_CASE("the form of a careless file") {
  const std::string careless =
      "\xEF\xBB\xBF\r\n\r\ngrammar   t ;let axis=3.00 m;// from wall to wall\r\nlet a_half=axis/2 ; // and "
      "half\r\n\r\n\r\n"
      "room A{width axis−20 cm±5 cm:70 % or 2 * axis:30 %}\nroom Bath{ // small\n\twidth a_half;depth 2 m "
      "}\n\n"
      "start S;\none:S→A S:0.5 ;\nthe_other : |<S>A:length>2*axis and not facade->repeat 1 .. 3{Bath} // "
      "twice?\n S:0.25;\n"
      "unit:S->split x{ 3.8 m : split y\n{1.5 m:Bath,~ 2:A},~:S};\nbackground 2% width 1 m..12 m;";
  CHECK(format(careless) ==
        "grammar t;\nlet axis = 3.00 m;      // from wall to wall\nlet a_half = axis / 2;  // and half\n\n"
        "room A { width axis - 20 cm +- 5 cm : 70 % or 2*axis : 30 %; }\nroom Bath {\n  // small\n  width "
        "a_half;\n"
        "  depth 2 m;\n}\n\nstart S;\none: S -> A S : 0.5;\n// twice?\n"
        "the_other: | < S > A : length > 2*axis and not facade -> repeat 1..3 { Bath } S : 0.25;\n"
        "unit:      S -> split x { 3.8 m : split y { 1.5 m : Bath, "
        "~2 : A }, ~ "
        ": S };\nbackground 2 % width 1 m .. 12 m;\n");
}

TEST_CASE("a line that is too long breaks at its blocks") {
  const std::string parts =
      "Office_of_the_dean, Office_of_the_dean, Office_of_the_dean, Office_of_the_dean, Dean";
  const std::string text = format("grammar t; r: S -> string { " + parts + " } S : 0.5;");
  CHECK(text.find("r: S -> string {\n  Office_of_the_dean,\n") != std::string::npos);
  CHECK(text.find("  Dean\n} S : 0.5;\n") != std::string::npos);
  CHECK(format(text) == text);
}

TEST_CASE("a file with faults of syntax is refused, with the faults") {
  const FormattedRules formatted = format_rules("grammar t;\nroom A { width 2 m\n");
  CHECK_FALSE(formatted.text.has_value());
  CHECK(formatted.diagnostics.size() >= 1);
}

TEST_CASE("an empty file and one of comments only") {
  CHECK(format("") == "");
  CHECK(format("\n\n// nothing\n\n\n// at all") == "// nothing\n\n// at all\n");
}

}  // namespace
}  // namespace gramap
