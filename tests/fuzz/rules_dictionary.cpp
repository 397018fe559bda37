// Prints the language's words and symbols as a dictionary for libFuzzer.
#include <cstdio>
#include <string_view>

#include "grammar/keywords.h"

int main() {
  const auto print = [](std::string_view word) {
    std::printf("\"%.*s\"\n", static_cast<int>(word.size()), word.data());
  };
  for (const std::string_view word : gramap::statement_words()) print(word);
  for (const std::string_view word : gramap::block_words()) print(word);
  for (const std::string_view word : gramap::inner_words()) print(word);
  for (const std::string_view word : gramap::units()) print(word);
  for (const char* symbol :
       {"->", "+-", "..", "<=", ">=", "==", "!=", "~", "|", "//", "%", "{ ", " }", "; ", ", ", " : "})
    print(symbol);
}
