// The language's grammar, in Spirit X3 over tokens; the only file that includes it. rules/reference.md shows
// the same productions as EBNF.
#include <boost/spirit/home/x3.hpp>
#include <cmath>
#include <cstdio>
#include <string_view>

#include "grammar/keywords.h"
#include "grammar/suggest.h"
#include "grammar/syntax.h"

namespace gramap::syntax::reader {

namespace x3 = boost::spirit::x3;
using Iterator = std::vector<Token>::const_iterator;

/// Higher trees and deeper blocks are refused, so that no input can exhaust the stack.
constexpr int kDeepest = 200;

/// What is learned besides the tree.
struct State {
  std::vector<Diagnostic> diagnostics;
  std::set<std::string> broken;
  Iterator begin;
  bool too_high = false;
  bool in_straight = false;  ///< a name behind a number is what follows, unless it is a unit
};
struct StateTag {};

// ---- faults
// ------------------------------------------------------------------------------------------------

std::string found(const Token& token) {
  if (token.kind == Token::Kind::end) return "the end of the file";
  if (token.kind == Token::Kind::text) return "the text \"" + token.text + "\"";
  if (token.kind == Token::Kind::number) return "the number " + token.text;
  return "`" + token.text + "`";
}

constexpr const char* kColonOfProduction = "`:` behind a production's name";
const char* const kStatementAdvice =
    "a statement begins with `grammar`, `let`, `wall`, `height`, `room`, `start`, `after`, `background`, "
    "`hallways`, or with a rule's name and `:`";

constexpr std::string_view kBetweenStatements[] = {";", "{", "}"};

/// A length given as `a .. b`: as the mean and standard deviation by which 95 of 100 lie there.
std::string advice_on_range(Iterator where, Iterator statement) {
  const Token &low = *(where - 2), &low_unit = *(where - 1);
  std::string example = "4.50 m +- 1.50 m";
  const bool is_plain = where - statement == 3 && low.kind == Token::Kind::number &&
                        (where + 1)->kind == Token::Kind::number && (where + 2)->text == low_unit.text &&
                        low_unit.text.size() < 8;
  if (is_plain) {
    char text[80];
    std::snprintf(text, sizeof text, "%.4g %s +- %.4g %s", (low.number + (where + 1)->number) / 2,
                  low_unit.text.c_str(), std::abs((where + 1)->number - low.number) / 4,
                  low_unit.text.c_str());
    example = text;
  }
  return "a length is a mean and its standard deviation, not a range: `" + statement->text + " " + example +
         "`";
}

/// What to write instead, for the mistakes that newcomers make.
std::string advice(Iterator where, Iterator statement, const std::string& which) {
  const Token& token = *where;
  const bool second = where == statement + 1;
  if ((which == "a name" || which == "a statement") && is_keyword(token.text))
    return "`" + token.text + "` is a word of the language; choose another name";
  if (which == "`:`" && second) {
    const std::string near = nearest(statement->text, {statement_words().begin(), statement_words().end()});
    if (!near.empty()) return "did you mean `" + near + "`?";
    if (token.text == "->" || token.text == "<")
      return "a rule begins with a name of its own: `" + statement->text + "_row: " + statement->text +
             " -> …`";
    return kStatementAdvice;
  }
  if (which == "`->`") {
    if (token.text == "=") return "write `->` between what is replaced and what replaces it";
    return "a rule is `name: before < Symbol > behind : condition -> body : probability;`";
  }
  if (which == "`;`") {
    const bool two_names = statement->text == "grammar" && where == statement + 2 && !token.starts_line &&
                           token.kind == Token::Kind::name;
    if (two_names) return "a name is one word: `" + (where - 1)->text + "_" + token.text + "`";
    if (token.text == ".." && where - statement >= 2) return advice_on_range(where, statement);
    const std::string before = (where - 1)->text;  // a statement is never empty before its `;`
    if (token.text == "{" && (before == "left" || before == "right"))
      return "`straight` has a length: `straight 9 m " + before + " { … }`";
    if (token.kind == Token::Kind::number && nearest(before, {"straight"}) == "straight")
      return "did you mean `straight`?";
    return "a statement ends with `;`";
  }
  if (which == "a statement") return kStatementAdvice;
  if (which == "a statement of the hallways" || which == kColonOfProduction)
    return "hallways say their `width`, the least `depth` of rooms beside them, an `axiom`, and productions: "
           "`on: Trunk -> straight 9 m Trunk;`";
  if (which == "a piece of hallway")
    return "write `straight` and a length, `left` or `right` and a block, or a symbol";
  if (which == "`{`" && token.kind == Token::Kind::name &&
      ((where - 1)->text == "left" || (where - 1)->text == "right"))
    return "a branch is a block: `" + (where - 1)->text + " { " + token.text + " }`";
  if (which == "`as`") return "say which room the pieces become: `merge { … } as Hall`";
  if (which == "`{`" && token.text == "=")
    return "leave out the `=`: `" + statement->text + " " + (where - 1)->text + " { … }`";
  if (which == "a statement of the room" || which == "`}`") {
    const std::string near = nearest(token.text, {block_words().begin(), block_words().end()});
    if (!near.empty() && near != token.text) return "did you mean `" + near + "`?";
    if (which == "a statement of the room")
      return "a room says its `width`, `depth`, `door`, `windows`, `furniture`";
    if (token.kind == Token::Kind::name && !token.starts_line)
      return "separate two pieces of a block by `,`, or close the block with `}`";
    return "close the block with `}`";
  }
  if (which == "the axis `x` or `y`") return "`x` cuts along the hallway, `y` away from it";
  if (which == "a piece of the layout")
    return "write a room, a symbol, or `split`, `repeat`, `string`, `merge` with a block";
  return "";
}

/// `statement`: the first token of the statement that is being read.
void report(State& state, Iterator statement, Iterator where, const std::string& which) {
  if (where->kind == Token::Kind::bad) return;  // the fault is already recorded
  const bool has_before = where != state.begin;
  const bool at_break =
      has_before && which != "a statement" && (where->starts_line || where->kind == Token::Kind::end);
  Diagnostic fault;
  fault.code = which == "`;`" ? "E0102" : which == "`}`" ? "E0103" : "E0101";
  if (at_break) {
    const Token& before = *(where - 1);
    fault.message = "expected " + which + " after " + found(before);
    fault.span = {before.span.end, before.span.end};
  } else {
    fault.message = "expected " + which + ", found " + found(*where);
    fault.span = where->span;
  }
  fault.help = advice(where, statement, which);
  state.diagnostics.push_back(std::move(fault));
}

/// True where a statement begins, as far as one token and its place tell.
bool begins_statement(Iterator it, Iterator last) {
  if (!it->starts_line || it->kind != Token::Kind::name) return false;
  if (is_among(statement_words(), it->text)) return true;
  return !is_keyword(it->text) && it + 1 != last && (it + 1)->text == ":";
}

/// From a fault to where reading can resume: behind the next `;`, before the `}` that closes the block that
/// the fault is in, or before the next statement.
Iterator resume(Iterator it, Iterator last) {
  int depth = 0;
  for (; it != last; ++it) {
    if (begins_statement(it, last) || (it->starts_line && depth == 0 && is_among(block_words(), it->text)))
      return it;
    if (it->text == "{" && it->kind == Token::Kind::symbol) ++depth;
    if (it->text == "}" && it->kind == Token::Kind::symbol && --depth < 0) return it;
    if (it->text == ";" && depth <= 0) return it + 1;
  }
  return it;
}

// ---- terminals
// ---------------------------------------------------------------------------------------------

bool is_word(Iterator it, Iterator last) {
  return it != last && (it->kind == Token::Kind::symbol || it->kind == Token::Kind::name);
}

/// A keyword or symbol.
struct Literal : x3::parser<Literal> {
  using attribute_type = x3::unused_type;
  static constexpr bool has_attribute = false;
  explicit constexpr Literal(const char* text) : text_(text) {}

  template <typename Context, typename RContext, typename Attribute>
  bool parse(Iterator& first, const Iterator& last, const Context&, RContext&, Attribute&) const {
    if (!is_word(first, last) || first->text != text_) return false;
    ++first;
    return true;
  }
  std::string what() const { return "`" + std::string(text_) + "`"; }
  const char* text_;
};

/// A token of a kind; names are those that are not keywords.
struct Terminal : x3::parser<Terminal> {
  using attribute_type = Token;
  static constexpr bool has_attribute = true;
  constexpr Terminal(Token::Kind kind, const char* what) : kind_(kind), what_(what) {}

  template <typename Context, typename RContext, typename Attribute>
  bool parse(Iterator& first, const Iterator& last, const Context&, RContext&, Attribute& attribute) const {
    if (first == last || first->kind != kind_) return false;
    if (kind_ == Token::Kind::name && is_keyword(first->text)) return false;
    x3::traits::move_to(Token(*first), attribute);
    ++first;
    return true;
  }
  std::string what() const { return what_; }
  Token::Kind kind_;
  const char* what_;
};

/// One of several keywords or symbols, given with a space between them.
struct OneOf : x3::parser<OneOf> {
  using attribute_type = Token;
  static constexpr bool has_attribute = true;
  constexpr OneOf(std::string_view texts, const char* what) : texts_(texts), what_(what) {}

  template <typename Context, typename RContext, typename Attribute>
  bool parse(Iterator& first, const Iterator& last, const Context&, RContext&, Attribute& attribute) const {
    if (!is_word(first, last)) return false;
    for (std::string_view texts = texts_; !texts.empty();) {
      const std::size_t space = std::min(texts.find(' '), texts.size());
      if (first->text == texts.substr(0, space)) {
        x3::traits::move_to(Token(*first), attribute);
        ++first;
        return true;
      }
      texts.remove_prefix(std::min(space + 1, texts.size()));
    }
    return false;
  }
  std::string what() const { return what_; }
  std::string_view texts_;
  const char* what_;
};

/// A unit behind a number: any name on the number's line that is not a keyword, so that an unknown unit can
/// be named.
struct Unit : x3::parser<Unit> {
  using attribute_type = Token;
  static constexpr bool has_attribute = true;

  template <typename Context, typename RContext, typename Attribute>
  bool parse(Iterator& first, const Iterator& last, const Context& context, RContext&,
             Attribute& attribute) const {
    if (!is_word(first, last) || first->starts_line || first->text == "x" || is_keyword(first->text))
      return false;
    if (x3::get<StateTag>(context).in_straight && first->text != "%" && !is_among(units(), first->text))
      return false;
    if (first->kind == Token::Kind::symbol && first->text != "%") return false;
    x3::traits::move_to(Token(*first), attribute);
    ++first;
    return true;
  }
  std::string what() const { return "a unit"; }
};

/// The end of a statement. Always succeeds, so that a statement without its `;` is kept: what is missing or
/// in excess is recorded and passed over.
struct Semicolon : x3::parser<Semicolon> {
  using attribute_type = x3::unused_type;
  static constexpr bool has_attribute = false;

  template <typename Context, typename RContext, typename Attribute>
  bool parse(Iterator& first, const Iterator& last, const Context& context, RContext&, Attribute&) const {
    if (first != last && first->kind == Token::Kind::symbol && first->text == ";") {
      ++first;
      return true;
    }
    if (first != last && first->text == "}" && in_block_)
      return true;  // the last one in a block may be left out
    State& state = x3::get<StateTag>(context);
    Iterator statement = first;  // its first token; of a long one, as far back as the advice looks
    while (statement != state.begin && first - statement < 32 &&
           !is_among(kBetweenStatements, (statement - 1)->text))
      --statement;
    report(state, statement, first, "`;`");
    if (first != last && !first->starts_line) first = resume(first, last);
    return true;
  }
  bool in_block_ = false;
};

/// What statements stand in.
enum class Block { none, room, hallways };

/// Reads its subject; on a fault records it and goes on where reading can resume.
template <typename Subject>
struct Recovering : x3::unary_parser<Subject, Recovering<Subject>> {
  using attribute_type = x3::unused_type;
  static constexpr bool has_attribute = false;
  constexpr Recovering(const Subject& statement, Block block)
      : x3::unary_parser<Subject, Recovering<Subject>>(statement),
        in_block_(block != Block::none),
        has_productions_(block == Block::hallways) {}

  /// Where the block's `}` must be missing: a production looks like a rule, a keyword's statement does not.
  bool ends_block(Iterator it, Iterator last) const {
    return begins_statement(it, last) && !(has_productions_ && !is_keyword(it->text));
  }

  template <typename Context, typename RContext, typename Attribute>
  bool parse(Iterator& first, const Iterator& last, const Context& context, RContext& rcontext,
             Attribute&) const {
    if (first == last || (in_block_ && (first->text == "}" || ends_block(first, last)))) return false;
    State& state = x3::get<StateTag>(context);
    const Iterator begin = first;
    Iterator where = first;
    try {
      if (this->subject.parse(first, last, context, rcontext, x3::unused)) return true;
      report(state, begin, first, in_block_ ? x3::what(this->subject) : "a statement");
    } catch (const x3::expectation_failure<Iterator>& failure) {
      where = failure.where();
      report(state, begin, where, failure.which());
    }
    state.in_straight = false;
    first = resume(where == begin ? begin + 1 : where, last);
    if (!in_block_ && first != last && first->text == "}") ++first;
    for (Iterator it = begin; it != first; ++it)
      if (it->kind == Token::Kind::name) state.broken.insert(it->text);
    return true;
  }
  bool in_block_;
  bool has_productions_;
};

template <typename Subject>
constexpr Recovering<Subject> recovering(const Subject& subject, Block block) {
  return {subject, block};
}

constexpr Literal word(const char* text) {
  return Literal(text);
}

}  // namespace gramap::syntax::reader

namespace boost::spirit::x3 {
template <typename T>
requires requires(const T& t) {
  { t.what() } -> std::same_as<std::string>;
}
struct get_info<T> {
  using result_type = std::string;
  std::string operator()(const T& parser) const { return parser.what(); }
};
template <typename Subject, typename Action>
struct get_info<action<Subject, Action>> {
  using result_type = std::string;
  std::string operator()(const action<Subject, Action>& parser) const { return what(parser.subject); }
};
}  // namespace boost::spirit::x3

namespace gramap::syntax::reader {

// ---- actions
// -----------------------------------------------------------------------------------------------

/// Gives the rule's node the bytes that its subject matches.
template <typename Subject>
struct Spanned : x3::unary_parser<Subject, Spanned<Subject>> {
  using attribute_type = x3::unused_type;
  static constexpr bool has_attribute = false;
  constexpr explicit Spanned(const Subject& within) : x3::unary_parser<Subject, Spanned<Subject>>(within) {}

  template <typename Context, typename RContext, typename Attribute>
  bool parse(Iterator& first, const Iterator& last, const Context& context, RContext& node,
             Attribute&) const {
    const Iterator begin = first;
    if (!this->subject.parse(first, last, context, node, x3::unused)) return false;
    if (first != begin) node.span = {begin->span.begin, (first - 1)->span.end};
    return true;
  }
};

template <typename Subject>
constexpr Spanned<Subject> spanned(const Subject& subject) {
  return Spanned<Subject>(subject);
}

/// Stores what was read in a member of the node, or adds it to a member that is a list.
template <typename Struct, typename Member>
constexpr auto put(Member Struct::*member) {
  return [member](auto& context) { x3::_val(context).*member = std::move(x3::_attr(context)); };
}
template <typename Struct, typename Member>
constexpr auto add(std::vector<Member> Struct::*member) {
  return [member](auto& context) { (x3::_val(context).*member).push_back(std::move(x3::_attr(context))); };
}
constexpr auto pass_on = [](auto& context) { x3::_val(context) = std::move(x3::_attr(context)); };

template <typename Struct>
constexpr auto set_flag(bool Struct::*member) {
  return [member](auto& context) { x3::_val(context).*member = true; };
}

Expr::Kind operation(const std::string& sign) {
  using enum Expr::Kind;
  if (sign == "+") return plus;
  if (sign == "-") return minus;
  if (sign == "*") return times;
  if (sign == "/") return divide;
  if (sign == "<") return less;
  if (sign == "<=") return less_equal;
  if (sign == ">") return greater;
  if (sign == ">=") return greater_equal;
  if (sign == "==") return equal;
  if (sign == "!=") return not_equal;
  return sign == "and" ? land : lor;
}

/// The tree so far becomes the left operand of an operation…
constexpr auto open_operation = [](auto& context) {
  Expr& value = x3::_val(context);
  Expr node;
  node.kind = operation(x3::_attr(context).text);
  node.children.push_back(std::move(value));
  value = std::move(node);
};
/// … and this the right one.
constexpr auto close_operation = [](auto& context) {
  Expr& value = x3::_val(context);
  Expr& right = x3::_attr(context);
  value.span = {value.children[0].span.begin, right.span.end};
  value.depth = 1 + std::max(value.children[0].depth, right.depth);
  if (value.depth > kDeepest) {
    State& state = x3::get<StateTag>(context);
    if (!state.too_high)
      state.diagnostics.push_back(
          {Severity::error,
           "E0006",
           "this expression has more than " + std::to_string(kDeepest) + " operations in a row",
           right.span,
           {},
           {},
           "name parts of it with `let`"});
    state.too_high = true;
    Expr left = std::move(value.children[0]);
    value = std::move(left);
    return;
  }
  value.children.push_back(std::move(right));
};

/// An odd number of signs in front negates.
constexpr auto toggle_sign = [](auto& context) { x3::_val(context).depth = -x3::_val(context).depth; };
template <Expr::Kind kind>
constexpr auto apply_sign = [](auto& context) {
  Expr& value = x3::_val(context);
  const bool negated = value.depth < 0;
  value = std::move(x3::_attr(context));
  if (!negated) return;
  Expr node;
  node.kind = kind;
  node.span = value.span;
  node.depth = value.depth + 1;
  node.children.push_back(std::move(value));
  value = std::move(node);
};

// ---- names and expressions
// ---------------------------------------------------------------------------------

template <typename Tag, typename Attribute>
using Plain = x3::rule<Tag, Attribute>;

const Terminal name_token(Token::Kind::name, "a name");
const Terminal number_token(Token::Kind::number, "a number");
const Terminal text_token(Token::Kind::text, "a text");
const Semicolon semicolon{};
const Semicolon block_semicolon{{}, true};

constexpr auto token_name = [](auto& context) { x3::_val(context).text = x3::_attr(context).text; };

const Plain<struct NameId, Name> name("a name");
const auto name_def = spanned(name_token[token_name]);
BOOST_SPIRIT_DEFINE(name)
/// A keyword or symbol whose spelling matters later.
const auto name_of = [](std::string_view texts, const char* what) {
  return Plain<struct NameOfId, Name>(what) = spanned(OneOf(texts, what)[token_name]);
};

const Plain<struct ConditionId, Expr> condition("a condition");

constexpr auto token_number = [](auto& context) { x3::_val(context).number = x3::_attr(context).number; };
/// A number that no unit follows, so that the next word is a word.
const Plain<struct CountId, Expr> count("a number");
const auto count_def = spanned(number_token[token_number]);
BOOST_SPIRIT_DEFINE(count)
const Plain<struct NumberId, Expr> number("a number");
const auto number_def =
    spanned(number_token[token_number] >> -Unit()[([](auto& c) { x3::_val(c).text = x3::_attr(c).text; })]);
BOOST_SPIRIT_DEFINE(number)
constexpr auto leaf(Expr::Kind kind) {
  return [kind](auto& c) {
    x3::_val(c).kind = kind;
    x3::_val(c).text = x3::_attr(c).text;
  };
}
const Plain<struct PrimaryId, Expr> primary("a quantity");
const auto primary_def =
    spanned(number[pass_on] | text_token[leaf(Expr::Kind::text)] | name_token[leaf(Expr::Kind::name)] |
            OneOf("length depth hallway facade left right", "an attribute")[leaf(Expr::Kind::name)] |
            (word("(") > condition[pass_on] > word(")")));
BOOST_SPIRIT_DEFINE(primary)
const Plain<struct FactorId, Expr> factor("a quantity");
const auto factor_def =
    spanned(*OneOf("-", "a sign")[toggle_sign] >> primary[apply_sign<Expr::Kind::negate>]);
BOOST_SPIRIT_DEFINE(factor)
const Plain<struct ProductId, Expr> product("a quantity");
const auto product_def = factor[pass_on] >>
                         *(OneOf("* /", "an operator")[open_operation] > factor[close_operation]);
BOOST_SPIRIT_DEFINE(product)
const Plain<struct SumId, Expr> sum("a quantity");
const auto sum_def = product[pass_on] >>
                     *(OneOf("+ -", "an operator")[open_operation] > product[close_operation]);
BOOST_SPIRIT_DEFINE(sum)
const Plain<struct ComparisonId, Expr> comparison("a condition");
const auto comparison_def = sum[pass_on] >> -(OneOf("< <= > >= == !=", "a comparison")[open_operation] >
                                              sum[close_operation]);
BOOST_SPIRIT_DEFINE(comparison)
const Plain<struct NegationId, Expr> negation("a condition");
const auto negation_def =
    spanned(*OneOf("not", "`not`")[toggle_sign] >> comparison[apply_sign<Expr::Kind::lnot>]);
BOOST_SPIRIT_DEFINE(negation)
const Plain<struct ConjunctionId, Expr> conjunction("a condition");
const auto conjunction_def = negation[pass_on] >>
                             *(OneOf("and", "`and`")[open_operation] > negation[close_operation]);
BOOST_SPIRIT_DEFINE(conjunction)
const auto condition_def = conjunction[pass_on] >>
                           *(OneOf("or", "`or`")[open_operation] > conjunction[close_operation]);
BOOST_SPIRIT_DEFINE(condition)

const Plain<struct QuantityId, Quantity> quantity("a quantity");
const auto quantity_def = spanned(sum[put(&Quantity::mean)] >> -(word("+-") > sum[put(&Quantity::sd)]));
BOOST_SPIRIT_DEFINE(quantity)

// ---- rooms
// -------------------------------------------------------------------------------------------------

const Plain<struct AlternativeId, Alternative> alternative("a quantity");
const auto alternative_def = spanned(
    quantity[put(&Alternative::quantity)] >>
    -(word("from") >
      OneOf("start end",
            "`start` or `end`")[([](auto& c) { x3::_val(c).from_end = x3::_attr(c).text == "end"; })]) >>
    -(word(":") > sum[put(&Alternative::weight)]));
BOOST_SPIRIT_DEFINE(alternative)
const auto alternatives = alternative[add(&RoomItem::alternatives)] % word("or");
const auto opening = sum[add(&RoomItem::sizes)] > word("x") > sum[add(&RoomItem::sizes)];
const Plain<struct FurnitureId, Furniture> furniture("a piece of furniture");
const auto furniture_def =
    spanned((count[put(&Furniture::count)] > name[put(&Furniture::name)]) | name[put(&Furniture::name)]);
BOOST_SPIRIT_DEFINE(furniture)

const auto item_word = [](const char* text) { return name_of(text, text)[put(&RoomItem::word)]; };
const Plain<struct RoomItemId, RoomItem> room_item("a statement of the room");
const auto room_item_def = spanned(
    ((item_word("width") > alternatives) | (item_word("depth") > quantity[put(&RoomItem::quantity)]) |
     (item_word("door") > opening > -(word("at") > alternatives)) |
     (item_word("windows") > opening > word("sill") > sum[add(&RoomItem::sizes)] > word("every") >
      sum[add(&RoomItem::sizes)]) |
     (item_word("furniture") > (furniture[add(&RoomItem::furniture)] % word(",")))) > block_semicolon);
BOOST_SPIRIT_DEFINE(room_item)
const Plain<struct RoomId, Room> room("a room");
const auto room_def = spanned(word("room") > name[put(&Room::name)] > word("{") >
                              *recovering(room_item[add(&Room::items)], Block::room) > word("}"));
BOOST_SPIRIT_DEFINE(room)

// ---- rules
// -------------------------------------------------------------------------------------------------

const Plain<struct TermId, Term> term("a piece of the layout");

const Plain<struct SizeId, Size> size("a size");
const auto size_def = spanned((word("~")[set_flag(&Size::floating)] >> -quantity[put(&Size::quantity)]) |
                              quantity[put(&Size::quantity)]);
BOOST_SPIRIT_DEFINE(size)
/// A size that cannot be a piece begins with a number, a sign or a bracket.
struct SizeAhead : x3::parser<SizeAhead> {
  using attribute_type = x3::unused_type;
  static constexpr bool has_attribute = false;
  template <typename Context, typename RContext, typename Attribute>
  bool parse(Iterator& first, const Iterator& last, const Context&, RContext&, Attribute&) const {
    return first != last && (first->kind == Token::Kind::number || first->text == "~" || first->text == "(" ||
                             first->text == "-");
  }
};
const Plain<struct NamedSizeId, Size> named_size("a size");
const auto named_size_def = spanned(size[pass_on] >> word(":"));
BOOST_SPIRIT_DEFINE(named_size)
const Plain<struct PartId, Part> part("a piece of the layout");
const auto part_def = spanned(((SizeAhead() > size[put(&Part::size)] > word(":")) |
                               -named_size[put(&Part::size)]) > term[add(&Part::term)]);
BOOST_SPIRIT_DEFINE(part)
const auto parts = word("{") > (part[add(&Term::parts)] % word(",")) > word("}");
const auto bounds = sum[put(&Term::least)] >>
                    -(word("..") >> (sum[put(&Term::most)] | x3::eps[set_flag(&Term::unbounded)]));
const auto term_word = [](const char* text) {
  return OneOf(text, text)[([](auto& c) { x3::_val(c).word = x3::_attr(c).text; })];
};
const auto axis = name_of("x y", "the axis `x` or `y`");
const auto term_def =
    spanned((term_word("split") > axis[put(&Term::name)] > parts) | (term_word("repeat") > -bounds > parts) |
            (term_word("string") > parts) |
            (term_word("merge") > parts > word("as") > name[put(&Term::name)]) | name[put(&Term::name)]);
BOOST_SPIRIT_DEFINE(term)

const Plain<struct ContextNameId, Context> context_name("a room or `|`");
const auto context_name_def = name[put(&Context::name)] | name_of("|", "`|`")[put(&Context::name)];
BOOST_SPIRIT_DEFINE(context_name)
constexpr auto shift_left = [](auto& context) {
  x3::_val(context).left = std::move(x3::_val(context).predecessor);
};
const Plain<struct RuleId, syntax::Rule> rule("a rule");
const auto rule_def = spanned(
    name[put(&syntax::Rule::name)] > word(":") > context_name[put(&syntax::Rule::predecessor)] >
    -(word("<")[shift_left] > context_name[put(&syntax::Rule::predecessor)]) >
    -(word(">") > context_name[put(&syntax::Rule::right)]) >
    -(word(":") > condition[put(&syntax::Rule::condition)]) > word("->") > term[add(&syntax::Rule::body)] >
    *term[add(&syntax::Rule::body)] > -(word(":") > sum[put(&syntax::Rule::probability)]) > semicolon);
BOOST_SPIRIT_DEFINE(rule)

const Plain<struct AfterEntryId, After::Entry> after_entry("a rule's name or `others`");
const auto after_entry_def =
    spanned((name[put(&After::Entry::rule)] | name_of("others", "`others`")[put(&After::Entry::rule)]) >
            sum[put(&After::Entry::share)]);
BOOST_SPIRIT_DEFINE(after_entry)
const Plain<struct AfterId, After> after("an after block");
const auto after_def = spanned(word("after") > name[put(&After::rule)] > word("{") >
                               (after_entry[add(&After::entries)] % word(",")) > word("}"));
BOOST_SPIRIT_DEFINE(after)

// ---- hallways
// ----------------------------------------------------------------------------------------------

const Plain<struct HallwayModuleId, HallwayModule> hallway_module("a piece of hallway");
const auto module_word = [](const char* text) {
  return OneOf(text, text)[([](auto& c) { x3::_val(c).word = x3::_attr(c).text; })];
};
template <bool value>
constexpr auto in_straight = [](auto& context) { x3::get<StateTag>(context).in_straight = value; };
const auto hallway_module_def = spanned(
    (module_word("straight") >
     (word("~")[set_flag(&HallwayModule::to_end)] |
      (x3::eps[in_straight<true>] > quantity[put(&HallwayModule::quantity)] > x3::eps[in_straight<false>]))) |
    (module_word("left right") > word("{") > hallway_module[add(&HallwayModule::branch)] >
     *hallway_module[add(&HallwayModule::branch)] > word("}")) |
    name[put(&HallwayModule::name)]);
BOOST_SPIRIT_DEFINE(hallway_module)
const auto hallway_word = [](const char* text) { return name_of(text, text)[put(&HallwayItem::word)]; };
const auto production = name[put(&HallwayItem::name)] >
                        OneOf(":", kColonOfProduction) > name[put(&HallwayItem::predecessor)] >
                        -(word(":") > condition[put(&HallwayItem::condition)]) >
                        word("->") > hallway_module[add(&HallwayItem::body)] >
                        *hallway_module[add(&HallwayItem::body)] >
                        -(word(":") > sum[put(&HallwayItem::probability)]);
const Plain<struct HallwayItemId, HallwayItem> hallway_item("a statement of the hallways");
const auto hallway_item_def =
    spanned(((hallway_word("width") > quantity[put(&HallwayItem::quantity)]) |
             (hallway_word("depth") > quantity[put(&HallwayItem::quantity)]) |
             (hallway_word("axiom") > name[put(&HallwayItem::name)]) | production) > block_semicolon);
BOOST_SPIRIT_DEFINE(hallway_item)
const Plain<struct HallwaysId, Hallways> hallways("hallways");
const auto hallways_def =
    spanned(name_of("hallways", "`hallways`")[put(&Hallways::word)] > word("{") >
            *recovering(hallway_item[add(&Hallways::items)], Block::hallways) > word("}"));
BOOST_SPIRIT_DEFINE(hallways)

// ---- the file
// ----------------------------------------------------------------------------------------------

const Plain<struct LetId, Let> let("a constant");
const auto let_def =
    spanned(word("let") > name[put(&Let::name)] > word("=") > sum[put(&Let::value)] > semicolon);
BOOST_SPIRIT_DEFINE(let)

constexpr auto set_word(const char* text) {
  return [text](auto& context) { x3::_val(context).word = text; };
}
const auto value = sum[add(&Setting::values)];
const Plain<struct SettingId, Setting> setting("a setting");
const auto setting_def = spanned(((word("grammar")[set_word("grammar")] > name[put(&Setting::name)]) |
                                  (word("height")[set_word("height")] > value) |
                                  (word("start")[set_word("start")] > name[put(&Setting::name)]) |
                                  (word("background")[set_word("background")] > value > word("width") >
                                   value > word("..") > value)) > semicolon);
BOOST_SPIRIT_DEFINE(setting)
const Plain<struct WallPartId, Setting> wall_part("`inner` or `outer`");
const auto wall_part_def =
    spanned((word("inner")[set_word("inner")] > value) | (word("outer")[set_word("outer")] > value));
BOOST_SPIRIT_DEFINE(wall_part)
const auto walls = word("wall") > (wall_part[add(&File::settings)] % word(",")) > semicolon;

const Plain<struct FileId, File> file("a file");
const auto file_def =
    *recovering(setting[add(&File::settings)] | walls | let[add(&File::lets)] | room[add(&File::rooms)] |
                    hallways[add(&File::hallways)] | after[add(&File::afters)] | rule[add(&File::rules)],
                Block::none);
BOOST_SPIRIT_DEFINE(file)

}  // namespace gramap::syntax::reader

namespace gramap::syntax {
namespace {

/// Where brackets are nested too deeply, if anywhere.
const Token* too_deep(const std::vector<Token>& tokens) {
  int depth = 0;
  for (const Token& token : tokens) {
    if (token.kind != Token::Kind::symbol) continue;
    if (token.text == "{" || token.text == "(") {
      if (++depth > reader::kDeepest) return &token;
    } else if ((token.text == "}" || token.text == ")") && depth > 0) {
      --depth;
    }
  }
  return nullptr;
}

}  // namespace

File parse(std::string_view text) {
  Tokens lexed = tokenize(text);
  File file;
  file.diagnostics = std::move(lexed.diagnostics);
  if (const Token* token = too_deep(lexed.tokens)) {
    file.diagnostics.push_back({Severity::error,
                                "E0006",
                                "blocks and brackets are nested too deeply here",
                                token->span,
                                {},
                                {},
                                "give the inner part a rule of its own"});
    file.broken = {"grammar", "start"};  // the rest is not read, so nothing is known to be missing
    return file;
  }
  reader::State state;
  auto first = lexed.tokens.cbegin();
  state.begin = first;
  const auto last = lexed.tokens.cend() - 1;
  reader::x3::parse(first, last, reader::x3::with<reader::StateTag>(state)[reader::file], file);
  file.broken = std::move(state.broken);
  file.diagnostics.insert(file.diagnostics.end(), state.diagnostics.begin(), state.diagnostics.end());
  return file;
}

}  // namespace gramap::syntax
