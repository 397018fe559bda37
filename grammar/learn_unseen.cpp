#include "grammar/learn_unseen.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>

namespace gramap {
namespace {

struct Moments {
  double count = 0, sum = 0, squares = 0;
  void add(double value, double weight = 1) {
    count += weight;
    sum += weight * value;
    squares += weight * value * value;
  }
  Moments without(const Moments& other) const {
    return {count - other.count, sum - other.sum, squares - other.squares};
  }
  /// `usual`: a spread that one value's worth is believed of beforehand.
  double variance(double usual) const {
    const double mean = sum / count, believed = usual > 0 ? 1 : 0;
    return (std::max(0.0, squares - count * mean * mean) + usual * usual) / (count + believed);
  }
  double density(double value, double least_sd, double usual) const {
    const double mean = sum / count;
    const double sd = std::max(least_sd, std::sqrt(variance(usual)));
    const double z = (value - mean) / sd;
    return std::exp(-0.5 * z * z) / (sd * std::sqrt(2 * std::numbers::pi));
  }
};

/// Rooms of a part, by class and by type.
struct Part {
  std::vector<Moments> classes, types;
};

/// How far a room's width is usually off another's of its type, when one or two rooms say little about it.
double usual_spread_m(const LearnedRules& rules) {
  return rules.axis_m > 0 ? rules.axis_m / 2 : 0.5;
}

/// One room's densities under what the other parts tell.
struct Foreseen {
  double by_class = 0, evenly = 0, by_type = 0;
};

/// Density of a width over all classes or types, with their shares in the other parts, or all alike.
double mixed(const std::vector<Moments>& all, const std::vector<Moments>& part, double width_m,
             double least_sd_m, double usual_m, bool alike = false) {
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Moments others = all[i].without(part[i]);
    if (others.count < 0.5) continue;
    const double weight = alike ? 1 : others.count;
    sum += weight * others.density(width_m, least_sd_m, usual_m);
    count += weight;
  }
  return count > 0 ? sum / count : 0;
}

}  // namespace

UnseenShares unseen_shares(const LearnedRules& rules, const std::vector<std::vector<int>>& classes) {
  const std::vector<KnownRow>& rows = rules.data.rows;
  const bool one_floor = std::all_of(rows.begin(), rows.end(),
                                     [&](const KnownRow& row) { return row.floor == rows.front().floor; });
  const Part empty{std::vector<Moments>(rules.classes.size()), std::vector<Moments>(rules.types.size())};
  Part all = empty;
  std::map<std::string, Part> parts;
  const auto name = [&](std::size_t r) { return one_floor ? std::to_string(r) : rows[r].floor; };
  double widest_m = 0;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    Part& part = parts.try_emplace(name(r), empty).first->second;
    for (std::size_t i = 0; i < rows[r].rooms.size(); ++i) {
      const double width_m = rows[r].rooms[i].width_m;
      const auto c = static_cast<std::size_t>(classes[r][i]);
      const auto t = static_cast<std::size_t>(rules.classes[c].type);
      for (Part* counted : {&all, &part}) {
        counted->classes[c].add(width_m);
        counted->types[t].add(width_m);
      }
      widest_m = std::max(widest_m, width_m);
    }
  }
  std::vector<Foreseen> rooms;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const Part& part = parts.at(name(r));
    for (const KnownRoom& room : rows[r].rooms)
      rooms.push_back(
          {mixed(all.classes, part.classes, room.width_m, rules.options.resolution_m, 0),
           mixed(all.classes, part.classes, room.width_m, rules.options.resolution_m, 0, true),
           mixed(all.types, part.types, room.width_m, rules.options.resolution_m, usual_spread_m(rules))});
  }
  double types_seen_once = 0;
  for (const Moments& type : all.types) types_seen_once += type.count == 1;
  const double count = static_cast<double>(rooms.size()),
               worth = 0.5 * count / static_cast<double>(parts.size());
  const double background = (types_seen_once + 0.5) / (count + 1), uniform = 1 / std::max(1.0, widest_m);
  const UnseenShares prior{0.15, 0.1, background};
  UnseenShares shares = prior;
  for (int round = 0; round < 100; ++round) {
    UnseenShares uses{worth * prior.even, worth * prior.other_width, background};
    for (const Foreseen& room : rooms) {
      const double known = 1 - shares.even - shares.other_width - background;
      const double even = shares.even * room.evenly, other = shares.other_width * room.by_type;
      const double sum = known * room.by_class + even + other + background * uniform;
      uses.even += even / sum;
      uses.other_width += other / sum;
    }
    const double total = count + worth;
    shares.even = (1 - background) * uses.even / total;
    shares.other_width = (1 - background) * uses.other_width / total;
  }
  return shares;
}

WidthClass any_width(const LearnedRules& rules, const std::vector<std::vector<int>>& classes, int type) {
  Moments widths;
  for (std::size_t r = 0; r < classes.size(); ++r)
    for (std::size_t i = 0; i < classes[r].size(); ++i)
      if (rules.classes[static_cast<std::size_t>(classes[r][i])].type == type)
        widths.add(rules.data.rows[r].rooms[i].width_m);
  WidthClass all;
  all.type = type;
  all.count = static_cast<int>(widths.count);
  if (widths.count == 0) return all;
  const double mean = widths.sum / widths.count;
  all.mean_m = std::round(100 * mean) / 100;
  all.sd_m = std::max(0.01, std::round(100 * std::sqrt(widths.variance(usual_spread_m(rules)))) / 100);
  return all;
}

}  // namespace gramap
