// The words of the rule language: the one table that the parser, the formatter and the editor's highlighting
// share. It lies in keywords.cpp, so that a new word compiles that file and the parser alone.
#pragma once

#include <span>
#include <string_view>

namespace gramap {

using Words = std::span<const std::string_view>;

/// Words that begin a statement of the file.
Words statement_words();
/// Words that begin a statement inside a room or hallways block.
Words block_words();
/// Words within a statement.
Words inner_words();
/// The units of a number; they are words only directly behind one.
Words units();

bool is_among(Words words, std::string_view word);

/// True for a word that cannot be the name of something.
bool is_keyword(std::string_view word);

}  // namespace gramap
