#include "grammar/learn_update.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "geometry/error.h"
#include "grammar/format.h"
#include "grammar/inference.h"
#include "grammar/language.h"
#include "grammar/row_evidence.h"
#include "grammar/space.h"
#include "grammar/syntax.h"

namespace gramap {
namespace {

SpaceProblem problem_of(const KnownRow& row, double wall_m, double sigma_m) {
  SpaceProblem problem;
  problem.id = row.space;
  problem.length_m = row.length_m;
  problem.hallway = row.hallway;
  for (const KnownRoom& room : row.rooms) problem.depth_m = std::max(problem.depth_m, room.depth_m);
  problem.rooms = row_evidence(row, wall_m, sigma_m, sigma_m, 0.9);
  return problem;
}

/// Rooms that were expected to have one of a type's widths: how many, and the sums of their widths and of the
/// squares, less the width that is written.
struct WidthSums {
  double count = 0, off = 0, square = 0;
};

struct Expected {
  std::vector<double> uses;                    // by rule
  std::vector<std::vector<WidthSums>> widths;  // by room type and component of its width
};

/// Whether the element is a room of a type in one of the widths that the type itself says.
bool has_own_width(const RuleSet& rules, const Element& element) {
  if (element.kind != Element::Width::mixture || element.rooms.size() != 1) return false;
  const int type = element.first_type();
  if (type < 0) return false;
  const auto& own = rules.rooms[static_cast<std::size_t>(type)].width.components;
  return std::equal(own.begin(), own.end(), element.mixture.components.begin(),
                    element.mixture.components.end(), [](const auto& a, const auto& b) {
                      return a.weight == b.weight && a.normal.mean_m == b.normal.mean_m &&
                             a.normal.sd_m == b.normal.sd_m;
                    });
}

/// Adds a room of known width to the components of its type's width that may have made it.
void add_width(const Mixture& mixture, double width_m, double sigma_m, double probability,
               std::vector<WidthSums>& sums) {
  std::vector<double> shares;
  double all = 0;
  for (const Mixture::Component& component : mixture.components) {
    const double sd = std::hypot(component.normal.sd_m, sigma_m);
    const double u = (width_m - component.normal.mean_m) / sd;
    shares.push_back(component.weight / sd * std::exp(-0.5 * u * u));
    all += shares.back();
  }
  if (all <= 0) return;
  for (std::size_t c = 0; c < shares.size(); ++c) {
    const double share = probability * shares[c] / all;
    const double off = width_m - mixture.components[c].normal.mean_m;
    sums[c].count += share;
    sums[c].off += share * off;
    sums[c].square += share * off * off;
  }
}

/// Adds the expected uses of each rule and the rooms of each width, given the evidence; false when no
/// derivation fills the space.
bool add_expected(const RuleSet& rules, const SpaceProblem& problem, double grid_m, Expected& expected) {
  FitOptions options;
  options.grid_m = grid_m;
  const Grid grid = make_grid(problem.length_m, rules.inner_wall_m, grid_m);
  const CompiledRow compiled = compile_row(rules, {problem.depth_m, problem.hallway, problem.facade}, grid);
  if (compiled.fault) return false;
  const Evidence evidence(rules, problem, options, grid);
  const Lattice lattice(compiled.row, grid, evidence);
  const NodeTable before = forward(lattice);
  const double total = log_total(lattice, before);
  if (!std::isfinite(total)) return false;
  const NodeTable behind = backward(lattice, before);
  Edges edges(lattice);
  for (int cell = 0; cell < grid.cells; ++cell) {
    const double scale = before.log_scale[static_cast<std::size_t>(cell)] - total;
    for_each_node(lattice, cell, [&](int e, int state, std::size_t node) {
      if (before.value[node] <= 0) return;
      for (const Arc& arc : lattice.arcs(state, cell)) {
        const Element& element = compiled.row.elements[static_cast<std::size_t>(arc.element)];
        const bool own_width = has_own_width(rules, element);
        const double departing = before.value[node] * arc.probability;
        double probability = 0;
        for (const Move& move : edges.moves(cell, arc.element, e)) {
          double of_move = 0;
          const double* target =
              &behind.value[lattice.node(move.first_cell, arc.target, move.target_evidence)];
          for (int i = 0; i < move.count; ++i) {
            const double weight = move.sum[i] * target[i * move.stride];
            if (weight <= 0) continue;
            const auto reached = static_cast<std::size_t>(move.first_cell + i * move.stride);
            of_move += departing * weight * std::exp(behind.log_scale[reached] + scale);
          }
          probability += of_move;
          if (!own_width || move.matched < 0 || move.target_evidence % 2 == 1) continue;
          const PreparedEvidence& seen = evidence.rooms()[static_cast<std::size_t>(move.matched)];
          const auto type = static_cast<std::size_t>(element.first_type());
          add_width(rules.rooms[type].width, seen.width_m, seen.width_sd_m, of_move, expected.widths[type]);
        }
        for (const DerivationStep& step : arc.steps)
          if (step.rule >= 0) expected.uses[static_cast<std::size_t>(step.rule)] += probability;
        for (const InnerUse& use : element.uses)
          expected.uses[static_cast<std::size_t>(use.rule)] += probability;
      }
    });
  }
  return true;
}

struct Replacement {
  Span span;
  std::string text;
};

std::string as_written(double share, const std::string& unit) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", unit == "%" ? 100 * share : share);
  return text + (unit == "%" ? std::string(" %") : std::string());
}

/// To the millimetre.
std::string length_as_written(double length_m, const std::string& unit) {
  char text[48];
  if (unit == "mm")
    std::snprintf(text, sizeof text, "%.0f mm", 1000 * length_m);
  else if (unit == "cm")
    std::snprintf(text, sizeof text, "%.4g cm", 0.1 * std::round(1000 * length_m));
  else
    std::snprintf(text, sizeof text, "%.3f m", length_m);
  return text;
}

bool is_number(const syntax::Expr& expr) {
  return expr.kind == syntax::Expr::Kind::number;
}

/// A type's width anew: the file's own is worth `weight` rooms, spread over its components by their shares.
/// Means, deviations and shares that are plain numbers are replaced; what is made of constants stays.
void update_width(const std::vector<syntax::Alternative>& written, const Mixture& mixture,
                  const std::vector<WidthSums>& sums, double weight, std::vector<Replacement>& replacements) {
  constexpr double kLeastRooms = 0.5;   // fewer say nothing
  constexpr double kLeastSd_m = 0.001;  // as far as numbers are written
  double rooms = 0, shares = 0;
  bool has_shares = true;
  for (std::size_t c = 0; c < written.size(); ++c) {
    rooms += sums[c].count;
    shares += mixture.components[c].weight;
    has_shares = has_shares && written[c].weight && is_number(*written[c].weight);
  }
  if (rooms < kLeastRooms) return;
  for (std::size_t c = 0; c < written.size(); ++c) {
    const Mixture::Component& own = mixture.components[c];
    const double own_rooms = weight * own.weight / shares;
    const double all = own_rooms + sums[c].count;
    if (has_shares)
      replacements.push_back(
          {written[c].weight->span, as_written(shares * all / (weight + rooms), written[c].weight->text)});
    if (sums[c].count < kLeastRooms) continue;
    const syntax::Quantity& quantity = written[c].quantity;
    const double shift = is_number(quantity.mean) ? sums[c].off / all : 0;
    if (is_number(quantity.mean))
      replacements.push_back(
          {quantity.mean.span, length_as_written(own.normal.mean_m + shift, quantity.mean.text)});
    if (!quantity.sd || !is_number(*quantity.sd)) continue;
    // How exactly rooms are built is no matter of one width: what is written counts in full for each.
    const double squares =
        own_rooms * shift * shift + sums[c].square - 2 * shift * sums[c].off + sums[c].count * shift * shift;
    const double variance = (weight * own.normal.sd_m * own.normal.sd_m + squares) / (weight + sums[c].count);
    replacements.push_back(
        {quantity.sd->span, length_as_written(std::max(std::sqrt(variance), kLeastSd_m), quantity.sd->text)});
  }
}

}  // namespace

UpdatedRules update_rules(const std::string& text, const std::string& name, const LearnData& data,
                          const UpdateOptions& options) {
  const CheckedRules checked = check_rules(text, name);
  if (!checked.rules)
    throw InputError({name}, "this rule file has errors", "gramap check names them; mend them first");
  const RuleSet& rules = *checked.rules;
  UpdatedRules updated;
  Expected expected;
  expected.uses.assign(rules.rules.size(), 0);
  for (const RoomType& room : rules.rooms) expected.widths.emplace_back(room.width.components.size());
  const std::vector<double>& uses = expected.uses;
  std::size_t made = 0;
  for (const KnownRow& row : data.rows) {
    if (!row.whole || row.rooms.empty()) continue;
    const SpaceProblem problem = problem_of(row, data.inner_wall_m, options.width_sigma_m);
    if (add_expected(rules, problem, options.grid_m, expected))
      ++made;
    else
      updated.unfilled.push_back(row.floor + ", " + row.space);
  }
  if (made == 0)
    throw InputError({name}, "these rules can make none of the rows to learn from",
                     "learn without --update, or give the rules a background");

  // Rules compete with those of their symbol.
  std::map<std::string, const syntax::Rule*> written;
  const syntax::File file = syntax::parse(text);
  for (const syntax::Rule& rule : file.rules) written[rule.name.text] = &rule;
  struct Symbol {
    double shares = 0, uses = 0;
    std::vector<std::size_t> rules;
  };
  std::map<int, Symbol> symbols;
  for (std::size_t r = 0; r < rules.rules.size(); ++r) {
    const Rule& rule = rules.rules[r];
    const auto found = written.find(rule.name);
    const bool plain = found != written.end() && found->second->probability &&
                       found->second->probability->kind == syntax::Expr::Kind::number;
    if (!plain) {
      if (uses[r] > 0.5) updated.left_alone.push_back(rule.name);
      continue;
    }
    Symbol& symbol = symbols[rule.symbol];
    symbol.shares += rule.probability;
    symbol.uses += uses[r];
    symbol.rules.push_back(r);
  }
  std::vector<Replacement> replacements;
  for (const auto& [index, symbol] : symbols) {
    if (symbol.rules.size() < 2 || symbol.uses <= 0 || symbol.shares <= 0) continue;
    for (const std::size_t r : symbol.rules) {
      const double share = rules.rules[r].probability / symbol.shares;
      const double now = (options.weight * share + uses[r]) / (options.weight + symbol.uses);
      const syntax::Expr& number = *written.at(rules.rules[r].name)->probability;
      replacements.push_back({number.span, as_written(symbol.shares * now, number.text)});
    }
  }
  updated.probabilities = static_cast<int>(replacements.size());
  for (const syntax::Room& room : file.rooms) {
    const auto type = static_cast<std::size_t>(
        std::find_if(rules.rooms.begin(), rules.rooms.end(),
                     [&](const RoomType& known) { return known.name == room.name.text; }) -
        rules.rooms.begin());
    for (const syntax::RoomItem& item : room.items)
      if (item.word.text == "width" && type < rules.rooms.size() &&
          item.alternatives.size() == expected.widths[type].size())
        update_width(item.alternatives, rules.rooms[type].width, expected.widths[type], options.weight,
                     replacements);
  }
  updated.widths = static_cast<int>(replacements.size()) - updated.probabilities;
  updated.text = text;
  std::sort(replacements.begin(), replacements.end(),
            [](const Replacement& a, const Replacement& b) { return a.span.begin > b.span.begin; });
  for (const Replacement& replacement : replacements)
    updated.text.replace(replacement.span.begin, replacement.span.end - replacement.span.begin,
                         replacement.text);
  // A file in canonical form stays in it: longer numbers move what is aligned with them.
  if (format_rules(text).text == text) updated.text = *format_rules(updated.text).text;
  return updated;
}

}  // namespace gramap
