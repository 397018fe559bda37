// What authors are given: the tutorial's examples and the editors' word list are held against the language
// itself.
#include <doctest/doctest.h>

#include <set>
#include <string>

#include "geometry/file.h"
#include "grammar/keywords.h"
#include "grammar/language.h"

using namespace gramap;

TEST_CASE("every complete example of the tutorial passes the check without a remark") {
  const std::string text = read_file(GRAMAP_SOURCE_DIR "/rules/README.md");
  int examples = 0;
  for (std::size_t at = 0; (at = text.find("```", at)) != std::string::npos;) {
    const std::size_t begin = text.find('\n', at) + 1, end = text.find("```", begin);
    REQUIRE(end != std::string::npos);
    const std::string block = text.substr(begin, end - begin);
    at = end + 3;
    if (block.find("grammar ") == std::string::npos || block.find("start ") == std::string::npos) continue;
    ++examples;
    const CheckedRules checked = check_rules(block, "tutorial");
    INFO(block);
    CHECK(checked.rules.has_value());
    CHECK(checked.diagnostics.empty());
  }
  CHECK(examples >= 4);
}

TEST_CASE("the highlighting knows the language's words") {
  const std::string text = read_file(GRAMAP_SOURCE_DIR "/rules/editor/gramap.tmLanguage.json");
  std::set<std::string> words;
  for (const auto& word : statement_words()) words.emplace(word);
  for (const auto& word : block_words()) words.emplace(word);
  for (const auto& word : inner_words()) words.emplace(word);
  for (const std::string& word : words) {
    INFO(word);
    CHECK((text.find("|" + word + "|") != std::string::npos ||
           text.find("(" + word + "|") != std::string::npos ||
           text.find("|" + word + ")") != std::string::npos));
  }
}
