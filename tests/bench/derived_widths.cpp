// How good the widths of rooms are that nobody scanned: the rows on derived widths of the quality table.
//
//   derived_widths FLOOR_FOLDER RULES [SEEDS]
//
// Perceives the floor once, then fits it with all rooms, with random halves of them, with and without the
// hallways, and with the hallways alone; prints a Markdown table. The truth is only read to judge.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "floor/fit_floor.h"
#include "floor/scan_folder.h"
#include "geometry/error.h"
#include "geometry/file.h"
#include "grammar/language.h"
#include "tests/support/bench_main.h"
#include "tests/support/true_widths.h"

using namespace gramap;

namespace {

struct Tally {
  int runs = 0, runs_right = 0;  // every space has the right number of rooms
  int spaces = 0, spaces_right = 0;
  std::vector<double> errors_m;  // of unscanned rooms in spaces with the right number
  int sure = 0, sure_right = 0;  // unscanned rooms called 90 % sure or more, those that are within 10 cm
  int inside_two_sigma = 0, calibrated = 0;
};

void judge(const FittedFloor& fitted, const FloorTruth& truth, bool derived_only, Tally& tally) {
  ++tally.runs;
  bool all_right = true;
  for (const Space& space : fitted.floor.spaces) {
    const auto widths = test::true_widths(space, truth);
    std::vector<const FittedRoom*> rooms;
    for (const FittedRoom& room : fitted.rooms)
      if (room.space == space.id) rooms.push_back(&room);
    ++tally.spaces;
    const bool right = rooms.size() == widths.size();
    tally.spaces_right += right;
    all_right = all_right && right;
    for (std::size_t i = 0; i < rooms.size(); ++i) {
      if (derived_only && rooms[i]->origin != Origin::derived) continue;
      // Without the right number, a room is held against the true one that lies where it does.
      const double middle = rooms[i]->start_m + rooms[i]->width_m / 2;
      const auto there = std::min_element(widths.begin(), widths.end(), [&](const auto& a, const auto& b) {
        return std::abs(a.start_m + a.width_m / 2 - middle) < std::abs(b.start_m + b.width_m / 2 - middle);
      });
      const double error = std::abs(rooms[i]->width_m - (right ? widths[i].width_m : there->width_m));
      if (right) tally.errors_m.push_back(error);
      ++tally.calibrated;
      tally.inside_two_sigma += error <= 2 * rooms[i]->width_sigma_m + 1e-9;
      if (rooms[i]->room_probability >= 0.9) ++tally.sure, tally.sure_right += error <= 0.10;
    }
  }
  tally.runs_right += all_right;
}

void print(const char* name, Tally tally) {
  std::sort(tally.errors_m.begin(), tally.errors_m.end());
  double mean = 0, within = 0;
  for (const double error : tally.errors_m) mean += error, within += error <= 0.10;
  const double count = static_cast<double>(std::max<std::size_t>(1, tally.errors_m.size()));
  std::printf("| %s | %d/%d | %d/%d | %.1f | %.0f%% | %d/%d | %.0f%% |\n", name, tally.runs_right, tally.runs,
              tally.spaces_right, tally.spaces, 100 * mean / count, 100 * within / count, tally.sure_right,
              tally.sure, 100.0 * tally.inside_two_sigma / std::max(1, tally.calibrated));
}

int run(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: derived_widths FLOOR_FOLDER RULES [SEEDS]\n");
    return 2;
  }
  const std::filesystem::path folder = argv[1];
  const int seeds = argc > 3 ? std::atoi(argv[3]) : 20;
  const CheckedRules checked = check_rules(read_file(argv[2]), argv[2]);
  if (!checked.rules) throw InputError({argv[2]}, "the rule file has errors", "see gramap check");
  const FloorGroundTruth floor = read_floor(folder);
  const FloorTruth truth = read_truth(folder);
  const std::vector<RoomObservation> all = perceive_folder(folder / "scans").rooms;
  std::set<std::string> given;
  for (const Hallway& hallway : floor.hallways) given.insert(hallway.id);
  for (const FixedRoom& fixed : floor.fixed) given.insert(fixed.id);
  std::vector<RoomObservation> rooms, hallways;
  for (const RoomObservation& room : all) (given.count(room.room) ? hallways : rooms).push_back(room);

  const auto fit = [&](std::vector<RoomObservation> chosen, bool with_hallways) {
    if (with_hallways) chosen.insert(chosen.end(), hallways.begin(), hallways.end());
    FloorFitOptions options;
    std::vector<SetAsideInput> set_aside;
    return fit_floor(floor, *checked.rules, space_problems(floor, *checked.rules, chosen, options, set_aside),
                     chosen, options);
  };

  std::printf(
      "| scanned | floors with the right number of rooms | spaces | mean width error cm | within 10 cm | "
      "sure (>= 90 %%) and within 10 cm | true width in 2 sigma |\n");
  std::printf("| --- | --- | --- | --- | --- | --- | --- |\n");
  Tally everything, half, half_without, hallways_only;
  judge(fit(rooms, true), truth, false, everything);
  print("all rooms and hallways", everything);
  for (int seed = 1; seed <= seeds; ++seed) {
    std::mt19937 random(static_cast<unsigned>(seed));
    std::vector<RoomObservation> chosen = rooms;
    for (std::size_t i = chosen.size(); i > 1; --i) std::swap(chosen[i - 1], chosen[random() % i]);
    chosen.resize(chosen.size() / 2);
    judge(fit(chosen, true), truth, true, half);
    judge(fit(chosen, false), truth, true, half_without);
  }
  print("half of the rooms, hallways", half);
  print("half of the rooms, no hallways", half_without);
  judge(fit({}, true), truth, true, hallways_only);
  print("hallways only", hallways_only);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return test::bench_main("derived_widths", [&] { return run(argc, argv); });
}
