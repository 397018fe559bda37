// The words of the rule language: the one table that the parser, the formatter and the editor's highlighting
// share.
#pragma once

#include <algorithm>
#include <array>
#include <string_view>

namespace gramap {

/// Words that begin a statement of the file.
inline constexpr std::array<std::string_view, 9> kStatementWords = {
    "grammar", "let", "wall", "height", "room", "start", "after", "background", "hallways"};

/// Words that begin a statement inside a room or hallways block.
inline constexpr std::array<std::string_view, 6> kBlockWords = {"width",   "depth",     "door",
                                                                "windows", "furniture", "axiom"};

/// Words within a statement.
inline constexpr std::array<std::string_view, 22> kInnerWords = {
    "inner", "outer", "at",  "from",   "end", "or",   "sill",     "every", "split",  "repeat",  "string",
    "merge", "as",    "and", "others", "not", "left", "straight", "right", "length", "hallway", "facade"};

/// The units of a number; they are words only directly behind one.
inline constexpr std::array<std::string_view, 3> kUnits = {"m", "cm", "mm"};

template <std::size_t N>
constexpr bool is_among(const std::array<std::string_view, N>& words, std::string_view word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// True for a word that cannot be the name of something.
constexpr bool is_keyword(std::string_view word) {
  return is_among(kStatementWords, word) || is_among(kBlockWords, word) || is_among(kInnerWords, word);
}

}  // namespace gramap
