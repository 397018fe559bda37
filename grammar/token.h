// Rule file text to tokens, each with its bytes. Comments and blank lines are kept aside for the formatter.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "grammar/diagnostic.h"

namespace gramap {

struct Token {
  enum class Kind { name, number, text, symbol, bad, end };
  Kind kind = Kind::end;
  Span span;
  std::string text;   ///< a name, a symbol in its ASCII spelling, a number as written, a text's content
  double number = 0;  ///< value of a number
  bool starts_line = false;  ///< nothing but white space (and comments) before it on its line
};

struct Comment {
  Span span;              ///< from `//` to the end of the line
  std::size_t token = 0;  ///< index of the token that follows
};

struct Tokens {
  std::vector<Token> tokens;  ///< the last one is of kind `end`
  std::vector<Comment> comments;
  std::vector<Diagnostic> diagnostics;
};

/// Never fails: what is no token is reported and becomes a token of kind `bad`.
Tokens tokenize(std::string_view text);

}  // namespace gramap
