// A syntax tree as text, without the places: equal texts, equal trees.
#pragma once

#include <cstdio>
#include <string>

#include "grammar/syntax.h"

namespace gramap::test {

class SyntaxText {
 public:
  explicit SyntaxText(const syntax::File& file) {
    for (const auto& s : file.settings) say("setting", s.word), say(s.name), all(s.values);
    for (const auto& l : file.lets) say("let", l.name.text), say(l.value);
    for (const auto& room : file.rooms) say("room", room.name.text), all(room.items);
    for (const auto& rule : file.rules) say(rule);
    for (const auto& after : file.afters) {
      say("after", after.rule.text);
      for (const auto& entry : after.entries) say(entry.rule), say(entry.share);
    }
    for (const auto& block : file.hallways) text += "hallways\n", all(block.items);
  }
  std::string text;

 private:
  void say(const syntax::HallwayModule& module) {
    say(("module " + module.word).c_str(), module.name.text);
    if (module.to_end) text += "to the end\n";
    maybe(module.quantity), all(module.branch);
  }
  void say(const syntax::HallwayItem& item) {
    say(("hallway item " + item.word.text).c_str(), item.name.text);
    say(item.predecessor), maybe(item.quantity), maybe(item.condition), all(item.body);
    maybe(item.probability);
  }
  void say(const char* what, const std::string& of) { text += std::string(what) + " '" + of + "'\n"; }
  void say(const syntax::Name& name) { say("name", name.text); }
  void say(const syntax::Expr& e) {
    char number[64];
    std::snprintf(number, sizeof number, "expr %d %.17g ", static_cast<int>(e.kind), e.number);
    say(number, e.text);
    all(e.children);
  }
  void say(const syntax::Quantity& q) { text += "quantity\n", say(q.mean), maybe(q.sd); }
  void say(const syntax::Alternative& a) {
    text += a.from_end ? "alternative from end\n" : "alternative\n";
    say(a.quantity), maybe(a.weight);
  }
  void say(const syntax::Furniture& f) { maybe(f.count), say(f.name); }
  void say(const syntax::RoomItem& item) {
    say("item", item.word.text);
    all(item.alternatives), maybe(item.quantity), all(item.sizes), all(item.furniture);
  }
  void say(const syntax::Part& part) {
    if (part.size) text += part.size->floating ? "floating\n" : "sized\n", maybe(part.size->quantity);
    all(part.term);
  }
  void say(const syntax::Term& term) {
    say(("term " + term.word).c_str(), term.name.text);
    maybe(term.least), maybe(term.most);
    if (term.unbounded) text += "unbounded\n";
    all(term.parts);
  }
  void say(const syntax::Rule& rule) {
    say("rule", rule.name.text);
    for (const auto* context : {&rule.left, &rule.right})
      say("context", *context ? (*context)->name.text : "none");
    say(rule.predecessor.name), maybe(rule.condition), all(rule.body), maybe(rule.probability);
  }
  template <typename T>
  void maybe(const std::optional<T>& thing) {
    if (thing)
      say(*thing);
    else
      text += "none\n";
  }
  template <typename T>
  void all(const std::vector<T>& things) {
    text += "(\n";
    for (const T& thing : things) say(thing);
    text += ")\n";
  }
};

inline std::string to_text(const syntax::File& file) {
  return SyntaxText(file).text;
}

}  // namespace gramap::test
