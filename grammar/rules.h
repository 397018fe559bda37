// The rule set: what a rule file means once parsed and checked. Names are resolved to indices, quantities are
// numbers in metres. The language (parse, check) makes it; derivation, fit and learning use it; nothing here
// knows any text but names.
//
// Meaning. A space of clear length L is derived from the start of its reference line to its end. The
// derivation keeps a list of what is still to be placed, at first the start symbol. A room at the head of the
// list is placed with a width drawn from its density, then, unless the space is full, an inner wall. A symbol
// at the head is replaced by the body of one of its rules: among the rules whose left context and condition
// hold they compete with their weights (P(R), or P(Rj|Ri) where the rule Ri used last on this level has an
// `after` block), normalised. A right context restricts what may follow the piece that the rule makes: the
// next room, or the end of the space; derivations that break it have no probability. A symbol in last place
// vanishes when nothing is left of the scope. A layout's probability is the product of all these, conditioned
// on filling L exactly: sum of widths + (n-1) inner walls = L.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace gramap {

/// A normal distribution, metres.
struct Normal {
  double mean_m = 0;
  double sd_m = 0;
};

/// A mixture of normals; weights are positive and sum to 1. Empty: nothing said.
struct Mixture {
  struct Component {
    double weight = 1;
    Normal normal;
  };
  std::vector<Component> components;
};

/// Where and how big a type's door in the hallway wall is.
struct DoorHabit {
  double width_m = 0;
  double height_m = 0;
  /// Distance from the room's start (seen along the reference line) to the door's nearer edge; `from_end`
  /// measures from the room's end to the door's farther edge instead. No places: anywhere on the wall, all
  /// alike.
  struct Place {
    double weight = 1;
    Normal offset;
    bool from_end = false;
  };
  std::vector<Place> places;
};

/// A row of equal windows along the façade.
struct WindowHabit {
  double width_m = 0;
  double height_m = 0;
  double sill_m = 0;
  double spacing_m = 0;  ///< from centre to centre
};

struct RoomType {
  std::string name;
  Mixture width;                ///< clear width along the hallway
  std::optional<Normal> depth;  ///< clear depth away from the hallway
  std::optional<DoorHabit> door;
  std::vector<WindowHabit> windows;
  std::vector<std::string> furniture;  ///< usual furniture, by name, repeated for several
};

/// How much of its scope an item takes.
struct Size {
  enum class Kind {
    own,       ///< the room type's own width density
    absolute,  ///< `width`
    relative,  ///< `value` of the scope's clear length (less its walls)
    floating,  ///< `value` is the weight by which floating items share what the others leave
  };
  Kind kind = Kind::own;
  Mixture width;
  double value = 0;
};

/// A room type or a symbol that rules rewrite.
struct SymbolRef {
  enum class Kind { room, symbol, end };  ///< end: the end of the space, only in contexts
  Kind kind = Kind::symbol;
  int index = 0;  ///< into RuleSet::rooms or RuleSet::symbols
};

enum class Axis { along, across };  ///< x: along the reference line; y: away from the hallway

/// One piece of a rule's body.
struct Item {
  enum class Kind {
    piece,   ///< a room or a symbol
    split,   ///< a nested split of this item's own scope: `children` along `axis`
    repeat,  ///< `children` again and again, between `least` and `most` times (each count equally likely;
             ///< most < 0: after `least`, once more with probability one half each time)
    merge,   ///< `children`'s widths and the walls between them become one room of type `ref`
  };
  Kind kind = Kind::piece;
  Size size;
  SymbolRef ref;
  Axis axis = Axis::along;
  std::vector<Item> children;
  int least = 1;
  int most = 1;
};

/// A condition as a tree, leaves first: node i refers to earlier nodes only, the last node is the root.
struct Condition {
  enum class Op {
    number,
    text,
    attribute,
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
  enum class Attribute {
    length,
    depth,
    hallway,
    facade,
    left,
    right
  };  ///< remaining clear length, depth (m), hallway id, façade (bool); in productions of hallways: how far
      ///< the hallway can go on, and how far a branch to either side could go (m)
  struct Node {
    Op op = Op::number;
    double number = 0;
    std::string text;
    Attribute attribute = Attribute::length;
    int left = -1;
    int right = -1;
  };
  std::vector<Node> nodes;  ///< empty: always true
};

struct Rule {
  std::string name;
  int symbol = 0;                  ///< the predecessor, into RuleSet::symbols
  std::optional<SymbolRef> left;   ///< the room (or the space's start, `end`) before the piece
  std::optional<SymbolRef> right;  ///< the room (or the space's end) after the piece
  Condition condition;
  std::vector<Item> body;  ///< a row along the reference line
  double probability = 1;  ///< P(R), a weight until normalised over the rules that apply
  /// P(Rj | this rule was used last), by rule index; `others` is shared by the rules not named, in proportion
  /// to their P(R).
  struct After {
    std::vector<std::pair<int, double>> named;
    double others = 0;
  };
  std::optional<After> after;
};

/// A room that the rules do not foresee: any width between the bounds, all alike. Competes with the given
/// probability wherever the start symbol or one that can recur is rewritten (that symbol comes next), so that
/// one unusual room never makes a whole space impossible.
struct Background {
  double probability = 0;
  double least_m = 1;
  double most_m = 12;
};

/// One step of a hallway that grows: an L-system's module.
struct HallwayModule {
  enum class Kind {
    straight,  ///< goes on by `length`; `to_end`: as far as it can
    left,      ///< a branch to the left that begins here and is made of `branch`
    right,
    symbol,  ///< replaced by the body of one of its productions
  };
  Kind kind = Kind::straight;
  Normal length;
  bool to_end = false;
  int symbol = 0;  ///< into HallwayGrammar::symbols
  std::vector<HallwayModule> branch;
};

struct HallwayProduction {
  std::string name;
  int symbol = 0;       ///< the predecessor
  Condition condition;  ///< of `length`, `left` and `right`
  std::vector<HallwayModule> body;
  double probability = 1;  ///< a weight among the symbol's productions whose condition holds
};

/// An L-system that is sensitive to its surroundings (Parish and Müller 2001): how a network of hallways
/// grows into an outline. What the surroundings do to it is said in floor/grow_hallways.h.
struct HallwayGrammar {
  Normal width;                      ///< clear width of a hallway, drawn for each straight run
  double depth_m = 0;                ///< least clear depth of the rooms beside a hallway
  std::vector<std::string> symbols;  ///< index 0 is the axiom
  std::vector<HallwayProduction> productions;
};

struct RuleSet {
  std::string name;
  double inner_wall_m = 0.1;
  double outer_wall_m = 0.3;
  double height_m = 2.7;
  std::vector<RoomType> rooms;
  std::vector<std::string> symbols;  ///< index 0 is the start symbol
  std::vector<Rule> rules;
  Background background;
  std::optional<HallwayGrammar> hallways;  ///< for floors whose hallways nobody gives
};

}  // namespace gramap
