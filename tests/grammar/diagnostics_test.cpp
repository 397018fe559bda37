// Every diagnostic's whole text, and what holds of the diagnostics of any file.
#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "golden.h"
#include "grammar/language.h"

namespace gramap {
namespace {

const std::filesystem::path kFolder = GRAMAP_SOURCE_DIR "/tests/grammar/diagnostics";

std::string report(const std::string& text, const std::string& name) {
  return render(check_rules(text, name).diagnostics, text, name);
}

std::vector<std::string> codes(const std::string& text) {
  std::vector<std::string> result;
  for (const Diagnostic& diagnostic : check_rules(text, "t").diagnostics) result.push_back(diagnostic.code);
  return result;
}

/// The first line of the first error's text.
std::string first_line(const std::string& text) {
  for (const Diagnostic& diagnostic : check_rules(text, "t").diagnostics) {
    if (diagnostic.severity != Severity::error) continue;
    const std::string all = render({diagnostic}, text, "t");
    return all.substr(0, all.find('\n'));
  }
  return "";
}

const std::string kSound =
    "grammar t;\nroom Cell { width 2.80 m +- 5 cm; }\nstart Space;\ncells: Space -> Cell Space;\n";

TEST_CASE("every diagnostic reads as its golden file says") {
  const auto files = test::files_in(kFolder, ".grammar");
  REQUIRE(files.size() > 40);
  for (const auto& file : files) {
    const std::string name = file.filename().string();
    CAPTURE(name);
    const std::string actual = report(read_file(file), name);
    const std::string code = file.stem().string();
    if (code.size() == 5) CHECK(actual.find("[" + code + "]") != std::string::npos);
    std::filesystem::path expected = file;
    CHECK(actual == test::golden(expected.replace_extension(".txt"), actual));
  }
}

TEST_CASE("no code in the sources is without a golden file") {
  std::set<std::string> found;
  const std::regex pattern("\"([EW][0-9]{4})\"");
  for (const auto& file : test::files_in(GRAMAP_SOURCE_DIR "/grammar", ".cpp")) {
    const std::string source = read_file(file);
    for (std::sregex_iterator it(source.begin(), source.end(), pattern), end; it != end; ++it)
      found.insert((*it)[1]);
  }
  REQUIRE(found.size() > 30);
  for (const std::string& code : found) {
    CAPTURE(code);
    CHECK(std::filesystem::exists(kFolder / (code + ".grammar")));
    CHECK(std::filesystem::exists(kFolder / (code + ".txt")));
  }
}

TEST_CASE("faults come in the file's order, none twice") {
  for (const auto& file : test::files_in(kFolder, ".grammar")) {
    CAPTURE(file.string());
    const auto diagnostics = check_rules(read_file(file), "t").diagnostics;
    std::set<std::tuple<std::size_t, std::size_t, std::string>> seen;
    std::size_t last = 0;
    for (const Diagnostic& d : diagnostics) {
      CHECK(d.span.begin >= last);
      CHECK(d.span.begin <= d.span.end);
      last = d.span.begin;
      CHECK(seen.emplace(d.span.begin, d.span.end, d.code).second);
    }
  }
}

TEST_CASE("faults of all kinds in one file are all found in one run") {
  const std::string text =
      "grammar t\nlet a = 3 ft;\nroom Cell { width a +- 5 cm; wdith 3 m; }\nroom Hall { width 2,80 m; }\n"
      "start Spce;\none: Space -> Cel Space : -1;\ntwo Space -> Cell;\nthree: Space -> [Hall];\n";
  CHECK(codes(text) == std::vector<std::string>{"E0102", "E0303", "E0101", "E0003", "E0201", "E0201", "E0401",
                                                "E0101", "E0001", "E0001"});
}

TEST_CASE("a fault does not hide those behind it") {
  const std::string rooms = "room Cell { width 2.80 m +- 5 cm; }\nroom Bath { width 1.60 m +- 5 cm; }\n";
  const std::string rules =
      "never: Space -> split x { 6 m : split x { Cell, Bath } } Rest;\n"
      "wrong: Rest -> Rest Cell;\n"
      "unit: Rest -> split x { 4 m : Unit } Rest;\n"
      "asks: Unit : length > 3 m -> split x { ~ : Cell };\n"
      "deep: Unit -> split y { 4 m : Nook, ~ : Cell };\n"
      "nook: Nook -> Bath Nook Bath;\n";
  const std::string start = "grammar t;\nstart Space;\n";
  CHECK(codes(start + rooms + rules) == std::vector<std::string>{"E0702", "E0701", "E0701", "E0701"});
  // Nor does one of another kind: what names something unknown is passed over, the rest is looked at.
  CHECK(codes(start + rooms + "typo: Space -> Cel Space;\n" + rules) ==
        std::vector<std::string>{"E0201", "E0702", "E0701", "E0701", "E0701"});
  CHECK(
      codes(start +
            "let a = b;\nroom Hall { width a; }\nhall: Space -> split x { 2 m : split x { Hall } } Space;\n" +
            rooms + rules) == std::vector<std::string>{"E0202", "E0702", "E0701", "E0701", "E0701"});
}

TEST_CASE("a newcomer's twelve mistakes get twelve messages, each with what to write instead") {
  const auto diagnostics = check_rules(read_file(kFolder / "newcomer.grammar"), "t").diagnostics;
  CHECK(diagnostics.size() == 12);
  for (const Diagnostic& d : diagnostics) {
    CHECK(d.severity == Severity::error);
    CHECK_FALSE(d.help.empty());
  }
}

TEST_CASE("a missing semicolon is reported where it is missing") {
  CHECK(
      first_line(
          "grammar t;\nlet axis = 3.00 m   // metres\n\n\nroom Cell { width axis; }\nstart Space;\nc: Space "
          "-> Cell Space;\n") == "t:2:18: error[E0102]: expected `;` after `m`");
  CHECK(first_line("grammar t;\nroom Cell { width 2 m; }\nstart Space;\nc: Space -> Cell Space") ==
        "t:4:23: error[E0102]: expected `;` after `Space`");
  CHECK(
      first_line("grammar t;\nroom Cell { width 2 m depth 4 m; }\nstart Space;\nc: Space -> Cell Space;\n") ==
      "t:2:23: error[E0102]: expected `;`, found `depth`");
}

TEST_CASE("white space, line ends and characters beyond ASCII do not move the place") {
  const std::string fault = "room Bad { width 2 ft; }\n";
  const auto with = [&](const std::string& before) { return first_line(before + fault + kSound); };
  CHECK(with("").starts_with("t:1:18: error[E0303]"));
  CHECK(with("\n").starts_with("t:2:18: error[E0303]"));
  CHECK(with("\r\n\r\n").starts_with("t:3:18: error[E0303]"));
  CHECK(with("\t\t").starts_with("t:1:20: error[E0303]"));
  CHECK(with("\xEF\xBB\xBF").find("error[E0303]") != std::string::npos);
  CHECK(with("// Größe → 3 m ±\n").starts_with("t:2:18: error[E0303]"));
  CHECK(first_line("room Büro { width 2 ft; }\n" + kSound).starts_with("t:1:19: error[E0303]"));
  std::string crlf;
  for (const char c : kSound) crlf += c == '\n' ? "\r\n" : std::string(1, c);
  CHECK(check_rules(crlf, "t").diagnostics.empty());
  std::string unended = kSound;
  unended.pop_back();
  CHECK(check_rules(unended, "t").diagnostics.empty());
}

TEST_CASE("the caret stands under the fault, behind tabs and umlauts too") {
  const std::string text = "\troom Bü {\twidth 2 ft; }\n" + kSound;
  const std::string all = report(text, "t");
  CHECK(all.find("   1 | \troom Bü {\twidth 2 ft; }\n     | \t         \t      ^^^^\n") != std::string::npos);
}

TEST_CASE("deep nesting and garbage end in diagnostics, quickly") {
  const std::string open = "grammar t;\nstart S;\nr: S -> ";
  for (const int depth : {150, 300, 100000}) {
    std::string nested = open;
    for (int i = 0; i < depth; ++i) nested += "repeat { ";
    CHECK(!check_rules(nested, "t").diagnostics.empty());
  }
  std::string brackets = "let a = " + std::string(100000, '(');
  CHECK(!check_rules(brackets, "t").diagnostics.empty());
  std::string signs = "grammar t;\nlet a = " + std::string(100000, '-') + "3 m;\n";
  check_rules(signs, "t");
  CHECK(check_rules(std::string("grammar t;\0\0", 12), "t").diagnostics.size() > 0);
  std::string sum = "grammar t;\nlet a = 1";
  for (int i = 0; i < 100000; ++i) sum += "+1";
  const auto of_sum = codes(sum + ";\n");
  CHECK(std::count(of_sum.begin(), of_sum.end(), "E0006") == 1);
  std::string garbage;
  unsigned state = 1;
  for (int i = 0; i < 5000; ++i) garbage += static_cast<char>((state = state * 1664525 + 1013904223) >> 24);
  const auto diagnostics = check_rules(garbage, "t").diagnostics;
  CHECK(!diagnostics.empty());
  for (const Diagnostic& d : diagnostics) CHECK(render({d}, garbage, "t").size() < 2000);
}

TEST_CASE("diagnostics are data, too") {
  const std::string text = "grammar t;\n" + kSound.substr(11) + "let é = 3 m;\n";
  const auto checked = check_rules(text, "t");
  const auto json = nlohmann::json::parse(to_json(checked.diagnostics, text, "t"));
  REQUIRE(json.size() == 1);
  CHECK(json[0]["code"] == "W0204");
  CHECK(json[0]["severity"] == "warning");
  CHECK(json[0]["span"]["start"]["line"] == 5);
  CHECK(json[0]["span"]["start"]["column"] == 5);
  CHECK(json[0]["span"]["end"]["column"] == 6);
  CHECK(json[0]["help"] == "use it or remove it");
}

}  // namespace
}  // namespace gramap
