// A fault in a rule file, as data; and its rendering as text with source line and caret, or as JSON.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace gramap {

/// Bytes [begin, end) of the file.
struct Span {
  std::size_t begin = 0;
  std::size_t end = 0;
};

enum class Severity { error, warning };

struct Diagnostic {
  Severity severity = Severity::error;
  std::string code;     ///< stable, e.g. "E0101"
  std::string message;  ///< one sentence
  Span span;
  struct Label {
    Span span;
    std::string text;
  };
  std::vector<Label> labels;  ///< other places that matter, each with what it is
  std::vector<std::string> notes;
  std::string help;  ///< what to write instead; may be empty
};

/// "file:line:column: error[E0101]: message", the source line, a caret under the span, labels, notes, help; a
/// blank line after each.
std::string render(const std::vector<Diagnostic>& diagnostics, std::string_view text,
                   const std::string& name);

/// The same as a JSON array of objects.
std::string to_json(const std::vector<Diagnostic>& diagnostics, std::string_view text,
                    const std::string& name);

}  // namespace gramap
