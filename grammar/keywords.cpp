#include "grammar/keywords.h"

#include <algorithm>

namespace gramap {
namespace {

constexpr std::string_view kStatementWords[] = {"grammar", "let",   "wall",       "height",  "room",
                                                "start",   "after", "background", "hallways"};
constexpr std::string_view kBlockWords[] = {"width", "depth", "door", "windows", "furniture", "axiom"};
constexpr std::string_view kInnerWords[] = {
    "inner", "outer", "at",  "from",   "end", "or",   "sill",     "every", "split",  "repeat",  "string",
    "merge", "as",    "and", "others", "not", "left", "straight", "right", "length", "hallway", "facade"};
constexpr std::string_view kUnits[] = {"m", "cm", "mm"};

}  // namespace

Words statement_words() {
  return kStatementWords;
}
Words block_words() {
  return kBlockWords;
}
Words inner_words() {
  return kInnerWords;
}
Words units() {
  return kUnits;
}

bool is_among(Words words, std::string_view word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

bool is_keyword(std::string_view word) {
  return is_among(kStatementWords, word) || is_among(kBlockWords, word) || is_among(kInnerWords, word);
}

}  // namespace gramap
