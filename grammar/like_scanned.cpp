#include "grammar/like_scanned.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numbers>
#include <utility>

#include "grammar/grid.h"

namespace gramap {
namespace {

constexpr int kRoomsAhead = 8;  // how far into a row the rules are asked what is usual

double gauss(double value, double mean, double sd) {
  const double z = (value - mean) / sd;
  return std::exp(-0.5 * z * z) / (sd * std::sqrt(2 * std::numbers::pi));
}

/// Of the width of a room that is as wide as this scanned one.
double alike_sd_m(const RoomEvidence& room, double likeness) {
  return std::hypot(room.width_sigma_m, likeness * room.width_m);
}

/// How often each element is placed among the first rooms of a row, as shares.
std::vector<double> usual_elements(const Row& row) {
  std::vector<double> uses(row.elements.size(), 0), here(row.arcs.size(), 0);
  const auto position_class = static_cast<std::size_t>(row.position_class.front());
  here[0] = 1;
  double sum = 0;
  for (int room = 0; room < kRoomsAhead; ++room) {
    std::vector<double> next(here.size(), 0);
    for (std::size_t state = 0; state < here.size(); ++state) {
      if (here[state] == 0) continue;
      for (const Arc& arc : row.arcs[state][position_class]) {
        const double used = here[state] * arc.probability;
        uses[static_cast<std::size_t>(arc.element)] += used;
        next[static_cast<std::size_t>(arc.target)] += used;
        sum += used;
      }
    }
    here = std::move(next);
  }
  for (double& use : uses) use /= std::max(sum, 1e-300);
  return uses;
}

/// A room at the hallway, in one of the elements.
struct Usual {
  std::size_t element = 0;
  int type = kBackgroundType;
  Affine width{0, 1};  ///< of the element's clear width
  double share = 0;    ///< of all rooms at the hallway, over all elements
};

struct Expected {
  std::vector<Usual> rooms;
  double share_of_rest = 0;  ///< of rooms that take a share of what is left: as wide as any
};

Expected expected_rooms(const Row& row) {
  const std::vector<double> uses = usual_elements(row);
  Expected expected;
  double sum = 0;
  for (std::size_t i = 0; i < uses.size(); ++i) {
    if (uses[i] <= 0) continue;
    for (const ElementRoom& room : row.elements[i].rooms) {
      if (!room.at_hallway || room.width.slope <= 0) continue;
      sum += uses[i];
      if (row.elements[i].kind == Element::Width::share)
        expected.share_of_rest += uses[i];
      else
        expected.rooms.push_back({i, room.type, room.width, uses[i]});
    }
  }
  if (sum <= 0) return {};
  for (Usual& room : expected.rooms) room.share /= sum;
  expected.share_of_rest /= sum;
  return expected;
}

/// Density of the room's width as read with this standard deviation.
double density(const Element& element, const Affine& width, double width_m, double sd_m) {
  if (element.kind == Element::Width::uniform) {
    const double least_m = width.at(element.least_m), most_m = width.at(element.most_m);
    return width_m < least_m || width_m > most_m ? 0 : 1 / (most_m - least_m);
  }
  double sum = 0;
  for (const Mixture::Component& c : element.mixture.components)
    sum +=
        c.weight * gauss(width_m, width.at(c.normal.mean_m), std::hypot(width.slope * c.normal.sd_m, sd_m));
  return sum;
}

/// Density of the width of any room at the hallway, before anything was scanned.
double density(const Row& row, const Expected& expected, double width_m, double sd_m) {
  double sum = 0;
  for (const Usual& room : expected.rooms)
    sum += room.share * density(row.elements[room.element], room.width, width_m, sd_m);
  // Of what takes the rest no more is known than of the others.
  return expected.share_of_rest < 1 ? sum / (1 - expected.share_of_rest) : 0;
}

using Scans = std::vector<const RoomEvidence*>;

/// The scans whose width along the line is known and is one that the rules allow: what they rule out
/// altogether stays ruled out.
Scans examples(const Row& row, const Expected& expected, const std::vector<RoomEvidence>& scanned) {
  constexpr double kRuledOut = 1e-6;  // density per metre
  Scans rooms;
  for (const RoomEvidence& room : scanned)
    if (!room.other_width_m && !room.of_two_rooms &&
        density(row, expected, room.width_m, room.width_sigma_m) > kRuledOut)
      rooms.push_back(&room);
  return rooms;
}

/// What the scans add to an element.
struct Votes {
  double prior = 0;                        ///< share of the element among all rooms
  double count = 0;                        ///< of scanned rooms
  std::vector<Mixture::Component> widths;  ///< of the element's clear width; weights sum to `count`
};

/// What the scan's type evidence says of a room of this type, the others being alike.
double type_factor(const RuleSet& rules, const RoomEvidence& scan, int type) {
  const auto known = std::find_if(rules.rooms.begin(), rules.rooms.end(),
                                  [&](const RoomType& room) { return room.name == scan.type; });
  if (scan.type.empty() || known == rules.rooms.end()) return 1;
  const double sure = std::clamp(scan.type_confidence, 0.0, 0.999);
  const double even = (1 - sure) / static_cast<double>(rules.rooms.size() + 1);
  return known - rules.rooms.begin() == type ? sure + even : even;
}

std::vector<Votes> count_votes(const RuleSet& rules, const Row& row, const Expected& expected,
                               const Scans& scans, double likeness) {
  constexpr double kNegligible = 1e-3;
  std::vector<Votes> votes(row.elements.size());
  for (const Usual& room : expected.rooms) votes[room.element].prior += room.share;
  for (const RoomEvidence* of : scans) {
    const RoomEvidence& scan = *of;
    std::vector<double> fits;
    double sum = 0;
    for (const Usual& room : expected.rooms) {
      fits.push_back(room.share * type_factor(rules, scan, room.type) *
                     density(row.elements[room.element], room.width, scan.width_m, scan.width_sigma_m));
      sum += fits.back();
    }
    for (std::size_t i = 0; i < fits.size(); ++i) {
      const Usual& room = expected.rooms[i];
      const double element_m = (scan.width_m - room.width.constant) / room.width.slope;
      if (fits[i] < kNegligible * sum || element_m <= 0) continue;
      const double vote = (1 - expected.share_of_rest) * fits[i] / sum;
      votes[room.element].count += vote;
      votes[room.element].widths.push_back(
          {vote, {element_m, alike_sd_m(scan, likeness) / room.width.slope}});
    }
  }
  return votes;
}

/// What scans among the examples say of a room as wide as this scan, each all alike: itself, and the others.
struct Foretold {
  double own = 0, others = 0;
};

Foretold foretold(const RoomEvidence& scan, const Scans& scans, double likeness) {
  Foretold sum;
  for (const RoomEvidence* other : scans)
    (other == &scan ? sum.own : sum.others) +=
        gauss(scan.width_m, other->width_m, std::hypot(scan.width_sigma_m, alike_sd_m(*other, likeness)));
  return sum;
}

/// An element whose widths are a mixture gets the scanned ones into it. Beside one of even widths there is a
/// new element of the scanned ones.
struct Taught {
  double factor = 1;    ///< how much more often it is placed now
  int as_scanned = -1;  ///< the element beside it
  double beside = 0;    ///< how often that one is placed instead
};

Taught teach(Row& row, std::size_t element, const Votes& votes, double count) {
  Taught taught;
  if (votes.prior <= 0) return taught;
  const double total = votes.prior + votes.count;
  taught.factor = total / (votes.prior * (count + 1));
  if (votes.count <= 0) return taught;
  Element* changed = &row.elements[element];
  const bool even = changed->kind == Element::Width::uniform;
  if (even) {
    taught.as_scanned = static_cast<int>(row.elements.size());
    taught.beside = votes.count / total;
    row.elements.push_back(Element(*changed));
    changed = &row.elements.back();
    changed->kind = Element::Width::mixture;
  }
  std::vector<Mixture::Component>& widths = changed->mixture.components;
  for (Mixture::Component& c : widths) c.weight *= votes.prior / total;
  for (Mixture::Component c : votes.widths) {
    c.weight /= even ? votes.count : total;
    widths.push_back(c);
  }
  return taught;
}

/// Every state's arcs keep their sum.
void weigh_arcs(Row& row, const std::vector<Taught>& taught) {
  std::map<std::pair<int, int>, int> emissions;
  for (std::size_t i = 0; i < row.emissions.size(); ++i)
    emissions[{row.emissions[i].element, row.emissions[i].target}] = static_cast<int>(i);
  for (auto& classes : row.arcs) {
    for (std::vector<Arc>& arcs : classes) {
      double before = 0, after = 0;
      for (const Arc& arc : arcs) {
        before += arc.probability;
        after += arc.probability * taught[static_cast<std::size_t>(arc.element)].factor;
      }
      std::vector<Arc> more;
      for (Arc& arc : arcs) {
        const Taught& of = taught[static_cast<std::size_t>(arc.element)];
        arc.probability *= of.factor * before / after;
        if (of.as_scanned < 0) continue;
        Arc beside = arc;
        beside.element = of.as_scanned;
        beside.probability *= of.beside;
        arc.probability *= 1 - of.beside;
        const auto [place, is_new] =
            emissions.try_emplace({beside.element, beside.target}, static_cast<int>(row.emissions.size()));
        if (is_new) row.emissions.push_back({beside.element, beside.target});
        beside.emission = place->second;
        more.push_back(std::move(beside));
      }
      arcs.insert(arcs.end(), more.begin(), more.end());
    }
  }
}

}  // namespace

std::vector<double> expect_as_scanned(const RuleSet& rules, const SpaceProblem& problem, double likeness,
                                      Row& row) {
  if (likeness <= 0) return {};
  const Expected expected = expected_rooms(row);
  const Scans scans = examples(row, expected, problem.rooms);
  if (scans.empty()) return {};
  const auto count = static_cast<double>(scans.size());
  std::vector<double> ratios(problem.rooms.size(), 1);
  for (const RoomEvidence* scan : scans) {
    const Foretold by = foretold(*scan, scans, likeness);
    const double others = density(row, expected, scan->width_m, scan->width_sigma_m) + by.others;
    ratios[static_cast<std::size_t>(scan - problem.rooms.data())] =
        (others / count) / ((others + by.own) / (count + 1));
  }
  const std::vector<Votes> votes = count_votes(rules, row, expected, scans, likeness);
  std::vector<Taught> taught;
  for (std::size_t i = 0; i < votes.size(); ++i) taught.push_back(teach(row, i, votes[i], count));
  weigh_arcs(row, taught);
  return ratios;
}

double likeness_of(const RuleSet& rules, const std::vector<SpaceProblem>& problems) {
  constexpr double kLikenesses[] = {0.01, 0.02, 0.04, 0.08};
  // Worth a mention (Kass and Raftery 1995): below it, the rules are taken at their word.
  const double least_gain = std::log(3);
  constexpr double kUsualGrid_m = 0.1;  // conditions on the length are asked at the row's start only
  std::vector<double> gains(std::size(kLikenesses), 0);
  for (const SpaceProblem& problem : problems) {
    if (problem.rooms.size() < 2) continue;
    const CompiledRow bare = compile_row(rules, {problem.depth_m, problem.hallway, problem.facade},
                                         make_grid(problem.length_m, rules.inner_wall_m, kUsualGrid_m));
    if (bare.fault) continue;  // the fit itself will say so
    const Expected expected = expected_rooms(bare.row);
    const Scans scans = examples(bare.row, expected, problem.rooms);
    for (const RoomEvidence* scan : scans) {
      const double ruled = density(bare.row, expected, scan->width_m, scan->width_sigma_m);
      for (std::size_t i = 0; i < gains.size(); ++i) {
        const double alike = ruled + foretold(*scan, scans, kLikenesses[i]).others;
        gains[i] += std::log(alike / static_cast<double>(scans.size()) / ruled);
      }
    }
  }
  const auto best = std::max_element(gains.begin(), gains.end());
  return *best > least_gain ? kLikenesses[best - gains.begin()] : 0;
}

}  // namespace gramap
