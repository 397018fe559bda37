#include "floor/evaluate.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/progress.h"
#include "app/read_known_floors.h"
#include "app/rules_file.h"
#include "app/verbs.h"
#include "floor/cross.h"
#include "floor/known_rows.h"
#include "floor/read_indoor.h"
#include "floor/read_model.h"
#include "geometry/error.h"
#include "geometry/file.h"
#include "grammar/language.h"
#include "grammar/learn.h"

namespace gramap {
namespace {

struct EvaluateArguments {
  std::string model, truth;
  std::string json, html;
  std::string cross;
  std::vector<std::string> rules;
  bool likelihood = false;
  double wall_m = 0.2;
  LearnOptions learning;
  CrossOptions crossing;
};

/// The floors to leave out in turn, by name: a folder's floor folders and GeoJSON files, or the levels of an
/// indoor plan.
KnownFloors floors_in(const std::string& given, double wall_m) {
  std::error_code ignored;
  std::vector<std::filesystem::path> paths;
  if (std::filesystem::is_regular_file(given, ignored) || is_indoor_plan(given)) {
    paths.emplace_back(given);
  } else if (!std::filesystem::is_directory(given, ignored)) {
    throw InputError({given}, "this is no folder",
                     "--cross takes a folder that holds several floors, or an indoor plan of several levels");
  } else {
    for (const auto& entry : std::filesystem::directory_iterator(given)) {
      const std::filesystem::path& path = entry.path();
      const bool floor_folder = std::filesystem::exists(path / "truth.geojson", ignored) ||
                                std::filesystem::exists(path / "unit.geojson", ignored);
      if (floor_folder || path.extension() == ".geojson") paths.push_back(path);
    }
    std::sort(paths.begin(), paths.end());
  }
  KnownFloors known;
  for (const auto& path : paths) read_known_floors(path.string(), wall_m, known);
  if (known.floors.empty())
    throw InputError({given}, "there is no floor in this folder",
                     "put floor folders with truth.geojson, or GeoJSON files, into it");
  if (known.floors.size() < 2)
    throw InputError({given}, "there is only one floor, and none to learn from when it is left out",
                     "--cross takes several floors, or an indoor plan of several levels");
  return known;
}

RuleSet make_rules(const LearnedRules& learned) {
  const CheckedRules checked = check_rules(to_text(learned), "learned rules");
  if (!checked.rules) throw std::logic_error("learned rules that do not pass the check");
  return *checked.rules;
}

/// Fits every floor with the rules of the others and prints how well.
void print_scores(const EvaluateArguments& arguments, const LearnData& data, std::size_t floors) {
  std::printf(
      "leave one floor out: %zu floors, %d draws, scanned widths %.0f %% and positions %.2f m off%s; %s\n",
      floors, arguments.crossing.draws, 100 * arguments.crossing.width_error,
      arguments.crossing.place_sigma_m, arguments.crossing.doors ? ", doors seen from the hallways" : "",
      arguments.crossing.least_error ? "layouts of least expected error" : "most probable layouts");
  std::printf("%8s  %-15s %9s %13s %26s %12s %12s %7s\n", "scanned", "rules", "present", "counts right",
              "unscanned: mean error", "<= 10 cm", "nats a room", "failed");
  std::fflush(stdout);
  Progress progress("evaluating");
  CrossListener listener;
  listener.step = [&](const std::string& what, std::size_t total) { progress.step(what, total); };
  listener.score = [](const CrossScore& score) {
    char nats[32] = "-";
    if (score.method != CrossMethod::equal_division)
      std::snprintf(nats, sizeof nats, "%.3f", score.unscanned_nats);
    std::printf("%7.0f%%  %-15s %8.1f%% %12.1f%% %13.3f m +- %.3f m %11.1f%% %12s %7d\n", 100 * score.share,
                to_string(score.method), 100 * score.present, 100 * score.spaces_right,
                score.unscanned_error_m, score.unscanned_error_deviation_m, 100 * score.unscanned_within_10cm,
                nats, score.failed);
    std::fflush(stdout);
  };
  cross_validate(data, arguments.learning, make_rules, arguments.crossing, listener);
  std::printf("\n");
}

/// How probable each floor is under the rules of the others and under rule files.
void print_likelihoods(const EvaluateArguments& arguments, const LearnData& data) {
  std::vector<std::pair<std::string, RuleSet>> others;
  for (const std::string& path : arguments.rules) {
    others.emplace_back(path, read_rules(path));
    others.back().second.inner_wall_m = data.inner_wall_m;  // as a fit would: the floors' own walls
  }
  std::printf("log likelihood of the floor left out, nats per room\n");
  for (const HeldOutLikelihood& item :
       held_out_likelihoods(data, arguments.learning, make_rules, others, arguments.crossing.grid_m))
    std::printf("  %-34s %-28s %9.3f%s\n", item.floor.c_str(), item.rules.c_str(), item.nats_per_room,
                std::isinf(item.nats_per_room) ? "  (a row that these rules cannot make)" : "");
}

int cross(const EvaluateArguments& arguments) {
  const KnownFloors known = floors_in(arguments.cross, arguments.wall_m);
  const bool set_aside = report_on_reading(known);
  const LearnData data = learn_data(known.floors, known.truths);
  if (!arguments.likelihood) print_scores(arguments, data, known.floors.size());
  print_likelihoods(arguments, data);
  return set_aside ? kSetAside : kDone;
}

int judge(const EvaluateArguments& arguments) {
  const ReadModel model = read_model(arguments.model);
  FloorGroundTruth
      floor;  // known beside the truth: then its reference lines say what is width and what depth
  std::error_code ignored;
  const std::filesystem::path truth_path = arguments.truth;
  if (is_indoor_plan(truth_path) || std::filesystem::exists(truth_path / "floor.geojson", ignored))
    floor = read_floor(truth_path);
  const bool set_aside = report_on_reading(floor);
  const Evaluation evaluation = evaluate(model.floor, read_truth(truth_path, floor.origin), floor);
  if (!arguments.json.empty()) write_file(arguments.json, to_json(evaluation));
  if (!arguments.html.empty())
    write_file(arguments.html,
               to_html(evaluation, std::filesystem::path(arguments.model).filename().string() + " against " +
                                       (floor.name.empty() ? arguments.truth : floor.name)));
  if (arguments.json != "-" && arguments.html != "-") std::fputs(to_text(evaluation).c_str(), stdout);
  return set_aside ? kSetAside : kDone;
}

}  // namespace

Verb declare_evaluate(CLI::App& gramap) {
  auto arguments = std::make_shared<EvaluateArguments>();
  CLI::App* verb =
      gramap.add_subcommand("evaluate", "Judge a model against the truth, or rules against floors");
  CLI::Option* model =
      verb->add_option("model", arguments->model, "The model (.glb or .gltf) that gramap wrote");
  CLI::Option* truth = verb->add_option(
      "truth", arguments->truth, "Floor folder with truth.geojson, or a GeoJSON file with the true rooms");
  model->needs(truth);
  verb->add_option("--json", arguments->json, "Write the evaluation as JSON; - is standard output");
  verb->add_option("--html", arguments->html,
                   "Write a page with the plan coloured by error; - is standard output");
  CLI::Option* cross_option = verb->add_option("--cross", arguments->cross,
                                               "Instead of judging a model: leave each floor of this folder, "
                                               "or each level of this indoor plan, out in "
                                               "turn, learn on the others, fit it");
  cross_option->excludes(model);
  verb->add_option("--rules", arguments->rules,
                   "With --cross: rule files whose likelihood is printed beside, with the floors' walls");
  verb->add_flag("--likelihood", arguments->likelihood,
                 "With --cross: print the likelihoods of the floors left out, and fit nothing");
  verb->add_option("--shares", arguments->crossing.shares, "With --cross: shares of rooms that are scanned")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  verb->add_option("--draws", arguments->crossing.draws, "With --cross: random choices of rooms per share")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  verb->add_option("--seed", arguments->crossing.seed, "With --cross: seed of the random choices")
      ->capture_default_str();
  verb->add_option("--width-error", arguments->crossing.width_error,
                   "With --cross: standard deviation of a scanned width, relative")
      ->check(CLI::Range(0.0001, 0.5))
      ->capture_default_str();
  verb->add_option("--place-error", arguments->crossing.place_sigma_m,
                   "With --cross: standard deviation of a scanned room's position, metres")
      ->check(CLI::Range(0.001, 10.0))
      ->capture_default_str();
  verb->add_option(
          "--grid", arguments->crossing.grid_m,
          "With --cross: step of the fit's positions in metres; 0.05 is enough for plans drawn by hand")
      ->check(CLI::Range(0.005, 0.5))
      ->capture_default_str();
  verb->add_flag("--doors", arguments->crossing.doors, "With --cross: the hallways' doors are seen, too");
  verb->add_option(
          "--likeness", arguments->crossing.likeness,
          "With --cross: how alike the rooms of a space are, as in fit; 0: as the rules say [what the "
          "scans show]")
      ->check(CLI::Range(0.0, 1.0));
  verb->add_flag("!--most-probable", arguments->crossing.least_error,
                 "With --cross: judge the most probable layout instead of the one whose widths are expected "
                 "to be least wrong");
  verb->add_option("--wall", arguments->wall_m,
                   "Thickness in metres of inner walls that a plan draws as lines")
      ->check(CLI::Range(0.01, 1.0))
      ->capture_default_str();
  return [arguments] {
    if (!arguments->cross.empty()) return cross(*arguments);
    if (arguments->model.empty()) {
      std::fputs("gramap: evaluate needs a model and its truth, or --cross\n", stderr);
      return static_cast<int>(kUsage);
    }
    return judge(*arguments);
  };
}

}  // namespace gramap
