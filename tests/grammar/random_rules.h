// Rule files made up at random: every construct, written carelessly.
#pragma once

#include <random>
#include <string>
#include <vector>

namespace gramap::test {

/// Syntactically right, laid out at random, with comments anywhere; not always meaningful.
class RandomRules {
 public:
  explicit RandomRules(unsigned seed) : random_(seed) {}

  std::string file() {
    text_ = pick(3) == 0 ? "\n\n" : "";
    say({"grammar", "sample", ";"});
    say({"let", "axis", "="}), quantity(3), say({";"});
    if (pick(2) == 0) say({"wall", "inner"}), quantity(1), say({",", "outer"}), quantity(1), say({";"});
    for (int i = 0; i < 3; ++i) room(i);
    if (pick(2) == 0) hallways();
    say({"start", "Space", ";"});
    for (int i = 0, n = 1 + pick(6); i < n; ++i) rule(i);
    if (pick(2) == 0) say({"after", "r0", "{", "r0", "0.5", ",", "others", "50", "%", "}"});
    if (pick(2) == 0) say({"background", "2", "%", "width", "1", "m", "..", "12.00", "m", ";"});
    return text_;
  }

 private:
  int pick(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }

  void gap(bool may_break) {
    static const char* const kBlanks[] = {" ", "  ", "\t", " ", " "};
    static const char* const kBreaks[] = {"\n", "\n\n\n", "\r\n", " // said in passing\n",
                                          "\n// Größe ±\n\n"};
    text_ += may_break && pick(6) == 0 ? kBreaks[pick(5)] : kBlanks[pick(5)];
  }

  /// Words with white space between them; a unit stays on its number's line.
  void say(const std::vector<std::string>& words) {
    for (const std::string& word : words) {
      gap(word != "m" && word != "cm" && word != "%");
      text_ += word;
    }
  }

  void quantity(int depth) {
    switch (pick(depth > 0 ? 7 : 3)) {
      case 0:
        return say({std::to_string(1 + pick(9)), "m"});
      case 1:
        return say({"2.50"});
      case 2:
        return say({"axis"});
      case 3:
        return say({"2", "*", "axis"});
      case 4:
        return quantity(depth - 1), say({pick(2) == 0 ? "-" : "+"}), quantity(depth - 1);
      case 5:
        return say({"-", "("}), quantity(depth - 1), say({")"});
      default:
        return quantity(0), say({"/"}), quantity(0);
    }
  }

  void room(int i) {
    say({"room", "R" + std::to_string(i), "{", "width"});
    quantity(2);
    if (pick(2) == 0)
      say({pick(2) == 0 ? "+-" : "±", "5", "cm", ":", "70", "%", "or"}), quantity(1), say({":", "1"});
    if (pick(2) == 0)
      say({";", "door", "1.00", pick(2) == 0 ? "x" : "×", "2.10", "m", "at", "0.10", "from", "end"});
    if (pick(2) == 0) say({";", "furniture", "2", "table", ",", "chair"});
    if (pick(2) == 0) say({";"});
    say({"}"});
  }

  void hallways() {
    say({"hallways", "{", "width"}), quantity(1), say({";", "depth", "4.50", "m", ";", "axiom", "H0", ";"});
    for (int i = 0, n = 1 + pick(3); i < n; ++i) {
      say({"p" + std::to_string(i), ":", "H" + std::to_string(i)});
      if (pick(3) == 0) say({":", pick(2) == 0 ? "left" : "length", ">"}), quantity(1);
      say({"->"});
      modules(2);
      if (pick(2) == 0) say({":", "0.40"});
      if (i + 1 < n || pick(2) == 0) say({";"});
    }
    say({"}"});
  }

  void modules(int depth) {
    for (int n = 1 + pick(3); n > 0; --n) {
      switch (pick(depth > 0 ? 4 : 3)) {
        case 0:
          say({"straight"}), quantity(1);
          if (pick(2) == 0) say({"+-", "1", "m"});
          break;
        case 1:
          say({"straight", "~"});
          break;
        case 2:
          say({"H" + std::to_string(pick(3))});
          break;
        default:
          say({pick(2) == 0 ? "left" : "right", "{"}), modules(depth - 1), say({"}"});
      }
    }
  }

  void rule(int i) {
    say({"r" + std::to_string(i), ":"});
    if (pick(3) == 0) say({pick(2) == 0 ? "|" : "R0", "<"});
    say({"Space"});
    if (pick(3) == 0) say({">", "|"});
    if (pick(3) == 0)
      say({":", "not", "length", ">"}), quantity(1), say({"and", "hallway", "==", "\"west wing\""});
    say({pick(2) == 0 ? "->" : "→"});
    for (int n = 1 + pick(3); n > 0; --n) term(2);
    if (pick(2) == 0) say({":", "0.30"});
    say({";"});
  }

  void term(int depth) {
    switch (pick(depth > 0 ? 6 : 2)) {
      case 0:
        return say({"R" + std::to_string(pick(3))});
      case 1:
        return say({"Space"});
      case 2:
        return say({"split", pick(2) == 0 ? "x" : "y"}), parts(depth, true);
      case 3:
        say({"repeat"});
        if (pick(2) == 0) say({"1", "..", "8"});
        return parts(depth, false);
      case 4:
        return say({"string"}), parts(depth, false);
      default:
        return say({"merge"}), parts(depth, false), say({"as", "R1"});
    }
  }

  void parts(int depth, bool sized) {
    say({"{"});
    for (int n = 1 + pick(3); n > 0; --n) {
      if (sized && pick(3) > 0) {
        if (pick(3) == 0)
          say({"~"}), pick(2) == 0 ? say({"2"}) : say({});
        else
          quantity(2);
        say({":"});
      }
      term(depth - 1);
      if (n > 1) say({","});
    }
    say({"}"});
  }

  std::mt19937 random_;
  std::string text_;
};

}  // namespace gramap::test
