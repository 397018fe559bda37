#include "grammar/diagnostic.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace gramap {
namespace {

struct Line {
  std::size_t number = 1;
  std::size_t begin = 0;
  std::size_t end = 0;  ///< without the line break
};

bool continues_character(char c) {
  return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U;
}

/// Where the lines of a text begin, counted once for all that is said about it.
class Lines {
 public:
  explicit Lines(std::string_view text) : text_(text) {
    for (std::size_t i = 0; i < text.size(); ++i)
      if (text[i] == '\n') begins_.push_back(i + 1);
  }

  std::string_view text() const { return text_; }

  Line at(std::size_t position) const {
    const auto after = std::upper_bound(begins_.begin(), begins_.end(), std::min(position, text_.size()));
    Line line;
    line.number = static_cast<std::size_t>(after - begins_.begin());
    line.begin = *std::prev(after);
    line.end = after == begins_.end() ? text_.size() : *after - 1;
    if (line.end > line.begin && text_[line.end - 1] == '\r') --line.end;
    return line;
  }

 private:
  std::string_view text_;
  std::vector<std::size_t> begins_{0};
};

/// Counted in characters from 1; a tab is one character.
std::size_t column_at(std::string_view text, const Line& line, std::size_t position) {
  std::size_t column = 1;
  for (std::size_t i = line.begin; i < std::min(position, line.end); ++i)
    column += continues_character(text[i]) ? 0 : 1;
  return column;
}

/// The part of a line that is shown: all of it, or of a very long one what is around the span.
Line window(std::string_view text, Line line, Span span) {
  constexpr std::size_t kLongest = 160;
  constexpr std::size_t kBefore = 60;
  if (line.end - line.begin <= kLongest) return line;
  const std::size_t at = std::min(span.begin, line.end);
  if (at > line.begin + kBefore) line.begin = at - kBefore;
  line.end = std::min(line.end, line.begin + kLongest);
  while (line.begin < at && continues_character(text[line.begin])) ++line.begin;
  while (line.end > at && line.end < text.size() && continues_character(text[line.end])) --line.end;
  return line;
}

/// Control characters would move the terminal's cursor.
std::string printable(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    if ((static_cast<unsigned char>(c) < ' ' && c != '\t') || c == 0x7F) c = '?';
  return out;
}

/// The source line and a mark under the span. Tabs are kept in the margin below, so the mark stays in place
/// at any tab width.
std::string excerpt(const Lines& lines, Span span, char mark, const std::string& label, std::size_t margin) {
  const std::string_view text = lines.text();
  const Line line = lines.at(span.begin);
  const Line shown = window(text, line, span);
  std::string number = std::to_string(line.number);
  number.insert(0, margin - number.size(), ' ');
  const std::string before = shown.begin > line.begin ? "…" : "";
  const std::string behind = shown.end < line.end ? "…" : "";
  std::string out = " " + number + " | " + before +
                    printable(text.substr(shown.begin, shown.end - shown.begin)) + behind + "\n " +
                    std::string(margin, ' ') + " | " + (before.empty() ? "" : " ");
  for (std::size_t i = shown.begin; i < std::min(span.begin, shown.end); ++i)
    if (!continues_character(text[i])) out += text[i] == '\t' ? '\t' : ' ';
  std::size_t width = 0;
  for (std::size_t i = span.begin; i < std::min(span.end, shown.end); ++i)
    width += continues_character(text[i]) ? 0 : 1;
  out += std::string(std::max<std::size_t>(width, 1), mark);
  if (!label.empty()) out += " " + label;
  return out + "\n";
}

std::string render(const Diagnostic& diagnostic, const Lines& lines, const std::string& name) {
  const Line line = lines.at(diagnostic.span.begin);
  std::size_t last_number = line.number;
  for (const auto& label : diagnostic.labels)
    last_number = std::max(last_number, lines.at(label.span.begin).number);
  const std::size_t margin = std::max<std::size_t>(std::to_string(last_number).size(), 3);

  std::string out = name + ":" + std::to_string(line.number) + ":" +
                    std::to_string(column_at(lines.text(), line, diagnostic.span.begin)) + ": " +
                    (diagnostic.severity == Severity::error ? "error" : "warning") + "[" + diagnostic.code +
                    "]: " + diagnostic.message + "\n";
  out += excerpt(lines, diagnostic.span, '^', "", margin);
  for (const auto& label : diagnostic.labels) out += excerpt(lines, label.span, '-', label.text, margin);
  const std::string indent(margin + 2, ' ');
  for (const std::string& note : diagnostic.notes) out += indent + "= note: " + note + "\n";
  if (!diagnostic.help.empty()) out += indent + "= help: " + diagnostic.help + "\n";
  return out;
}

}  // namespace

std::string render(const std::vector<Diagnostic>& diagnostics, std::string_view text,
                   const std::string& name) {
  const Lines lines(text);
  std::string out;
  for (const Diagnostic& diagnostic : diagnostics) out += render(diagnostic, lines, name) + "\n";
  return out;
}

std::string to_json(const std::vector<Diagnostic>& diagnostics, std::string_view text,
                    const std::string& name) {
  using Json = nlohmann::ordered_json;
  const Lines lines(text);
  const auto place = [&](Span span) {
    const auto point = [&](std::size_t position) {
      const Line line = lines.at(position);
      return Json{{"byte", position}, {"line", line.number}, {"column", column_at(text, line, position)}};
    };
    return Json{{"start", point(span.begin)}, {"end", point(span.end)}};
  };
  Json list = Json::array();
  for (const Diagnostic& diagnostic : diagnostics) {
    Json labels = Json::array();
    for (const auto& label : diagnostic.labels)
      labels.push_back({{"span", place(label.span)}, {"text", label.text}});
    list.push_back({{"file", name},
                    {"severity", diagnostic.severity == Severity::error ? "error" : "warning"},
                    {"code", diagnostic.code},
                    {"message", diagnostic.message},
                    {"span", place(diagnostic.span)},
                    {"labels", labels},
                    {"notes", diagnostic.notes},
                    {"help", diagnostic.help}});
  }
  return list.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace gramap
