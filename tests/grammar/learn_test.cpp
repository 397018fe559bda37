#include "grammar/learn.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "geometry/error.h"
#include "grammar/language.h"
#include "grammar/learn_habits.h"
#include "grammar/learn_sequence.h"
#include "grammar/learn_update.h"
#include "grammar/learn_width.h"
#include "grammar/likelihood.h"

using namespace gramap;

namespace {

KnownRow row_of(const std::vector<std::pair<std::string, double>>& rooms, double wall_m) {
  KnownRow row;
  row.floor = "F";
  row.space = "S";
  row.length_m = -wall_m;
  for (const auto& [type, width] : rooms) {
    KnownRoom room;
    room.type = type;
    room.width_m = width;
    room.depth_m = 5;
    row.rooms.push_back(room);
    row.length_m += width + wall_m;
  }
  return row;
}

/// Three wings on an axis of 2.50 m with walls of 0.10 m; the outer walls cut 0.15 m off the ends.
LearnData three_wings() {
  LearnData data;
  data.sources = {"test"};
  data.inner_wall_m = 0.1;
  const double one = 2.4, two = 4.9, cut = 0.15;
  data.rows.push_back(row_of({{"Office", one - cut},
                              {"Office", one},
                              {"Office", one},
                              {"Office", one},
                              {"Office", one},
                              {"Office", one},
                              {"WC", one},
                              {"Office", one - cut}},
                             0.1));
  data.rows.push_back(row_of({{"Office", two - cut},
                              {"Office", two},
                              {"Office", two},
                              {"Office", two},
                              {"Office", two},
                              {"Office", two - cut}},
                             0.1));
  data.rows.push_back(row_of({{"Office", one - cut},
                              {"Office", one},
                              {"Office", one},
                              {"Office", one},
                              {"WC", one},
                              {"Office", one},
                              {"Office", one - cut}},
                             0.1));
  return data;
}

RuleSet parsed(const LearnedRules& rules) {
  const CheckedRules checked = check_rules(to_text(rules), "learned");
  for (const Diagnostic& diagnostic : checked.diagnostics) MESSAGE(diagnostic.message);
  CHECK(checked.diagnostics.empty());
  REQUIRE(checked.rules.has_value());
  return *checked.rules;
}

SpaceProblem seen(const KnownRow& row, double wall_m) {
  SpaceProblem problem;
  problem.length_m = row.length_m;
  double start = 0;
  for (const KnownRoom& room : row.rooms) {
    RoomEvidence evidence;
    evidence.width_m = room.width_m;
    evidence.width_sigma_m = 0.02;
    evidence.centre_m = start + room.width_m / 2;
    evidence.centre_sigma_m = 0.02;
    evidence.type = room.type;
    evidence.type_confidence = 0.9;
    problem.rooms.push_back(evidence);
    start += room.width_m + wall_m;
  }
  return problem;
}

double uniform(std::mt19937_64& generator) {
  return static_cast<double>(generator() >> 11) * 0x1p-53;
}

}  // namespace

TEST_CASE("learned rules know the axis, pass the check, and make every row they were learned from") {
  const LearnData data = three_wings();
  const LearnedRules learned = learn_rules(data);
  CHECK(learned.axis_m == doctest::Approx(2.5));
  const std::string text = to_text(learned);
  CHECK(text.find("let axis = 2.50 m;") != std::string::npos);
  CHECK(text.find("two_axes - 0.15 m") != std::string::npos);
  CHECK(text.find("Rest > |") != std::string::npos);
  const RuleSet rules = parsed(learned);
  for (const KnownRow& row : data.rows) {
    const SpaceFit fit = fit_space(rules, seen(row, 0.1));
    REQUIRE(fit.best.rooms.size() == row.rooms.size());
    for (std::size_t i = 0; i < row.rooms.size(); ++i) {
      CHECK(fit.best.rooms[i].type == row.rooms[i].type);
      CHECK(fit.best.rooms[i].width_m == doctest::Approx(row.rooms[i].width_m).epsilon(0.01));
    }
  }
}

TEST_CASE("a floor of its kind is likelier under learned rules than under the same made uniform") {
  const LearnData data = three_wings();
  LearnOptions alike;
  alike.uniform = true;
  const RuleSet rules = parsed(learn_rules(data)), uniform_rules = parsed(learn_rules(data, alike));
  const KnownRow other = row_of(
      {{"Office", 2.25}, {"Office", 2.4}, {"Office", 2.4}, {"WC", 2.4}, {"Office", 2.4}, {"Office", 2.25}},
      0.1);
  CHECK(log_likelihood(rules, seen(other, 0.1)) > log_likelihood(uniform_rules, seen(other, 0.1)) + 1);
}

TEST_CASE("a width of three axes, never seen, and a room of no known width at all stay possible") {
  const RuleSet rules = parsed(learn_rules(three_wings()));
  for (const double width : {7.4, 3.61}) {
    const KnownRow row =
        row_of({{"Office", 2.25}, {"Office", 2.4}, {"", width}, {"Office", 2.4}, {"Office", 2.25}}, 0.1);
    const SpaceFit fit = fit_space(rules, seen(row, 0.1));
    REQUIRE(fit.best.rooms.size() == 5);
    CHECK(fit.best.rooms[2].width_m == doctest::Approx(width).epsilon(0.01));
  }
}

TEST_CASE("rooms without types are one type in several widths, or a type for each width") {
  LearnData data = three_wings();
  for (KnownRow& row : data.rows)
    for (KnownRoom& room : row.rooms) room.type.clear();
  CHECK(learn_rules(data).types.size() == 1);
  parsed(learn_rules(data));
  LearnOptions options;
  options.types_by_width = true;
  const LearnedRules learned = learn_rules(data, options);
  CHECK(learned.types.size() >= 2);
  parsed(learned);
}

TEST_CASE("nothing to learn from is refused; names that the language does not take are mended") {
  CHECK_THROWS_AS(learn_rules({}), InputError);
  LearnData data = three_wings();
  for (KnownRow& row : data.rows)
    for (KnownRoom& room : row.rooms) room.type = room.type == "WC" ? "room" : "2nd Büro/Lager";
  parsed(learn_rules(data));
}

TEST_CASE("the best grouping is the best of all contiguous groupings") {
  std::mt19937_64 generator(5);
  for (int round = 0; round < 200; ++round) {
    std::vector<double> values;
    const int n = 3 + static_cast<int>(generator() % 6);
    for (int i = 0; i < n; ++i)
      values.push_back(2 + 3 * static_cast<double>(generator() % 3) + 0.3 * uniform(generator));
    std::vector<int> order(values.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<int>(i);
    std::sort(order.begin(), order.end(), [&](int a, int b) {
      return values[static_cast<std::size_t>(a)] < values[static_cast<std::size_t>(b)];
    });
    double best = 1e300;
    for (unsigned cuts = 0; cuts < 1u << (n - 1); ++cuts) {
      std::vector<LengthGroup> groups(1);
      for (int i = 0; i < n; ++i) {
        if (i > 0 && (cuts >> (i - 1) & 1u)) groups.emplace_back();
        groups.back().members.push_back(order[static_cast<std::size_t>(i)]);
      }
      for (LengthGroup& group : groups) {
        for (const int i : group.members) group.mean_m += values[static_cast<std::size_t>(i)];
        group.mean_m /= static_cast<double>(group.members.size());
      }
      best = std::min(best, code_length(values, groups, 0.02));
    }
    CHECK(code_length(values, group_lengths(values, 0.02), 0.02) == doctest::Approx(best));
  }
}

TEST_CASE("thousands of lengths are grouped as tens are") {
  std::mt19937_64 generator(1);
  std::vector<double> values;
  for (int i = 0; i < 6000; ++i)
    values.push_back(2 + static_cast<double>(i % 3) + 0.1 * (uniform(generator) + uniform(generator) - 1));
  const std::vector<LengthGroup> groups = group_lengths(values, 0.01);
  REQUIRE(groups.size() == 3);
  for (int g = 0; g < 3; ++g) {
    const LengthGroup& group = groups[static_cast<std::size_t>(g)];
    CHECK(group.members.size() == 2000);
    CHECK(group.mean_m == doctest::Approx(2.0 + g).epsilon(0.002));
    CHECK(std::all_of(group.members.begin(), group.members.end(), [&](int i) { return i % 3 == g; }));
  }
  // Into more groups than there are different lengths, and as fast.
  CHECK(group_lengths_into(std::vector<double>(5000, 3.0), 0.01, 4).size() == 4);
}

TEST_CASE("the axis is found in noise and among stragglers, and not where there is none") {
  int false_axes = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    std::mt19937_64 generator(seed);
    const double axis = 2 + 2 * uniform(generator);
    std::vector<double> pitches, random;
    for (int i = 0; i < 40; ++i) {
      const double noise = 0.06 * (uniform(generator) + uniform(generator) - 1);
      pitches.push_back(i % 20 == 7 ? (1.4 + 0.01 * i) * axis
                                    : axis * static_cast<double>(1 + generator() % 3) + noise);
      random.push_back(2 + 7 * uniform(generator));
    }
    const auto found = find_axis(pitches, 0.02);
    REQUIRE(found.has_value());
    CHECK(found->period_m == doctest::Approx(axis).epsilon(0.01));
    false_axes += find_axis(random, 0.02).has_value();
  }
  CHECK(false_axes == 0);
}

TEST_CASE(
    "a stretch that recurs becomes a unit, equal rooms in rows of any length a repeat, chance nothing") {
  std::vector<std::vector<int>> units, random;
  std::mt19937_64 generator(3);
  for (int i = 0; i < 12; ++i) {
    units.push_back({0});
    random.push_back({});
    for (int k = 0; k < 4; ++k) units.back().insert(units.back().end(), {1, 2, 3});
    for (int k = 0; k < 12; ++k) random.back().push_back(static_cast<int>(generator() % 4));
  }
  const SequenceModel model = describe_sequences(units, 4);
  const bool has_unit = std::any_of(model.tokens.begin(), model.tokens.end(),
                                    [](const SequenceToken& token) { return token.symbols.size() >= 3; });
  CHECK(has_unit);
  CHECK(describe_sequences(random, 4).tokens.size() == 4);
  // What the tokens stand for is the input again.
  for (std::size_t r = 0; r < units.size(); ++r) {
    std::size_t symbols = 0;
    for (const int t : model.sequences[r])
      if (model.tokens[static_cast<std::size_t>(t)].most == 0)
        symbols += model.tokens[static_cast<std::size_t>(t)].symbols.size();
    CHECK((symbols == units[r].size() || model.tokens.back().most > 0));
  }
}

TEST_CASE("probabilities come back within their statistical error from rows drawn with them") {
  // A chain of two types: after A comes A with 0.8, after B comes B with 0.3; 200 rows of 10 rooms.
  std::mt19937_64 generator(11);
  LearnData data;
  data.inner_wall_m = 0.1;
  for (int r = 0; r < 200; ++r) {
    std::vector<std::pair<std::string, double>> rooms;
    bool a = true;
    for (int i = 0; i < 10; ++i) {
      if (i > 0) a = uniform(generator) < (a ? 0.8 : 0.7);
      const double noise = 0.1 * (uniform(generator) + uniform(generator) - 1);
      rooms.emplace_back(a ? "A" : "B", (a ? 3.0 : 4.5) + noise);
    }
    data.rows.push_back(row_of(rooms, 0.1));
  }
  const LearnedRules learned = learn_rules(data);
  const RuleSet rules = parsed(learned);
  REQUIRE(rules.rooms.size() == 2);
  CHECK(rules.rooms[0].width.components[0].normal.mean_m == doctest::Approx(3.0).epsilon(0.005));
  CHECK(rules.rooms[1].width.components[0].normal.mean_m == doctest::Approx(4.5).epsilon(0.005));
  CHECK(rules.rooms[0].width.components[0].normal.sd_m == doctest::Approx(0.041).epsilon(0.25));
  const double share_of_a = 0.7 / 0.9;  // in the long run
  for (const LearnedRule& rule : learned.rules) {
    if (rule.first || rule.any_type >= 0 || rule.classes.size() != 1 || rule.most > 0) continue;
    const bool is_a =
        learned
            .types[static_cast<std::size_t>(learned.classes[static_cast<std::size_t>(rule.classes[0])].type)]
            .name == "A";
    CHECK(rule.probability == doctest::Approx(is_a ? share_of_a : 1 - share_of_a).epsilon(0.1));
  }
}

TEST_CASE("door places: what most do is the habit, one that differs widens it") {
  std::vector<KnownRoom> rooms(12);
  std::vector<const KnownRoom*> pointers;
  for (std::size_t i = 0; i < rooms.size(); ++i) {
    rooms[i].width_m = i % 2 == 0 ? 2.8 : 5.8;
    rooms[i].doors_known = true;
    const double end = i == 3 ? 3.0 : rooms[i].width_m - 0.1;
    rooms[i].doors = {{end - 1, end, 2.1}};
    pointers.push_back(&rooms[i]);
  }
  LearnedType type;
  learn_habits(pointers, 0.02, type);
  REQUIRE(type.door.has_value());
  CHECK(type.door->width_m == doctest::Approx(1));
  REQUIRE(type.door->places.size() == 2);
  CHECK(type.door->places[0].from_end);
  CHECK(type.door->places[0].mean_m == doctest::Approx(0.1));
  CHECK(type.door->places[1].sd_m > 1);
  double total = 0;
  for (const auto& place : type.door->places) total += place.share;
  CHECK(total == doctest::Approx(1));
}

TEST_CASE("an update re-estimates probabilities and widths and leaves every other byte alone") {
  const std::string before =
      "grammar hand;\n\nlet axis = 2.5 m;  // mine\nlet usual = 6 cm;\nwall inner 0.10 m, outer 0.25 m;\n"
      "height 2.70 m;\n\n"
      "room Office { width axis - 0.1 m +- 8 cm : 30 % or 2*axis - 0.1 m +- usual : 70 %; }\n"
      "room WC { width 2460 mm +- 0.08 m; }  // as built?\nroom Store { width 1.20 m +- 5 cm; }\n\nstart "
      "Row;\n"
      "office: Row -> Office Row : 0.50;  // a guess\nwc: Row -> WC Row : 50 %;\n\n"
      "background 1 % width 1 m .. 9 m;\n";
  UpdatedRules updated = update_rules(before, "hand", three_wings(), {.weight = 4});
  CHECK(updated.probabilities == 2);
  CHECK(updated.widths == 5);
  CHECK(updated.unfilled.empty());
  // 19 offices and 2 toilets meet two uses of each.
  const CheckedRules checked = check_rules(updated.text, "hand");
  REQUIRE(checked.rules);
  CHECK(checked.rules->rules[0].probability == doctest::Approx(21.0 / 25).epsilon(0.03));
  CHECK(checked.rules->rules[1].probability == doctest::Approx(4.0 / 25).epsilon(0.1));
  // 4 rooms of 2.46 m +- 8 cm meet 2 of 2.40 m, and the offices a tenth of which may be toilets.
  const Normal wc = checked.rules->rooms[1].width.components[0].normal;
  CHECK(wc.mean_m == doctest::Approx(2.44).epsilon(0.003));
  CHECK(wc.sd_m ==
        doctest::Approx(std::sqrt((4 * 0.08 * 0.08 + 4 * 0.02 * 0.02 + 2 * 0.04 * 0.04) / 6)).epsilon(0.02));
  // 13 offices of one axis, 4 of which the wall outside has cut by 15 cm, 6 of two: the means are made of
  // constants and stay.
  const auto& office = checked.rules->rooms[0].width.components;
  CHECK(office[0].normal.mean_m == doctest::Approx(2.4));
  CHECK(office[1].normal.mean_m == doctest::Approx(4.9));
  CHECK(office[1].normal.sd_m == doctest::Approx(0.06));
  CHECK(office[0].weight > office[1].weight);
  CHECK(office[0].weight + office[1].weight == doctest::Approx(1).epsilon(0.01));
  // What is not a number of these is byte for byte the same.
  std::string same = before;
  const auto put = [&](const std::string& from, const std::string& mark, const std::string& end) {
    for (std::string* text : {&same, &updated.text}) {
      const std::size_t begin = text->find(from);
      REQUIRE(begin != std::string::npos);
      text->replace(begin + from.size(), text->find(end, begin + from.size()) - begin - from.size(), mark);
    }
  };
  put("WC Row : ", "P", ";");
  put("Office Row : ", "P", ";");
  put("WC { width ", "M", ";");
  put("axis - 0.1 m +- ", "S", " or");
  put("usual : ", "S", ";");
  CHECK(updated.text == same);
}

TEST_CASE("an update needs rules that make some row") {
  CHECK_THROWS_AS(update_rules("grammar x; room", "broken", three_wings()), InputError);
}
