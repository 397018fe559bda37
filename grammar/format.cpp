#include "grammar/format.h"

#include <algorithm>
#include <utility>

#include "grammar/keywords.h"
#include "grammar/syntax.h"
#include "grammar/token.h"

namespace gramap {
namespace {

constexpr std::size_t kLongestLine = 110;
constexpr std::size_t kIndent = 2;

std::size_t characters(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

// ---- tokens side by side

bool is(const Token& token, std::string_view text) {
  return token.text == text && (token.kind == Token::Kind::symbol || token.kind == Token::Kind::name);
}

bool is_number(const Token& token) {
  return token.kind == Token::Kind::number;
}

/// Something that a sign behind it is subtracted from.
bool is_operand(const Token& token) {
  if (is_number(token) || token.kind == Token::Kind::text) return true;
  if (token.kind == Token::Kind::symbol) return token.text == ")" || token.text == "%";
  return !is_keyword(token.text) || token.text == "length" || token.text == "depth" ||
         token.text == "hallway" || token.text == "facade";
}

/// Whether a space stands before tokens[i]. A count's bounds and a factor stand close (`1..8`, `2*axis`);
/// what has a unit does not (`1 m .. 12 m`).
bool has_space(const std::vector<Token>& tokens, std::size_t i, bool is_rule) {
  const Token& a = tokens[i - 1];
  const Token& b = tokens[i];
  if (is(b, ";") || is(b, ",") || is(b, ")") || is(a, "(")) return false;
  if (is_rule && i == 1) return false;  // the colon behind the rule's name
  if (is(a, "{") && is(b, "}")) return false;
  if (is(a, "~")) return is(b, ":") || (i > 1 && is(tokens[i - 2], "straight"));
  if (is(a, "-") && (i < 2 || !is_operand(tokens[i - 2]))) return false;
  if (is(b, "..")) return !is_number(a);
  if (is(a, "..")) return i < 2 || !is_number(tokens[i - 2]) || is(b, "{");
  if (is(b, "*")) return !is_number(a) || i + 1 >= tokens.size() || tokens[i + 1].kind != Token::Kind::name;
  if (is(a, "*")) return i < 2 || !is_number(tokens[i - 2]) || b.kind != Token::Kind::name;
  return true;
}

// ---- lines

struct Line {
  enum class Kind { other, rule, room, after };
  Kind kind = Kind::other;  ///< of a statement that is one line: neighbours of a kind stand in columns
  std::size_t indent = 0;
  std::vector<std::string> cells;
  std::string comment;
  bool blank_before = false;
};

class Layout {
 public:
  Layout(std::string_view text, const Tokens& source)
      : text_(text), tokens_(source.tokens), comments_(source.comments) {}

  std::vector<Line> run() {
    const std::size_t end = tokens_.size() - 1;
    for (std::size_t begin = 0; begin < end;) {
      const std::size_t next = statement_end(begin);
      item(begin, next, 0, false);
      begin = next;
    }
    comments_until(end + 1, 0);
    return std::move(lines_);
  }

 private:
  bool is_block_statement(std::size_t begin) const {
    return is(tokens_[begin], "room") || is(tokens_[begin], "after") || is(tokens_[begin], "hallways");
  }

  std::size_t statement_end(std::size_t begin) const {
    const bool ends_with_block = is_block_statement(begin);
    int depth = 0;
    for (std::size_t i = begin; i + 1 < tokens_.size(); ++i) {
      if (is(tokens_[i], "{")) ++depth;
      if (is(tokens_[i], "}") && --depth == 0 && ends_with_block) return i + 1;
      if (is(tokens_[i], ";") && depth == 0) return i + 1;
    }
    return tokens_.size() - 1;
  }

  std::size_t closing(std::size_t open) const {
    int depth = 0;
    for (std::size_t i = open;; ++i) {
      if (is(tokens_[i], "{")) ++depth;
      if (is(tokens_[i], "}") && --depth == 0) return i;
    }
  }

  /// First comment that stands before token `token` or a later one.
  std::size_t first_comment(std::size_t token) const {
    return static_cast<std::size_t>(std::partition_point(comments_.begin(), comments_.end(),
                                                         [&](const Comment& c) { return c.token < token; }) -
                                    comments_.begin());
  }

  bool has_line_break(std::size_t begin, std::size_t end) const {
    return text_.substr(begin, end - begin).find('\n') != std::string_view::npos;
  }

  bool has_blank_line(std::size_t begin, std::size_t end) const {
    const auto between = text_.substr(begin, end - begin);
    return std::count(between.begin(), between.end(), '\n') > 1;
  }

  bool has_to_break(std::size_t open) const {
    const std::size_t close = closing(open);
    for (std::size_t i = open; i < close; ++i)
      if (is(tokens_[i], "{") && tokens_[i + 1].starts_line && i + 1 < closing(i)) return true;
    return first_comment(open + 1) < first_comment(close + 1);
  }

  void comment_line(const Comment& comment, std::size_t indent) {
    Line line;
    line.indent = indent;
    line.cells.emplace_back(text_.substr(comment.span.begin, comment.span.end - comment.span.begin));
    line.blank_before = has_blank_line(last_, comment.span.begin) && !at_block_start_;
    at_block_start_ = false;
    last_ = comment.span.end;
    lines_.push_back(std::move(line));
  }

  /// The comments not yet written that stand before a token below `token`.
  void comments_until(std::size_t token, std::size_t indent) {
    for (; next_comment_ < comments_.size() && comments_[next_comment_].token < token; ++next_comment_)
      comment_line(comments_[next_comment_], indent);
  }

  /// A comment that follows on the line of the token before `end`.
  void trailing_comment(std::size_t end) {
    if (next_comment_ >= comments_.size() || comments_[next_comment_].token != end) return;
    const Span span = comments_[next_comment_].span;
    if (has_line_break(tokens_[end - 1].span.end, span.begin)) return;
    lines_.back().comment = text_.substr(span.begin, span.end - span.begin);
    last_ = span.end;
    ++next_comment_;
  }

  /// A statement, or a part of a block with its separator: tokens [begin, end).
  void item(std::size_t begin, std::size_t end, std::size_t indent, bool needs_semicolon) {
    comments_until(begin + 1, indent);
    Line line;
    line.indent = indent;
    line.blank_before = has_blank_line(last_, tokens_[begin].span.begin) && !at_block_start_ && begin > 0;
    at_block_start_ = false;

    std::vector<std::size_t> breaking;
    std::vector<std::size_t> blocks;
    for (std::size_t i = begin; i < end; ++i) {
      if (!is(tokens_[i], "{")) continue;
      blocks.push_back(i);
      if (is(tokens_[begin], "hallways") || has_to_break(i)) breaking.push_back(i);
      i = closing(i);
    }
    hoist_comments(begin, end, breaking, line);

    const bool is_statement = indent == 0;
    const bool is_rule = (is_statement || in_hallways_) && end > begin + 1 && is(tokens_[begin + 1], ":");
    std::vector<Token> flat(tokens_.begin() + static_cast<std::ptrdiff_t>(begin),
                            tokens_.begin() + static_cast<std::ptrdiff_t>(end));
    if (needs_semicolon && !is(flat.back(), ";")) flat.push_back(semicolon());
    add_semicolon_to_room(flat);
    if (breaking.empty()) {
      line.cells = cells(flat, is_rule);
      line.kind = kind_of(flat, is_rule, is_statement);
      std::size_t width = indent;
      for (const std::string& cell : line.cells) width += characters(cell) + 1;
      if (width <= kLongestLine + 1 || blocks.empty()) {
        lines_.push_back(std::move(line));
        last_ = tokens_[end - 1].span.end;
        trailing_comment(end);
        return;
      }
      breaking = blocks;
    }
    broken(begin, end, indent, is_rule, breaking, std::move(line), needs_semicolon);
    last_ = tokens_[end - 1].span.end;
    trailing_comment(end);
  }

  static Token semicolon() { return {Token::Kind::symbol, {}, ";", 0, false}; }

  /// The last statement of a room's block may lack its `;`; here it gets one.
  static void add_semicolon_to_room(std::vector<Token>& flat) {
    if (flat.size() < 4 || !(is(flat[0], "room") || is(flat[0], "hallways"))) return;
    const Token& last = flat[flat.size() - 2];
    if (!is(last, ";") && !is(last, "{")) flat.insert(flat.end() - 1, semicolon());
  }

  /// Comments within the item, but for those in blocks that are broken, go before it.
  void hoist_comments(std::size_t begin, std::size_t end, const std::vector<std::size_t>& breaking,
                      Line& line) {
    std::vector<Comment> kept;
    std::size_t c = next_comment_;
    bool first = true;
    for (; c < comments_.size() && comments_[c].token < end; ++c) {
      const std::size_t token = comments_[c].token;
      const bool in_block =
          token > begin && std::any_of(breaking.begin(), breaking.end(),
                                       [&](std::size_t o) { return token > o && token <= closing(o); });
      if (in_block) {
        kept.push_back(comments_[c]);
        continue;
      }
      comment_line(comments_[c], line.indent);
      lines_.back().blank_before = first && line.blank_before;
      line.blank_before = false;
      first = false;
    }
    std::copy(kept.rbegin(), kept.rend(),
              std::make_reverse_iterator(comments_.begin() + static_cast<std::ptrdiff_t>(c)));
    next_comment_ = c - kept.size();
  }

  void broken(std::size_t begin, std::size_t end, std::size_t indent, bool is_rule,
              const std::vector<std::size_t>& breaking, Line line, bool needs_semicolon) {
    const bool has_statements = is(tokens_[begin], "room") || is(tokens_[begin], "hallways");
    std::vector<Token> run;
    bool starts_item = true;
    const auto flush = [&] {
      std::string text;
      for (std::size_t i = 0; i < run.size(); ++i) {
        if (i > 0 && has_space(run, i, is_rule && starts_item)) text += ' ';
        text += spelled(run[i]);
      }
      line.cells = {text};
      lines_.push_back(std::exchange(line, Line{}));
      line.indent = indent;
      run.clear();
      starts_item = false;
    };
    for (std::size_t i = begin; i < end; ++i) {
      run.push_back(tokens_[i]);
      if (std::find(breaking.begin(), breaking.end(), i) == breaking.end()) continue;
      const std::size_t close = closing(i);
      flush();
      last_ = tokens_[i].span.end;
      at_block_start_ = true;
      const bool outside = std::exchange(in_hallways_, is(tokens_[begin], "hallways"));
      for (std::size_t from = i + 1; from < close;) {
        const std::size_t to = part_end(from, close, has_statements ? ";" : ",");
        item(from, to, indent + kIndent, has_statements);
        from = to;
      }
      in_hallways_ = outside;
      comments_until(close + 1, indent + kIndent);
      at_block_start_ = false;
      run.push_back(tokens_[close]);
      i = close;
    }
    if (needs_semicolon && !is(run.back(), ";")) run.push_back(semicolon());
    flush();
  }

  std::size_t part_end(std::size_t from, std::size_t close, std::string_view separator) const {
    for (std::size_t i = from; i < close; ++i) {
      if (is(tokens_[i], "{")) i = closing(i);
      if (is(tokens_[i], separator)) return i + 1;
    }
    return close;
  }

  static std::string spelled(const Token& token) {
    return token.kind == Token::Kind::text ? '"' + token.text + '"' : token.text;
  }

  static Line::Kind kind_of(const std::vector<Token>& flat, bool is_rule, bool is_statement) {
    if (is_rule) return Line::Kind::rule;
    if (is_statement && is(flat[0], "room")) return Line::Kind::room;
    if (is_statement && is(flat[0], "after")) return Line::Kind::after;
    return Line::Kind::other;
  }

  /// A rule's name, what it replaces, its body, its probability; a block statement's head and block.
  static std::vector<std::string> cells(const std::vector<Token>& flat, bool is_rule) {
    std::vector<bool> begins(flat.size(), false);
    if (is_rule) {
      begins[2] = true;
      int depth = 0;
      std::size_t probability = 0;
      for (std::size_t i = 2; i < flat.size(); ++i) {
        if (is(flat[i], "{")) ++depth;
        if (is(flat[i], "}")) --depth;
        if (is(flat[i], "->")) begins[i] = true, probability = 0;
        if (is(flat[i], ":") && depth == 0) probability = i;
      }
      if (probability > 0) begins[probability] = true;
    } else if (is(flat[0], "room") || is(flat[0], "after")) {
      begins[2] = true;
    }
    std::vector<std::string> result(1);
    for (std::size_t i = 0; i < flat.size(); ++i) {
      if (i > 0 && begins[i])
        result.emplace_back();
      else if (i > 0 && has_space(flat, i, is_rule))
        result.back() += ' ';
      result.back() += spelled(flat[i]);
    }
    return result;
  }

  std::string_view text_;
  const std::vector<Token>& tokens_;
  std::vector<Comment> comments_;
  std::size_t next_comment_ = 0;
  std::size_t last_ = 0;  ///< end of what was written last, in the source
  bool at_block_start_ = true;
  bool in_hallways_ = false;  ///< productions are laid out as rules are
  std::vector<Line> lines_;
};

// ---- columns

std::string joined(const Line& line) {
  std::string text(line.indent, ' ');
  for (std::size_t i = 0; i < line.cells.size(); ++i) text += (i > 0 ? " " : "") + line.cells[i];
  return text;
}

/// Pads column by column, as far as no line becomes too long.
void align_cells(std::vector<Line>& lines, std::size_t begin, std::size_t end) {
  for (std::size_t column = 0; column < 3; ++column) {
    std::size_t widest = 0;
    for (std::size_t i = begin; i < end; ++i)
      if (lines[i].cells.size() > column + 1) widest = std::max(widest, characters(lines[i].cells[column]));
    for (std::size_t i = begin; i < end; ++i) {
      if (lines[i].cells.size() <= column + 1) continue;
      const std::size_t padding = widest - characters(lines[i].cells[column]);
      if (characters(joined(lines[i])) + padding > kLongestLine) return;
    }
    for (std::size_t i = begin; i < end; ++i)
      if (lines[i].cells.size() > column + 1)
        lines[i].cells[column].append(widest - characters(lines[i].cells[column]), ' ');
  }
}

std::string write(std::vector<Line> lines) {
  const auto runs = [&](auto belongs, auto visit) {
    for (std::size_t begin = 0, end; begin < lines.size(); begin = end) {
      end = begin + 1;
      while (end < lines.size() && !lines[end].blank_before && belongs(lines[begin], lines[end])) ++end;
      visit(begin, end);
    }
  };
  runs([](const Line& a, const Line& b) { return a.kind != Line::Kind::other && a.kind == b.kind; },
       [&](std::size_t begin, std::size_t end) { align_cells(lines, begin, end); });

  std::string out;
  runs([](const Line& a,
          const Line& b) { return !a.comment.empty() && !b.comment.empty() && a.indent == b.indent; },
       [&](std::size_t begin, std::size_t end) {
         std::size_t widest = 0;
         for (std::size_t i = begin; i < end; ++i) widest = std::max(widest, characters(joined(lines[i])));
         for (std::size_t i = begin; i < end; ++i) {
           if (lines[i].blank_before && i > 0) out += '\n';
           std::string text = joined(lines[i]);
           if (!lines[i].comment.empty())
             text.append(widest - characters(text) + 2, ' ').append(lines[i].comment);
           out += text + "\n";
         }
       });
  return out;
}

}  // namespace

FormattedRules format_rules(std::string_view text) {
  FormattedRules formatted;
  formatted.diagnostics = syntax::parse(text).diagnostics;
  if (!formatted.diagnostics.empty()) return formatted;
  const Tokens source = tokenize(text);
  formatted.text = write(Layout(text, source).run());
  return formatted;
}

}  // namespace gramap
