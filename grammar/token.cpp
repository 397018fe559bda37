#include "grammar/token.h"

#include <array>
#include <charconv>

namespace gramap {
namespace {

/// Longest first, so that the first match is the right one. The second spelling is the token's text.
struct Spelling {
  std::string_view written, text;
};
constexpr std::array<Spelling, 30> kSymbols = {{
    {"→", "->"},  {"±", "+-"},  {"−", "-"},   {"×", "x"},   {"≤", "<="},  {"≥", ">="},
    {"->", "->"}, {"+-", "+-"}, {"..", ".."}, {"<=", "<="}, {">=", ">="}, {"==", "=="},
    {"!=", "!="}, {"{", "{"},   {"}", "}"},   {"(", "("},   {")", ")"},   {",", ","},
    {";", ";"},   {":", ":"},   {"|", "|"},   {"<", "<"},   {">", ">"},   {"=", "="},
    {"+", "+"},   {"-", "-"},   {"*", "*"},   {"/", "/"},   {"%", "%"},   {"~", "~"},
}};

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' ||
         static_cast<unsigned char>(c) >= 0x80;
}

/// Bytes of the well-formed UTF-8 character at the head of `text`, 0 if it is not one.
std::size_t utf8_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned lead = byte(0);
  const std::size_t length = lead < 0x80   ? 1
                             : lead < 0xC2 ? 0
                             : lead < 0xE0 ? 2
                             : lead < 0xF0 ? 3
                             : lead < 0xF5 ? 4
                                           : 0;
  if (length == 0 || length > text.size()) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if ((byte(i) & 0xC0U) != 0x80U) return 0;
  if ((lead == 0xE0 && byte(1) < 0xA0) || (lead == 0xED && byte(1) > 0x9F) ||
      (lead == 0xF0 && byte(1) < 0x90) || (lead == 0xF4 && byte(1) > 0x8F))
    return 0;
  return length;
}

class Lexer {
 public:
  explicit Lexer(std::string_view text) : text_(text) {}

  Tokens run() {
    if (rest().starts_with("\xEF\xBB\xBF")) at_ += 3;  // byte order mark
    while (at_ < text_.size()) step();
    push(Token::Kind::end, at_, "");
    return std::move(out_);
  }

 private:
  std::string_view rest() const { return text_.substr(at_); }
  char peek(std::size_t ahead) const { return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0'; }

  void push(Token::Kind kind, std::size_t begin, std::string text, double number = 0) {
    out_.tokens.push_back({kind, {begin, at_}, std::move(text), number, line_start_});
    line_start_ = false;
  }

  void fault(std::size_t begin, std::string code, std::string message, std::string help) {
    out_.diagnostics.push_back(
        {Severity::error, std::move(code), std::move(message), {begin, at_}, {}, {}, std::move(help)});
  }

  void skip_line() {
    while (at_ < text_.size() && text_[at_] != '\n') ++at_;
  }

  void step() {
    const char c = text_[at_];
    if (c == '\n') {
      line_start_ = true;
      ++at_;
    } else if (c == ' ' || c == '\t' || c == '\r' || c == '\f' || c == '\v') {
      ++at_;
    } else if (rest().starts_with("\xC2\xA0")) {  // no-break space, from pasted text
      at_ += 2;
    } else if (rest().starts_with("//")) {
      comment();
    } else if (is_digit(c) || (c == '.' && is_digit(peek(1)))) {
      number();
    } else if (c == '"') {
      quoted();
    } else if (!symbol()) {
      is_letter(c) ? word() : unknown();
    }
  }

  void comment() {
    const std::size_t begin = at_;
    skip_line();
    std::size_t end = at_;
    while (end > begin && (text_[end - 1] == '\r' || text_[end - 1] == ' ' || text_[end - 1] == '\t')) --end;
    out_.comments.push_back({{begin, end}, out_.tokens.size()});
  }

  void number() {
    const std::size_t begin = at_;
    while (is_digit(peek(0))) ++at_;
    std::string digits(text_.substr(begin, at_ - begin));
    const bool comma = peek(0) == ',' && is_digit(peek(1));
    if (comma || (peek(0) == '.' && is_digit(peek(1)))) {
      digits += '.';
      for (++at_; is_digit(peek(0)); ++at_) digits += peek(0);
    }
    double value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (comma) fault(begin, "E0003", "a number is written with a decimal point", "write `" + digits + "`");
    if (error != std::errc()) {
      fault(begin, "E0004", "this number is too large or too small to be stored",
            "lengths are in metres, `cm` or `mm`");
      value = 1;  // so that nothing is said of its value on top
    }
    push(Token::Kind::number, begin, std::move(digits), value);
  }

  void quoted() {
    const std::size_t begin = at_++;
    while (at_ < text_.size() && text_[at_] != '"' && text_[at_] != '\n' && text_[at_] != '\r') ++at_;
    std::string content(text_.substr(begin + 1, at_ - begin - 1));
    if (peek(0) == '"') {
      ++at_;
      push(Token::Kind::text, begin, std::move(content));
    } else {
      fault(begin, "E0002", "this text has no closing quote on its line", "end it with `\"`");
      push(Token::Kind::bad, begin, "");
    }
  }

  bool symbol() {
    for (const Spelling& symbol : kSymbols) {
      if (!rest().starts_with(symbol.written)) continue;
      const std::size_t begin = at_;
      at_ += symbol.written.size();
      push(symbol.text == "x" ? Token::Kind::name : Token::Kind::symbol, begin, std::string(symbol.text));
      return true;
    }
    return false;
  }

  void word() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && (is_letter(text_[at_]) || is_digit(text_[at_]))) {
      const std::size_t length = utf8_length(rest());
      if (length == 0) {
        if (at_ == begin) return not_utf8();
        break;
      }
      if (length > 1 && at_ > begin && is_symbol_ahead()) break;
      at_ += length;
    }
    push(Token::Kind::name, begin, std::string(text_.substr(begin, at_ - begin)));
  }

  bool is_symbol_ahead() const {
    for (const Spelling& symbol : kSymbols)
      if (rest().starts_with(symbol.written)) return true;
    return rest().starts_with("\xC2\xA0");
  }

  void not_utf8() {
    const std::size_t begin = at_++;
    fault(begin, "E0005", "the file is not UTF-8 text here", "save the file as UTF-8");
    push(Token::Kind::bad, begin, "");
  }

  void unknown() {
    const std::size_t begin = at_;
    if (text_[at_] == '#') {
      ++at_;
      fault(begin, "E0001", "`#` is not part of the language", "a comment begins with `//`");
      return skip_line();
    }
    ++at_;
    const std::string_view bad = text_.substr(begin, 1);
    const bool printable = bad[0] >= ' ' && bad[0] < 0x7F;
    std::string help;
    if (bad == "'") help = "write texts in double quotes: \"west\"";
    if (bad == "[" || bad == "]") help = "blocks are written with `{` and `}`";
    if (bad == "&") help = "write `and` between two conditions";
    if (bad == "!") help = "write `not` before a condition, and `!=` for unequal";
    if (bad == "^") help = "write a product: `axis * 2`";
    fault(begin, "E0001",
          printable ? "`" + std::string(bad) + "` is not part of the language"
                    : "a control character is not part of the language",
          help);
    while (at_ < text_.size() && text_[at_] == bad[0]) ++at_;
    push(Token::Kind::bad, begin, "");
  }

  std::string_view text_;
  std::size_t at_ = 0;
  bool line_start_ = true;
  Tokens out_;
};

}  // namespace

Tokens tokenize(std::string_view text) {
  return Lexer(text).run();
}

}  // namespace gramap
