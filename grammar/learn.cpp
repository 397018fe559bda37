#include "grammar/learn.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "geometry/error.h"
#include "grammar/design_effect.h"
#include "grammar/keywords.h"
#include "grammar/learn_filling.h"
#include "grammar/learn_habits.h"
#include "grammar/learn_sequence.h"
#include "grammar/learn_unseen.h"
#include "grammar/learn_width.h"

namespace gramap {
namespace {

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

/// A name that the language takes: letters, digits, underscores; no word of the language.
std::string as_name(const std::string& text, const std::string& otherwise) {
  std::string name;
  for (const char c : text)
    name += std::isalnum(static_cast<unsigned char>(c)) && static_cast<unsigned char>(c) < 128 ? c : '_';
  if (name.find_first_not_of('_') == std::string::npos) return otherwise;
  if (std::isdigit(static_cast<unsigned char>(name[0]))) name = otherwise + name;
  if (is_keyword(name) || is_among(units(), name) || name == "Unknown" || name == "x" || name == "y")
    name += "_";
  return name;
}

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

std::string count_word(int axes) {
  static const char* const words[] = {"", "single", "double", "triple", "quadruple"};
  return axes >= 1 && axes <= 4 ? words[axes] : "axes" + std::to_string(axes);
}

// ---- classes: types and their widths
// ---------------------------------------------------------------------------

/// Writes the class's mean in terms of the axis where that is as near as the data can tell, or leaves a rest
/// that is small against the axis.
void write_by_axis(WidthClass& width, const LearnedRules& rules) {
  width.mean_m = std::round(width.mean_m * 100) / 100;
  if (rules.axis_m == 0) return;
  const double pitch = width.mean_m + rules.data.inner_wall_m;
  const int axes = std::max(1, static_cast<int>(std::lround(pitch / rules.axis_m)));
  const double offset = pitch - axes * rules.axis_m;
  const double error = std::max(0.015, 2 * width.sd_m / std::sqrt(std::max(1, width.count)));
  if (std::abs(offset) > 0.15 * rules.axis_m && std::abs(offset) > error) return;
  width.axes = axes;
  width.offset_m = std::abs(offset) <= error ? 0 : std::round(offset * 100) / 100;
  width.mean_m = axes * rules.axis_m - rules.data.inner_wall_m + width.offset_m;
}

/// Spread of a class for the file, whole centimetres: with few rooms the data's own spread says little, so
/// two rooms' worth of the resolution are mixed in, and it is never below that.
double honest_sd(const std::vector<double>& values, const LengthGroup& group, double mean,
                 double resolution_m) {
  double squares = 2 * resolution_m * resolution_m;
  for (const int i : group.members) squares += std::pow(values[at(i)] - mean, 2);
  const double sd = std::sqrt(squares / (static_cast<double>(group.members.size()) + 2));
  return std::max(0.01, std::round(std::max(sd, resolution_m) * 100) / 100);
}

void find_structural_axis(LearnedRules& rules) {
  std::vector<double> pitches;
  for (const KnownRow& row : rules.data.rows)
    for (std::size_t i = 0; i < row.rooms.size(); ++i)
      if (!row.whole || (i > 0 && i + 1 < row.rooms.size()))  // an outer wall cuts into the rooms at the ends
        pitches.push_back(row.rooms[i].width_m + rules.data.inner_wall_m);
  const auto axis = find_axis(pitches, rules.options.resolution_m);
  if (!axis) return;
  const double step = axis->period_sd_m < 0.002 ? 0.005 : 0.01;
  rules.axis_m = std::round(axis->period_m / step) * step;
  rules.axis_sd_m = axis->residual_sd_m;
}

/// How exactly these plans are drawn: the spread that most rooms' widths have about their kind, seen where
/// several of a type are alike. Without it every room of a rough plan would be a kind of its own.
double drawn_resolution(const LearnData& data, double resolution_m) {
  std::map<std::string, std::vector<double>> by_type;
  for (const KnownRow& row : data.rows)
    for (const KnownRoom& room : row.rooms) by_type[room.type].push_back(room.width_m);
  std::vector<double> spreads;
  for (const auto& [type, widths] : by_type)
    for (const LengthGroup& group : group_lengths(widths, resolution_m, 8, 2))
      if (group.members.size() >= 3) spreads.insert(spreads.end(), group.members.size(), group.sd_m);
  return spreads.empty() ? resolution_m : std::max(resolution_m, std::min(0.12, median(spreads)));
}

std::vector<double> widths_of(const std::vector<const KnownRoom*>& rooms) {
  std::vector<double> widths;
  for (const KnownRoom* room : rooms) widths.push_back(room->width_m);
  return widths;
}

/// One class for every group of the rooms' widths; returns the class of each room.
std::vector<int> add_classes(const std::vector<double>& widths, const std::vector<LengthGroup>& groups,
                             int type, LearnedRules& rules) {
  std::vector<int> classes(widths.size());
  for (const LengthGroup& group : groups) {
    WidthClass width;
    width.type = type;
    width.mean_m = group.mean_m;
    width.sd_m = group.sd_m;
    width.count = static_cast<int>(group.members.size());
    write_by_axis(width, rules);
    width.sd_m = honest_sd(widths, group, width.mean_m, rules.options.resolution_m);
    for (const int i : group.members) classes[at(i)] = static_cast<int>(rules.classes.size());
    rules.classes.push_back(width);
  }
  return classes;
}

int add_type(LearnedRules& rules, const std::string& wish) {
  std::set<std::string> taken;
  for (const LearnedType& type : rules.types) taken.insert(type.name);
  std::string name = wish;
  for (int i = 2; taken.contains(name); ++i) name = wish + std::to_string(i);
  rules.types.push_back({});
  rules.types.back().name = name;
  return static_cast<int>(rules.types.size()) - 1;
}

/// A room's place: its row, and which room of the row it is.
using RoomPlace = std::pair<std::size_t, std::size_t>;

/// As many groups as make the whole description shortest, neighbours included: rooms whose widths run into
/// one another are still of two kinds when each keeps to its own rows.
std::vector<LengthGroup> group_by_neighbours(const std::vector<double>& widths,
                                             const std::vector<RoomPlace>& places, double resolution_m) {
  std::vector<LengthGroup> best;
  double shortest = 0;
  for (int count = 1; count <= 8; ++count) {
    const std::vector<LengthGroup> groups = group_lengths_into(widths, resolution_m, count);
    std::vector<int> label(widths.size());
    for (std::size_t g = 0; g < groups.size(); ++g)
      for (const int i : groups[g].members) label[at(i)] = static_cast<int>(g);
    std::vector<std::vector<int>> sequences;
    for (std::size_t i = 0; i < places.size(); ++i) {  // places come row by row
      const bool goes_on =
          i > 0 && places[i].first == places[i - 1].first && places[i].second == places[i - 1].second + 1;
      if (!goes_on) sequences.emplace_back();
      sequences.back().push_back(label[i]);
    }
    const double parameters = 2 * static_cast<double>(groups.size());  // their shares are in the sequences
    const double length = length_within_groups(widths, groups, resolution_m) +
                          sequence_length(sequences, groups.size()) +
                          0.5 * parameters * std::log(static_cast<double>(widths.size()));
    if (!best.empty() && length >= shortest) continue;
    shortest = length;
    best = groups;
  }
  return best;
}

/// Rooms of a plan without types: one type `Room` that comes in several widths, or a type for each width,
/// named by the number of axes.
std::vector<int> add_untyped(const std::vector<const KnownRoom*>& rooms, const std::vector<RoomPlace>& places,
                             LearnedRules& rules) {
  const std::size_t first = rules.classes.size();
  const std::vector<double> widths = widths_of(rooms);
  const int type = rules.options.types_by_width ? -1 : add_type(rules, "Room");
  const std::vector<int> classes =
      add_classes(widths, group_by_neighbours(widths, places, rules.options.resolution_m), type, rules);
  for (std::size_t c = first; c < rules.classes.size() && type < 0; ++c) {
    WidthClass& width = rules.classes[c];
    std::string name = count_word(width.axes);
    name = width.axes == 0 ? "Room_" + std::to_string(std::lround(width.mean_m * 10)) + "dm" : name + "Room";
    name[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(name[0])));
    width.type = add_type(rules, name);
  }
  return classes;
}

/// The class of every room, row by row.
std::vector<std::vector<int>> classify(LearnedRules& rules) {
  std::map<std::string, std::vector<RoomPlace>> by_type;
  for (std::size_t r = 0; r < rules.data.rows.size(); ++r)
    for (std::size_t i = 0; i < rules.data.rows[r].rooms.size(); ++i) {
      const std::string& type = rules.data.rows[r].rooms[i].type;
      by_type[type.empty() ? "" : as_name(type, "Room")].emplace_back(r, i);
    }
  std::vector<std::vector<int>> classes(rules.data.rows.size());
  for (std::size_t r = 0; r < classes.size(); ++r) classes[r].resize(rules.data.rows[r].rooms.size());
  for (const auto& [name, places] : by_type) {
    std::vector<const KnownRoom*> rooms;
    for (const auto& [r, i] : places) rooms.push_back(&rules.data.rows[r].rooms[i]);
    std::vector<int> found;
    if (name.empty()) {
      found = add_untyped(rooms, places, rules);
    } else {
      const std::vector<double> widths = widths_of(rooms);
      found = add_classes(widths, group_lengths(widths, rules.options.resolution_m), add_type(rules, name),
                          rules);
    }
    for (std::size_t k = 0; k < places.size(); ++k) classes[places[k].first][places[k].second] = found[k];
  }
  for (std::size_t t = 0; t < rules.types.size(); ++t) {
    std::vector<const KnownRoom*> rooms;
    for (std::size_t r = 0; r < classes.size(); ++r)
      for (std::size_t i = 0; i < classes[r].size(); ++i)
        if (rules.classes[at(classes[r][i])].type == static_cast<int>(t))
          rooms.push_back(&rules.data.rows[r].rooms[i]);
    rules.types[t].count = static_cast<int>(rooms.size());
    learn_habits(rooms, rules.options.resolution_m, rules.types[t]);
  }
  return classes;
}

/// What a room's `width` says: the widths seen, and for a type that comes in several numbers of axes every
/// number up to one more than seen, with the cuts that were seen; one room's weight for all that was not.
void generalise_widths(LearnedRules& rules) {
  for (std::size_t t = 0; t < rules.types.size(); ++t) {
    LearnedType& type = rules.types[t];
    std::set<int> axes;
    std::set<double> offsets;
    double sd = 0;
    for (const WidthClass& width : rules.classes) {
      if (width.type != static_cast<int>(t)) continue;
      type.widths.push_back(width);
      type.widths.back().count *= 1000;
      if (width.axes == 0) continue;
      axes.insert(width.axes);
      offsets.insert(width.offset_m);
      sd = std::max(sd, width.sd_m);
    }
    if (axes.size() < 2) continue;
    offsets.insert(0);
    std::vector<WidthClass> unseen;
    for (int k = 1; k <= *axes.rbegin() + 1; ++k)
      for (const double offset : offsets) {
        const auto same = [&](const WidthClass& w) { return w.axes == k && w.offset_m == offset; };
        if (std::any_of(type.widths.begin(), type.widths.end(), same)) continue;
        WidthClass width;
        width.type = static_cast<int>(t);
        width.axes = k;
        width.offset_m = offset;
        width.mean_m = k * rules.axis_m - rules.data.inner_wall_m + offset;
        width.sd_m = sd;
        if (width.mean_m > 0.5) unseen.push_back(width);
      }
    for (WidthClass& width : unseen) {
      width.count = static_cast<int>(1000.0 / static_cast<double>(unseen.size()) + 1);
      type.widths.push_back(width);
    }
    std::stable_sort(type.widths.begin(), type.widths.end(),
                     [](const WidthClass& a, const WidthClass& b) { return a.mean_m < b.mean_m; });
  }
}

// ---- rules
// -----------------------------------------------------------------------------------------------------

/// How often each class stands where.
struct ClassPlaces {
  double first = 0, inner = 0, last = 0;
};

std::vector<ClassPlaces> count_places(const LearnedRules& rules,
                                      const std::vector<std::vector<int>>& classes) {
  std::vector<ClassPlaces> places(rules.classes.size());
  for (std::size_t r = 0; r < classes.size(); ++r)
    for (std::size_t i = 0; i < classes[r].size(); ++i) {
      ClassPlaces& place = places[at(classes[r][i])];
      const bool whole = rules.data.rows[r].whole;
      if (whole && i == 0)
        place.first += 1;
      else if (whole && i + 1 == classes[r].size())
        place.last += 1;
      else
        place.inner += 1;
    }
  return places;
}

/// True when a class seen only at ends would hardly be seen so by chance.
bool belongs_to_ends(const ClassPlaces& place, double share_of_ends) {
  return place.inner == 0 && std::pow(share_of_ends, place.first + place.last) < 0.1;
}

std::string class_name(const LearnedRules& rules, int index) {
  const WidthClass& width = rules.classes[at(index)];
  std::string name = lower(rules.types[at(width.type)].name);
  int siblings = 0, same_axes = 0;
  for (const WidthClass& other : rules.classes) {
    siblings += other.type == width.type;
    same_axes += other.type == width.type && other.axes == width.axes;
  }
  if (siblings == 1) return name;
  if (width.axes > 0) name += "_" + count_word(width.axes);
  if (width.axes == 0 || (same_axes > 1 && width.offset_m != 0))
    name += "_" + std::to_string(std::lround(width.mean_m * 100)) + "cm";
  return name;
}

void add_rule(LearnedRules& rules, LearnedRule rule, std::string name) {
  if (is_keyword(name)) name += "_room";
  std::set<std::string> taken;
  for (const LearnedRule& other : rules.rules) taken.insert(other.name);
  rule.name = name;
  for (int i = 2; taken.contains(rule.name); ++i) rule.name = name + "_" + std::to_string(i);
  rules.rules.push_back(std::move(rule));
}

/// Shares of a symbol's rules: their counts, less what is kept for the unseen (half a count for every rule
/// seen), which goes to the rules for any room of a type (by how often the type stood there, and half a room
/// more) and to the background.
void share_out(LearnedRules& rules, const std::vector<ClassPlaces>& places, bool first) {
  std::vector<double> stood(rules.types.size(), 0.5);
  for (std::size_t c = 0; c < places.size(); ++c)
    stood[at(rules.classes[c].type)] += first ? places[c].first : places[c].inner;
  double n = 0, seen = 0, rooms = 0;
  for (const LearnedRule& rule : rules.rules) {
    if (rule.first != first) continue;
    if (rule.any_type < 0)
      n += rule.count, seen += 1;
    else
      rooms += stood[at(rule.any_type)];
  }
  const double unseen = seen == 0 ? 1 : 0.5 * seen / (n + 0.5 * seen);
  for (LearnedRule& rule : rules.rules) {
    if (rule.first != first) continue;
    rule.probability =
        rule.any_type < 0 ? (1 - unseen) * rule.count / n : 0.9 * unseen * stood[at(rule.any_type)] / rooms;
  }
}

/// Rules for rooms of a known type in a width of their own, and the background: as often as the data says
/// that rooms on a floor not seen are such.
void leave_unseen(LearnedRules& rules, const std::vector<ClassPlaces>& places,
                  const std::vector<std::vector<int>>& classes) {
  const UnseenShares shares = unseen_shares(rules, classes);
  for (const bool first : {true, false}) {
    double seen = 0, probability = 0;
    for (const LearnedRule& rule : rules.rules)
      if (rule.first == first && rule.any_type < 0) seen += 1, probability += rule.probability;
    for (LearnedRule& rule : rules.rules) {
      if (rule.first != first) continue;
      if (rule.any_type < 0)
        rule.probability = (1 - shares.even) * rule.probability + shares.even * probability / seen;
      rule.probability *= 1 - shares.other_width;
    }
    std::vector<double> stood(rules.types.size(), 0);
    double total = 0;
    for (std::size_t c = 0; c < places.size(); ++c) {
      const double count = first ? places[c].first : places[c].inner + places[c].last;
      stood[at(rules.classes[c].type)] += count;
      total += count;
    }
    for (std::size_t t = 0; t < rules.types.size(); ++t) {
      if (stood[t] < 2) continue;
      LearnedRule rule;
      rule.first = first;
      rule.any_type = static_cast<int>(t);
      rule.other_width = any_width(rules, classes, rule.any_type);
      rule.probability = shares.other_width * stood[t] / total;
      add_rule(rules, rule, (first ? "first_other_" : "other_") + lower(rules.types[t].name));
    }
  }
  rules.background = std::clamp(shares.background, 0.001, 0.1);
}

/// Whatever a room follows, a room that no rule foresees is as likely as anywhere.
void keep_unseen_after(LearnedRules& rules) {
  double unseen = 0, total = 0;
  for (const LearnedRule& rule : rules.rules) {
    if (rule.first) continue;
    total += rule.probability;
    if (rule.any_type >= 0) unseen += rule.probability;
  }
  for (LearnedRule& rule : rules.rules) {
    double named = 0;
    for (const auto& [next, share] : rule.after) named += share;
    const double most = 1 - unseen / total;
    if (named <= most) continue;
    for (auto& [next, share] : rule.after) share *= most / named;
  }
}

/// What a rule leaves behind for the next one to look at: the type and size of its last room. First rooms
/// count with their like, though an outer wall cuts into them.
std::pair<int, long> kind_of(const LearnedRules& rules, const LearnedRule& rule) {
  if (rule.any_type >= 0) return {-1, rule.any_type};
  const WidthClass& width = rules.classes[at(rule.classes.back())];
  return {width.type, width.axes > 0 ? width.axes : std::lround(-100 * width.mean_m)};
}

/// For every kind of rule whose followers differ from all rules' followers: a block of its own, mixed with
/// one count of the overall shares.
void learn_after(LearnedRules& rules, const std::vector<std::vector<int>>& derivations) {
  struct Followers {
    std::vector<double> counts;
    double count = 0;
    std::set<std::size_t> rows;
  };
  std::map<std::pair<int, long>, Followers> pooled;
  for (std::size_t r = 0; r < derivations.size(); ++r)
    for (std::size_t i = 0; i + 1 < derivations[r].size(); ++i) {
      Followers& followers = pooled[kind_of(rules, rules.rules[at(derivations[r][i])])];
      followers.counts.resize(rules.rules.size(), 0);
      followers.counts[at(derivations[r][i + 1])] += 1;
      followers.count += 1;
      followers.rows.insert(r);
    }
  std::vector<double> overall;
  double total = 0;
  for (const LearnedRule& rule : rules.rules) {
    overall.push_back(rule.first ? 0 : rule.probability);
    total += overall.back();
  }
  for (double& share : overall) share /= total;
  for (LearnedRule& rule : rules.rules) {
    if (rule.last_only || rule.any_type >= 0) continue;
    const auto found = pooled.find(kind_of(rules, rule));
    if (found == pooled.end()) continue;
    const auto& [counts, n, rows] = found->second;
    if (n < 2 || log_evidence_of_own(counts, overall, 1.0) <= 0) continue;
    const double effective = n / design_effect(n, static_cast<double>(rows.size()));
    for (std::size_t j = 0; j < counts.size(); ++j)
      if (counts[j] > 0)
        rule.after.emplace_back(static_cast<int>(j),
                                (effective * counts[j] / n + overall[j]) / (effective + 1));
  }
}

/// Returns the rules of each row's derivation.
std::vector<std::vector<int>> learn_rows(LearnedRules& rules, const std::vector<std::vector<int>>& classes) {
  const std::vector<ClassPlaces> places = count_places(rules, classes);
  double rooms = 0, ends = 0;
  for (const ClassPlaces& place : places)
    rooms += place.first + place.inner + place.last, ends += place.first + place.last;
  std::vector<bool> at_end(places.size());
  for (std::size_t c = 0; c < places.size(); ++c)
    at_end[c] = rules.options.uniform ? false : belongs_to_ends(places[c], ends / rooms);

  // The first rooms. What stands only at ends is expected at the other end too, at half the weight: which end
  // of a space is its start is a matter of the hallway's side. Of many spaces each end speaks for itself: the
  // other one counts as four of them.
  constexpr double kOtherEndSpaces = 4;
  const double other_end = std::min(0.5, kOtherEndSpaces / static_cast<double>(classes.size()));
  std::vector<int> first_rule(places.size(), -1), last_rule(places.size(), -1);
  for (std::size_t c = 0; c < places.size(); ++c) {
    const double count = places[c].first + (at_end[c] ? other_end * places[c].last : 0);
    if (count == 0) continue;
    LearnedRule rule;
    rule.first = true;
    rule.classes = {static_cast<int>(c)};
    rule.count = count;
    first_rule[c] = static_cast<int>(rules.rules.size());
    add_rule(rules, rule, "first_" + class_name(rules, static_cast<int>(c)));
  }
  // The rest, as tokens; classes of the ends stay outside of units.
  std::vector<std::vector<int>> rests;
  for (std::size_t r = 0; r < classes.size(); ++r) {
    std::vector<int> rest(classes[r].begin() + (rules.data.rows[r].whole ? 1 : 0), classes[r].end());
    if (!rest.empty() && at_end[at(rest.back())]) rest.pop_back();
    rests.push_back(std::move(rest));
  }
  const SequenceModel model = describe_sequences(rests, static_cast<int>(places.size()));
  std::vector<int> token_rule(model.tokens.size(), -1);
  for (std::size_t t = 0; t < model.tokens.size(); ++t) {
    const SequenceToken& token = model.tokens[t];
    double count = 0;
    for (const auto& sequence : model.sequences)
      count += static_cast<double>(std::count(sequence.begin(), sequence.end(), static_cast<int>(t)));
    if (count == 0) continue;
    LearnedRule rule;
    rule.classes = token.symbols;
    rule.least = token.least;
    rule.most = token.most;
    rule.count = count;
    std::string name = class_name(rules, token.symbols[0]);
    if (token.most > 0) {
      name = "row_of_" + name;
    } else if (token.symbols.size() > 1) {
      name = "unit";
      for (const int symbol : token.symbols) name += "_" + class_name(rules, symbol);
      if (name.size() > 48) name = "unit_" + std::to_string(t);
    }
    token_rule[t] = static_cast<int>(rules.rules.size());
    add_rule(rules, rule, name);
  }
  for (std::size_t c = 0; c < places.size(); ++c) {
    if (!at_end[c]) continue;
    LearnedRule rule;
    rule.last_only = true;
    rule.classes = {static_cast<int>(c)};
    rule.count = places[c].last + other_end * places[c].first;
    last_rule[c] = static_cast<int>(rules.rules.size());
    add_rule(rules, rule, "last_" + class_name(rules, static_cast<int>(c)));
  }
  for (const bool first : {true, false})
    for (std::size_t t = 0; t < rules.types.size(); ++t) {
      const bool known = std::any_of(rules.rules.begin(), rules.rules.end(), [&](const LearnedRule& rule) {
        return rule.first == first && !rule.last_only && rule.any_type < 0 && rule.classes.size() == 1 &&
               rules.classes[at(rule.classes[0])].type == static_cast<int>(t);
      });
      if (known && rules.types[t].widths.size() == 1) continue;  // that rule says the same
      LearnedRule rule;
      rule.first = first;
      rule.any_type = static_cast<int>(t);
      add_rule(rules, rule, (first ? "first_any_" : "any_") + lower(rules.types[t].name));
    }
  share_out(rules, places, true);
  share_out(rules, places, false);
  leave_unseen(rules, places, classes);

  if (rules.options.uniform) {
    for (LearnedRule& rule : rules.rules) rule.probability = 1;
    return {};
  }
  std::vector<std::vector<int>> derivations;
  for (std::size_t r = 0; r < classes.size(); ++r) {
    std::vector<int> derivation;
    if (rules.data.rows[r].whole) derivation.push_back(first_rule[at(classes[r].front())]);
    for (const int token : model.sequences[r]) derivation.push_back(token_rule[at(token)]);
    const bool cut =
        classes[r].size() > (rules.data.rows[r].whole ? 1u : 0u) && at_end[at(classes[r].back())];
    if (cut) derivation.push_back(last_rule[at(classes[r].back())]);
    derivations.push_back(std::move(derivation));
  }
  learn_after(rules, derivations);
  keep_unseen_after(rules);
  return derivations;
}

}  // namespace

LearnedRules learn_rules(const LearnData& data, const LearnOptions& options) {
  LearnedRules rules;
  rules.data = data;
  rules.options = options;
  rules.options.name = as_name(options.name, "learned");
  std::erase_if(rules.data.rows, [](const KnownRow& row) { return row.rooms.empty(); });
  if (rules.data.rows.empty())
    throw InputError({data.sources.empty() ? "" : data.sources[0]}, "there is no row of rooms to learn from",
                     "give floors with rooms (truth) along hallways");
  rules.options.resolution_m = drawn_resolution(rules.data, options.resolution_m);
  find_structural_axis(rules);
  const std::vector<std::vector<int>> classes = classify(rules);
  generalise_widths(rules);
  const std::vector<std::vector<int>> derivations = learn_rows(rules, classes);
  double least = 1e9, most = 0;
  for (const KnownRow& row : rules.data.rows)
    for (const KnownRoom& room : row.rooms)
      least = std::min(least, room.width_m), most = std::max(most, room.width_m);
  rules.least_width_m = std::max(0.5, std::floor(5 * least) / 10);
  rules.most_width_m = std::ceil(1.5 * most);
  if (!options.uniform) match_filling(rules, derivations);
  return rules;
}

}  // namespace gramap
