// Prints the language's words and symbols as a dictionary for libFuzzer.
#include <cstdio>
#include <string_view>

#include "grammar/keywords.h"

int main() {
  const auto print = [](std::string_view word) {
    std::printf("\"%.*s\"\n", static_cast<int>(word.size()), word.data());
  };
  for (const std::string_view word : gramap::kStatementWords) print(word);
  for (const std::string_view word : gramap::kBlockWords) print(word);
  for (const std::string_view word : gramap::kInnerWords) print(word);
  for (const std::string_view word : gramap::kUnits) print(word);
  for (const char* symbol :
       {"->", "+-", "..", "<=", ">=", "==", "!=", "~", "|", "//", "%", "{ ", " }", "; ", ", ", " : "})
    print(symbol);
}
