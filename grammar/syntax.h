// The syntax tree of a rule file: what was written, with its bytes; nothing is resolved or judged yet.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "grammar/diagnostic.h"
#include "grammar/token.h"

namespace gramap::syntax {

struct Name {
  std::string text;
  Span span;
};

/// Arithmetic and conditions.
struct Expr {
  enum class Kind {
    number,  ///< `number`, with its unit (or "%", or none) in `text`
    text,
    name,  ///< a constant, or an attribute of the space
    negate,
    plus,
    minus,
    times,
    divide,
    less,
    less_equal,
    greater,
    greater_equal,
    equal,
    not_equal,
    land,
    lor,
    lnot
  };
  Kind kind = Kind::number;
  Span span;
  double number = 0;
  std::string text;
  std::vector<Expr> children;
  int depth = 1;  ///< height of this tree
};

/// `mean +- sd`
struct Quantity {
  Span span;
  Expr mean;
  std::optional<Expr> sd;
};

/// One of several values joined by `or`: a width, or a place of the door.
struct Alternative {
  Span span;
  Quantity quantity;
  bool from_end = false;
  std::optional<Expr> weight;
};

struct Furniture {
  Span span;
  std::optional<Expr> count;
  Name name;
};

/// A statement of a room's block.
struct RoomItem {
  Span span;
  Name word;                              ///< width, depth, door, windows, furniture
  std::vector<Alternative> alternatives;  ///< widths; places of the door
  std::optional<Quantity> quantity;       ///< depth
  std::vector<Expr> sizes;                ///< width and height of an opening; sill and spacing of windows
  std::vector<Furniture> furniture;
};

struct Room {
  Span span;
  Name name;
  std::vector<RoomItem> items;
};

struct Let {
  Span span;
  Name name;
  Expr value;
};

/// `grammar`, `wall inner`, `wall outer`, `height`, `start`, `background`.
struct Setting {
  Span span;
  std::string word;
  Name name;
  std::vector<Expr> values;
};

struct Size {
  Span span;
  bool floating = false;
  std::optional<Quantity> quantity;  ///< of a floating size: its weight
};

struct Term;

/// `size : term`
struct Part {
  Span span;
  std::optional<Size> size;
  std::vector<Term> term;  ///< exactly one
};

/// A piece of a rule's body.
struct Term {
  Span span;
  std::string word;  ///< split, repeat, string, merge; empty: a name
  Name name;         ///< room or symbol; of a split, its axis; of a merge, the room it becomes
  std::optional<Expr> least, most;
  bool unbounded = false;  ///< `repeat 2..`
  std::vector<Part> parts;
};

/// A room or symbol's name, or `|` for the end of the space.
struct Context {
  Name name;
  bool is_end() const { return name.text == "|"; }
};

struct Rule {
  Span span;
  Name name;
  std::optional<Context> left, right;
  Context predecessor;
  std::optional<Expr> condition;
  std::vector<Term> body;
  std::optional<Expr> probability;
};

struct After {
  Span span;
  Name rule;
  struct Entry {
    Span span;
    Name rule;  ///< or `others`
    Expr share;
  };
  std::vector<Entry> entries;
};

/// `straight LENGTH`, `left { … }`, `right { … }`, or a symbol.
struct HallwayModule {
  Span span;
  std::string word;  ///< straight, left, right; empty: a symbol
  Name name;
  bool to_end = false;
  std::optional<Quantity> quantity;
  std::vector<HallwayModule> branch;
};

/// A statement of the hallways block: `width`, `depth`, `axiom`, or (no word) a production.
struct HallwayItem {
  Span span;
  Name word;
  Name name;  ///< of the axiom, or of the production
  std::optional<Quantity> quantity;
  Name predecessor;
  std::optional<Expr> condition;
  std::vector<HallwayModule> body;
  std::optional<Expr> probability;
};

struct Hallways {
  Span span;
  Name word;
  std::vector<HallwayItem> items;
};

struct File {
  std::vector<Setting> settings;
  std::vector<Let> lets;
  std::vector<Room> rooms;
  std::vector<Rule> rules;
  std::vector<After> afters;
  std::vector<Hallways> hallways;
  std::set<std::string> broken;  ///< names within statements that could not be read
  std::vector<Diagnostic> diagnostics;
};

/// Reads a whole file; faults are recorded and reading resumes at the next statement.
File parse(std::string_view text);

}  // namespace gramap::syntax
