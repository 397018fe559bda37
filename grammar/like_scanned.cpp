#include "grammar/like_scanned.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <numbers>
#include <tuple>
#include <utility>

#include "grammar/grid.h"

namespace gramap {
namespace {

constexpr int kRoomsAhead = 8;  // how far into a row the rules are asked what is usual

double gauss(double value, double mean, double sd) {
  const double z = (value - mean) / sd;
  return std::exp(-0.5 * z * z) / (sd * std::sqrt(2 * std::numbers::pi));
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

/// That the rules allow a room of this width: what they rule out altogether stays ruled out.
bool allowed(const Row& row, const Expected& expected, double width_m, double sigma_m) {
  constexpr double kRuledOut = 1e-6;  // density per metre
  return density(row, expected, width_m, sigma_m) > kRuledOut;
}

bool tells_width(const RoomEvidence& room) {
  return !room.other_width_m && !room.of_two_rooms;
}

/// A scanned room, or some of the floor that are alike, as others may be.
struct Example {
  AlikeRooms rooms;
  double alike_sd_m = 0;  ///< of a room that is as wide
};

Example example_of(const RoomEvidence& scan, double deviation) {
  return {{scan.width_m, scan.width_sigma_m, 1, scan.type, scan.type_confidence},
          std::hypot(scan.width_sigma_m, deviation * scan.width_m)};
}

/// What a space has to go by.
struct Examples {
  std::vector<const RoomEvidence*> scans;  ///< of the space
  std::vector<Example> own, on_floor;      ///< own: by scan
  double floor_count = 0;                  ///< rooms on the floor
};

std::vector<const RoomEvidence*> usable(const Row& row, const Expected& expected,
                                        const std::vector<RoomEvidence>& rooms) {
  std::vector<const RoomEvidence*> scans;
  for (const RoomEvidence& room : rooms)
    if (tells_width(room) && allowed(row, expected, room.width_m, room.width_sigma_m)) scans.push_back(&room);
  return scans;
}

void add_floor(const Row& row, const Expected& expected, const std::vector<AlikeRooms>& floor,
               double deviation, Examples& examples) {
  for (const AlikeRooms& rooms : floor) {
    if (!allowed(row, expected, rooms.width_m, rooms.sigma_m)) continue;
    examples.on_floor.push_back({rooms, std::hypot(rooms.sigma_m, deviation * rooms.width_m)});
    examples.floor_count += rooms.count;
  }
}

Examples examples_of(const Row& row, const Expected& expected, const SpaceProblem& problem,
                     const Likeness& likeness) {
  Examples examples;
  examples.scans = usable(row, expected, problem.rooms);
  for (const RoomEvidence* scan : examples.scans)
    examples.own.push_back(example_of(*scan, likeness.deviation));
  if (likeness.floor_deviation > 0)
    add_floor(row, expected, likeness.on_floor, likeness.floor_deviation, examples);
  return examples;
}

/// Density of a scan's width if its room is as wide as the example.
double alike(const RoomEvidence& scan, const Example& example) {
  return gauss(scan.width_m, example.rooms.width_m, std::hypot(scan.width_sigma_m, example.alike_sd_m));
}

/// The rooms of the floor that this scan is one of; null: it is none of them.
const Example* group_of(const RoomEvidence& scan, const std::vector<Example>& on_floor) {
  const Example* nearest = nullptr;
  const auto distance = [&](const Example& example) {
    return std::abs(example.rooms.width_m - scan.width_m);
  };
  for (const Example& example : on_floor)
    if (example.rooms.type == scan.type && (nearest == nullptr || distance(example) < distance(*nearest)))
      nearest = &example;
  return nearest;
}

/// What foretells a width: densities, summed over rooms that are alike, and how many these are.
struct Foretold {
  double ruled = 0;
  double own = 0, own_count = 0;
  double floor = 0, floor_count = 0;
};

/// The rules and the floor's rooms make up what is expected of any space; its own rooms come on top.
double density(const Foretold& by, const Likeness& likeness) {
  const double anywhere =
      (likeness.floor_rules_worth * by.ruled + by.floor) / (likeness.floor_rules_worth + by.floor_count);
  return (likeness.rules_worth * anywhere + by.own) / (likeness.rules_worth + by.own_count);
}

/// By the floor's rooms but itself.
void add_floor(const RoomEvidence& scan, const Examples& examples, Foretold& by) {
  for (const Example& example : examples.on_floor) by.floor += example.rooms.count * alike(scan, example);
  by.floor_count = examples.floor_count;
  if (const Example* group = group_of(scan, examples.on_floor)) {
    by.floor -= alike(scan, *group);
    by.floor_count -= 1;
  }
}

/// How likely the width of one of the scans is without itself / with it.
double without_itself(const Row& row, const Expected& expected, const Examples& examples, std::size_t scan,
                      const Likeness& likeness) {
  const RoomEvidence& of = *examples.scans[scan];
  Foretold without;
  without.ruled = density(row, expected, of.width_m, of.width_sigma_m);
  for (std::size_t i = 0; i < examples.own.size(); ++i)
    if (i != scan) without.own += alike(of, examples.own[i]);
  without.own_count = static_cast<double>(examples.own.size()) - 1;
  add_floor(of, examples, without);
  Foretold with = without;
  with.own += alike(of, examples.own[scan]);
  with.own_count += 1;
  if (const Example* group = group_of(of, examples.on_floor)) {
    with.floor += alike(of, *group);
    with.floor_count += 1;
  }
  return density(without, likeness) / density(with, likeness);
}

/// What the scans add to an element.
struct Votes {
  double prior = 0;                        ///< share of the element among all rooms
  double count = 0;                        ///< in scanned rooms of the space
  std::vector<Mixture::Component> widths;  ///< of the element's clear width; weights sum to `count`
};

/// What the scan's type evidence says of a room of this type, the others being alike.
double type_factor(const RuleSet& rules, const AlikeRooms& scan, int type) {
  const auto known = std::find_if(rules.rooms.begin(), rules.rooms.end(),
                                  [&](const RoomType& room) { return room.name == scan.type; });
  if (scan.type.empty() || known == rules.rooms.end()) return 1;
  const double sure = std::clamp(scan.type_confidence, 0.0, 0.999);
  const double even = (1 - sure) / static_cast<double>(rules.rooms.size() + 1);
  return known - rules.rooms.begin() == type ? sure + even : even;
}

void add_votes(const RuleSet& rules, const Row& row, const Expected& expected, const Example& example,
               double weight, std::vector<Votes>& votes) {
  constexpr double kNegligible = 1e-3;
  const AlikeRooms& rooms = example.rooms;
  std::vector<double> fits;
  double sum = 0;
  for (const Usual& room : expected.rooms) {
    fits.push_back(room.share * type_factor(rules, rooms, room.type) *
                   density(row.elements[room.element], room.width, rooms.width_m, rooms.sigma_m));
    sum += fits.back();
  }
  for (std::size_t i = 0; i < fits.size(); ++i) {
    const Usual& room = expected.rooms[i];
    const double element_m = (rooms.width_m - room.width.constant) / room.width.slope;
    if (fits[i] < kNegligible * sum || element_m <= 0) continue;
    const double vote = weight * rooms.count * (1 - expected.share_of_rest) * fits[i] / sum;
    votes[room.element].count += vote;
    votes[room.element].widths.push_back({vote, {element_m, example.alike_sd_m / room.width.slope}});
  }
}

/// An element whose widths are a mixture gets the scanned ones into it. Beside one of even widths there is a
/// new element of the scanned ones.
struct Taught {
  double factor = 1;    ///< how much more often it is placed now
  int as_scanned = -1;  ///< the element beside it
  double beside = 0;    ///< how often that one is placed instead
};

Taught teach(Row& row, std::size_t element, const Votes& votes, double count, double rules_worth) {
  Taught taught;
  if (votes.prior <= 0) return taught;
  const double ruled = rules_worth * votes.prior, total = ruled + votes.count;
  taught.factor = total / (votes.prior * (count + rules_worth));
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
  for (Mixture::Component& c : widths) c.weight *= ruled / total;
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

std::vector<double> expect_as_scanned(const RuleSet& rules, const SpaceProblem& problem,
                                      const Likeness& likeness, Row& row) {
  if (likeness.deviation <= 0) return {};
  const Expected expected = expected_rooms(row);
  const Examples examples = examples_of(row, expected, problem, likeness);
  if (examples.own.empty() && examples.on_floor.empty()) return {};
  std::vector<double> ratios(problem.rooms.size(), 1);
  for (std::size_t i = 0; i < examples.scans.size(); ++i)
    ratios[static_cast<std::size_t>(examples.scans[i] - problem.rooms.data())] =
        without_itself(row, expected, examples, i, likeness);

  const double floor_weight = likeness.rules_worth / (likeness.floor_rules_worth + examples.floor_count);
  const double rules_weight = likeness.floor_rules_worth * floor_weight;
  const double count = static_cast<double>(examples.own.size()) + floor_weight * examples.floor_count;
  std::vector<Votes> votes(row.elements.size());
  for (const Usual& room : expected.rooms) votes[room.element].prior += room.share;
  for (const Example& example : examples.own) add_votes(rules, row, expected, example, 1, votes);
  for (const Example& example : examples.on_floor)
    add_votes(rules, row, expected, example, floor_weight, votes);
  std::vector<Taught> taught;
  for (std::size_t i = 0; i < votes.size(); ++i)
    taught.push_back(teach(row, i, votes[i], count, rules_weight));
  weigh_arcs(row, taught);
  return ratios;
}

std::vector<AlikeRooms> alike_rooms(const std::vector<SpaceProblem>& problems) {
  constexpr double kAlike = 0.02;  // of the width: closer than rooms of a floor, over all spaces, are alike
  std::vector<const RoomEvidence*> scans;
  for (const SpaceProblem& problem : problems)
    for (const RoomEvidence& room : problem.rooms)
      if (tells_width(room)) scans.push_back(&room);
  std::stable_sort(scans.begin(), scans.end(), [](const RoomEvidence* a, const RoomEvidence* b) {
    return std::tie(a->type, a->width_m) < std::tie(b->type, b->width_m);
  });
  std::vector<AlikeRooms> groups;
  double least_m = 0;
  for (const RoomEvidence* scan : scans) {
    if (groups.empty() || groups.back().type != scan->type || scan->width_m > (1 + kAlike) * least_m) {
      groups.push_back({0, 0, 0, scan->type, 0});
      least_m = scan->width_m;
    }
    AlikeRooms& group = groups.back();
    const double share = 1 / static_cast<double>(++group.count);
    group.width_m += share * (scan->width_m - group.width_m);
    group.sigma_m = std::sqrt((1 - share) * group.sigma_m * group.sigma_m +
                              share * scan->width_sigma_m * scan->width_sigma_m);
    group.type_confidence += share * (scan->type_confidence - group.type_confidence);
  }
  return groups;
}

namespace {

constexpr double kFloorDeviations[] = {0.05, 0.1};

/// What foretells each scan, by deviation.
struct ScanForetold {
  std::vector<Foretold> own;  ///< without the floor
  double misread = 0;         ///< density of a width that was read wrong
  Foretold floor[std::size(kFloorDeviations)];
};

std::vector<ScanForetold> foretell(const RuleSet& rules, const SpaceProblem& problem,
                                   const std::vector<double>& deviations,
                                   const std::vector<AlikeRooms>& on_floor) {
  constexpr double kMisread = 0.05;     // share of scans; one whose width nothing foretells shows no likeness
  constexpr double kUsualGrid_m = 0.1;  // conditions on the length are asked at the row's start only
  const CompiledRow bare = compile_row(rules, {problem.depth_m, problem.hallway, problem.facade},
                                       make_grid(problem.length_m, rules.inner_wall_m, kUsualGrid_m));
  if (bare.fault) return {};  // the fit itself will say so
  const Expected expected = expected_rooms(bare.row);
  const auto scans = usable(bare.row, expected, problem.rooms);
  Examples floors[std::size(kFloorDeviations)];
  for (std::size_t i = 0; i < std::size(floors); ++i)
    add_floor(bare.row, expected, on_floor, kFloorDeviations[i], floors[i]);
  std::vector<ScanForetold> result;
  for (const RoomEvidence* scan : scans) {
    ScanForetold foretold;
    foretold.misread = kMisread / problem.length_m;
    Foretold by;
    by.ruled = density(bare.row, expected, scan->width_m, scan->width_sigma_m);
    by.own_count = static_cast<double>(scans.size()) - 1;
    for (const double deviation : deviations) {
      by.own = 0;
      for (const RoomEvidence* other : scans)
        if (other != scan) by.own += alike(*scan, example_of(*other, deviation));
      foretold.own.push_back(by);
    }
    for (std::size_t i = 0; i < std::size(floors); ++i) add_floor(*scan, floors[i], foretold.floor[i]);
    result.push_back(std::move(foretold));
  }
  return result;
}

}  // namespace

Likeness likeness_of(const RuleSet& rules, const std::vector<SpaceProblem>& problems,
                     std::optional<double> deviation) {
  if (deviation && *deviation <= 0) return {};
  // Worth a mention (Kass and Raftery 1995): below it, the rules are taken at their word.
  const double least_gain = std::log(3);
  const std::vector<double> deviations =
      deviation ? std::vector<double>{*deviation} : std::vector<double>{0.01, 0.02, 0.04, 0.08};
  const std::vector<AlikeRooms> on_floor = alike_rooms(problems);
  std::vector<ScanForetold> scans;
  for (const SpaceProblem& problem : problems) {
    if (problem.rooms.empty()) continue;
    const auto of_space = foretell(rules, problem, deviations, on_floor);
    scans.insert(scans.end(), of_space.begin(), of_space.end());
  }
  Likeness best;
  double most = -std::numeric_limits<double>::infinity();
  const auto consider = [&](const Likeness& likeness, std::size_t own, std::size_t floor) {
    double gain = 0;
    for (const ScanForetold& scan : scans) {
      Foretold by = scan.own[own];
      if (likeness.floor_deviation > 0) {
        by.floor = scan.floor[floor].floor;
        by.floor_count = scan.floor[floor].floor_count;
      }
      gain += std::log((density(by, likeness) + scan.misread) / (by.ruled + scan.misread));
    }
    if (gain <= most) return;
    most = gain;
    best = likeness;
  };
  for (std::size_t own = 0; own < deviations.size(); ++own) {
    for (const double worth : {1, 2, 4, 8, 16}) {
      consider({deviations[own], worth, 0, 1, {}}, own, 0);
      for (std::size_t floor = 0; floor < std::size(kFloorDeviations); ++floor)
        for (const double floor_worth : {4, 16, 64})
          consider({deviations[own], worth, kFloorDeviations[floor], floor_worth, {}}, own, floor);
    }
  }
  if (!deviation && most <= least_gain) return {};
  if (best.floor_deviation > 0) best.on_floor = on_floor;
  return best;
}

}  // namespace gramap
