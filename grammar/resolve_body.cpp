#include <cmath>

#include "grammar/resolve.h"

namespace gramap {
namespace {

using syntax::Part;
using syntax::Term;

Size resolve_size(Resolver& r, const syntax::Size& source) {
  Size size;
  if (source.floating) {
    size.kind = Size::Kind::floating;
    size.value = 1;
    if (!source.quantity) return size;
    const std::optional<Value> weight = r.quantities.evaluate(source.quantity->mean);
    if (source.quantity->sd || (weight && (weight->kind != Value::Kind::plain || weight->number <= 0)))
      r.error("E0503", source.span,
              "behind `~` stands the weight by which what is left is shared, a number above zero",
              "write `~` or, for twice the share, `~2`");
    else if (weight)
      size.value = weight->number;
    return size;
  }
  const std::optional<Value> value = r.quantities.evaluate(source.quantity->mean);
  if (value && value->kind == Value::Kind::share) {
    size.kind = Size::Kind::relative;
    size.value = value->number;
    if (source.quantity->sd || value->number <= 0 || value->number > 1)
      r.error("E0503", source.span,
              "a relative size is a share of its scope between 0 % and 100 %, without a spread",
              "write `30 %`");
    return size;
  }
  size.kind = Size::Kind::absolute;
  if (!value) return size;
  if (const auto normal = r.quantities.normal(*source.quantity, "a size"))
    size.width.components.push_back({1, *normal});
  return size;
}

bool is_definite(const Size& size) {
  return size.kind == Size::Kind::own || size.kind == Size::Kind::absolute;
}

class Body {
 public:
  explicit Body(Resolver& resolver) : r_(resolver) {}

  /// Adds a term's pieces to a row along the hallway. A `string`, and a `split x` of definite sizes, are part
  /// of the row; `fills` says that the row is the whole of its scope, so that shares of it have a meaning.
  void append(const Term& term, bool fills, std::vector<Item>& row) {
    if (term.word.empty()) return append_name(term, Size(), row);
    if (term.word == "repeat") return append_repeat(term, row);
    if (term.word == "merge") return append_merge(term, row);
    if (term.word == "split" && term.name.text == "y") {
      if (!fills)
        r_.error(
            "E0504", term.span, "a `split y` needs to know how wide its unit is",
            "give it its width, `split x { 3.80 m : split y { … } }`, or make it the whole of a rule, and "
            "give the width where its symbol stands: `split x { 3.80 m : Unit }`");
      Item unit;
      unit.size.kind = Size::Kind::floating;
      unit.size.value = 1;
      append_split_across(term, std::move(unit), row);
      return;
    }
    for (const Part& part : term.parts) append_part(part, fills, row);
  }

  void append_part(const Part& part, bool fills, std::vector<Item>& row) {
    const Term& term = part.term[0];
    if (!part.size) return append(term, false, row);
    const Size size = resolve_size(r_, *part.size);
    if (!fills && !is_definite(size))
      r_.error(
          "E0505", part.size->span,
          "a share of what is left has no meaning here, where something else follows the split or repeats it",
          "give the size in metres, or make the `split` the whole of the rule's body");
    if (term.word.empty()) return append_name(term, size, row);
    if (term.word == "merge") {
      r_.error("E0506", part.size->span, "a merged room is as wide as the pieces it is made of",
               "remove the size");
      return append(term, false, row);
    }
    Item item;
    item.kind = Item::Kind::split;
    item.size = size;
    if (term.word == "split" && term.name.text == "y") return append_split_across(term, std::move(item), row);
    append(term, true, item.children);
    row.push_back(std::move(item));
  }

 private:
  /// `item` has the split's size.
  void append_split_across(const Term& term, Item item, std::vector<Item>& row) {
    item.kind = Item::Kind::split;
    item.axis = Axis::across;
    for (const Part& child : term.parts) append_across(child, item.children);
    row.push_back(std::move(item));
  }

  void append_name(const Term& term, const Size& size, std::vector<Item>& row) {
    const std::optional<SymbolRef> ref = r_.reference(term.name);
    if (!ref) return;
    if (ref->kind == SymbolRef::Kind::room && size.kind == Size::Kind::own &&
        r_.rules.rooms[static_cast<std::size_t>(ref->index)].width.components.empty())
      need(term, "width");
    Item item;
    item.size = size;
    item.ref = *ref;
    row.push_back(std::move(item));
  }

  void need(const Term& term, const std::string& what) {
    if (r_.said.contains({term.name.text, what}) || r_.file.broken.contains(term.name.text)) return;
    Diagnostic& fault = r_.error(
        "E0501", term.span,
        "the room `" + term.name.text + "` has no " + what + " of its own, and none is given here",
        "give it one: `" + what + " 2.80 m +- 5 cm;`, or a size here: `2.80 m : " + term.name.text + "`");
    if (const auto it = r_.defined.find(term.name.text); it != r_.defined.end())
      fault.labels.push_back({it->second, "the room"});
  }

  void append_repeat(const Term& term, std::vector<Item>& row) {
    Item item;
    item.kind = Item::Kind::repeat;
    item.least = 1;
    item.most = -1;
    if (term.least) {
      item.least = count(*term.least);
      item.most = term.most ? count(*term.most) : term.unbounded ? -1 : item.least;
      if (item.most >= 0 && item.most < item.least)
        r_.error("E0508", term.most->span, "a `repeat` can't end before it begins",
                 "write the smaller number first: `repeat 1..8`");
    }
    for (const Part& part : term.parts) append_part(part, false, item.children);
    row.push_back(std::move(item));
  }

  int count(const syntax::Expr& expr) {
    const std::optional<Value> value = r_.quantities.evaluate(expr);
    if (!value) return 1;
    if (value->kind == Value::Kind::plain && value->number == std::floor(value->number) &&
        value->number >= 0 && value->number <= 10000)
      return static_cast<int>(value->number);
    r_.error("E0508", expr.span, "the bounds of a `repeat` are whole numbers", "write `repeat 1..8`");
    return 1;
  }

  void append_merge(const Term& term, std::vector<Item>& row) {
    Item item;
    item.kind = Item::Kind::merge;
    for (const Part& part : term.parts) append_part(part, false, item.children);
    const std::optional<SymbolRef> ref = r_.reference(term.name);
    if (!ref) return;
    if (ref->kind != SymbolRef::Kind::room)
      r_.error("E0509", term.name.span, "a merge makes a room, and `" + term.name.text + "` is a symbol",
               "write the room's name");
    for (const Item& child : item.children)
      if (child.kind == Item::Kind::piece && child.ref.kind == SymbolRef::Kind::symbol)
        r_.error("E0509", term.span,
                 "a merge joins rooms, and `" + r_.rules.symbols[static_cast<std::size_t>(child.ref.index)] +
                     "` is a symbol",
                 "write the rooms themselves");
    item.ref = *ref;
    row.push_back(std::move(item));
  }

  /// Pieces one behind the other, from the hallway to the façade.
  void append_across(const Part& part, std::vector<Item>& pieces) {
    const Term& term = part.term[0];
    Item item;
    if (part.size) item.size = resolve_size(r_, *part.size);
    if (term.word.empty()) {
      const std::optional<SymbolRef> ref = r_.reference(term.name);
      if (!ref) return;
      const bool is_room = ref->kind == SymbolRef::Kind::room;
      if (!is_room && !part.size)
        r_.error("E0510", term.span,
                 "inside a `split y` the symbol `" + term.name.text + "` needs to know how deep it is",
                 "give its depth, or `~` for what is left: `~ : " + term.name.text + "`");
      if (is_room && !part.size && !r_.rules.rooms[static_cast<std::size_t>(ref->index)].depth)
        need(term, "depth");
      item.ref = *ref;
    } else if (!part.size) {
      r_.error("E0504", term.span, "a `" + term.word + "` inside a `split y` needs to know how deep it is",
               "give its depth, or `~` for what is left: `~ : " + term.word + " …`");
      return;
    } else {
      item.kind = Item::Kind::split;
      if (term.word == "split" && term.name.text == "y") {
        item.axis = Axis::across;
        for (const Part& child : term.parts) append_across(child, item.children);
      } else {
        append(term, true, item.children);
      }
    }
    pieces.push_back(std::move(item));
  }

  Resolver& r_;
};

}  // namespace

std::vector<Item> resolve_body(Resolver& resolver, const std::vector<syntax::Term>& body) {
  std::vector<Item> row;
  Body resolved(resolver);
  for (const syntax::Term& term : body) resolved.append(term, body.size() == 1, row);
  // What is left goes to the symbol in last place anyway: `~` says it for the reader.
  int floating = 0;
  for (const Item& item : row) floating += item.size.kind == Size::Kind::floating ? 1 : 0;
  if (floating == 1 && row.back().kind == Item::Kind::piece &&
      row.back().ref.kind == SymbolRef::Kind::symbol && row.back().size.kind == Size::Kind::floating)
    row.back().size = Size();
  return row;
}

}  // namespace gramap
