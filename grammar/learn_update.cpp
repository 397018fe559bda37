#include "grammar/learn_update.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "geometry/error.h"
#include "grammar/expected_uses.h"
#include "grammar/format.h"
#include "grammar/language.h"
#include "grammar/row_evidence.h"
#include "grammar/space.h"
#include "grammar/syntax.h"

namespace gramap {
namespace {

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
  ExpectedUses expected(rules);
  const std::vector<double>& uses = expected.rules;
  std::size_t made = 0;
  for (const KnownRow& row : data.rows) {
    if (!row.whole || row.rooms.empty()) continue;
    SpaceProblem problem = bare_problem(row);
    problem.rooms = row_evidence(row, data.inner_wall_m, options.width_sigma_m, options.width_sigma_m, 0.9);
    if (expected.add(problem, options.grid_m))
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
    const bool plain =
        found != written.end() && found->second->probability && is_number(*found->second->probability);
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
