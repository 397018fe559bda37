// `gramap simulate`: a floor of known truth, or one drawn from rules, in; scans of its rooms out.
#include "perception/simulate.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "app/rules_file.h"
#include "app/verbs.h"
#include "floor/building.h"
#include "floor/drawn_floor.h"
#include "floor/fitted_geojson.h"
#include "floor/ground_truth.h"
#include "geometry/error.h"
#include "geometry/file.h"
#include "geometry/say.h"
#include "perception/random_building.h"
#include "perception/scan.h"

namespace gramap {
namespace {

struct Arguments {
  std::string floor, rules;
  PlainFloorOptions plain;
  double clutter = 0;
  std::string out;
  std::vector<std::string> rooms;
  int decimals = 3;
  std::string frame = "building";
  double pin_sigma_m = 0.6;
  SimulateOptions options;
};

void declare_walk(CLI::App& verb, SimulateOptions& o) {
  verb.add_option("--seed", o.seed, "Everything random comes from it: same seed, same bytes")
      ->capture_default_str();
  verb.add_option("--points", o.points_per_room, "Points measured in a room, all positions together")
      ->check(CLI::Range(100, 100000000))
      ->capture_default_str();
  verb.add_option("--positions", o.positions,
                  "Places in a room that the person stands at; 0: 4 to 12, by its area")
      ->check(CLI::Range(0, 1000))
      ->capture_default_str();
  verb.add_option("--eye-height", o.eye_height_m, "Height of the sensor over the floor, metres")
      ->check(CLI::Range(0.3, 3.0))
      ->capture_default_str();
  verb.add_option("--eye-height-sd", o.eye_height_sd_m, "Its standard deviation from place to place, metres")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
}

void declare_sensor(CLI::App& verb, SimulateOptions& o) {
  const CLI::Range share(0.0, 1.0), length(0.0, 5.0), angle(0.0, 45.0);
  verb.add_option("--fov", o.fov_horizontal_deg,
                  "Degrees seen around from each place; 360: the person turns with the sensor")
      ->check(CLI::Range(10.0, 360.0))
      ->capture_default_str();
  verb.add_option("--fov-vertical", o.fov_vertical_deg,
                  "Degrees seen up and down, half of them below the horizon")
      ->check(CLI::Range(10.0, 180.0))
      ->capture_default_str();
  verb.add_option("--range", o.range_m, "Metres that the sensor reaches")
      ->check(CLI::Range(0.5, 100.0))
      ->capture_default_str();
  verb.add_option("--noise", o.noise_m, "Standard deviation of a distance close by, metres")
      ->check(length)
      ->capture_default_str();
  verb.add_option("--noise-growth", o.noise_growth_per_m,
                  "What it grows by with the square of the distance, 1/m")
      ->check(length)
      ->capture_default_str();
  verb.add_option("--stray", o.stray_share, "Share of the points that are nowhere near a surface")
      ->check(share)
      ->capture_default_str();
  verb.add_option("--registration", o.registration_sd_m,
                  "Error of each scan's position, metres (standard deviation)")
      ->check(length)
      ->capture_default_str();
  verb.add_option("--registration-angle", o.registration_sd_deg, "Error of each scan's heading, degrees")
      ->check(angle)
      ->capture_default_str();
  verb.add_option("--drift", o.drift_sd_m,
                  "Rigid error of all of a room's poses, metres (standard deviation)")
      ->check(length)
      ->capture_default_str();
  verb.add_option("--drift-angle", o.drift_sd_deg, "Rigid error of a room's heading, degrees")
      ->check(angle)
      ->capture_default_str();
}

void declare_day(CLI::App& verb, SimulateOptions& o) {
  const CLI::Range share(0.0, 1.0);
  verb.add_option("--doors-closed", o.doors_closed_share, "Share of the doors that are closed")
      ->check(share)
      ->capture_default_str();
  verb.add_option("--doors-ajar", o.doors_ajar_share,
                  "Share of the doors whose leaf stands half open in the room")
      ->check(share)
      ->capture_default_str();
  verb.add_option("--window-frame", o.window_frame_m,
                  "Width of the windows' frames, metres; panes are transparent")
      ->check(CLI::Range(0.0, 0.3))
      ->capture_default_str();
  verb.add_option("--blinds", o.blinds_share, "Share of the windows with a blind partly let down")
      ->check(share)
      ->capture_default_str();
  verb.add_option(
          "--opposite", o.opposite_share,
          "Share of the windows with something in sight behind them, 1.5 to 5 m off, where no room is")
      ->check(share)
      ->capture_default_str();
  verb.add_option("--outer-wall", o.outer_wall_m, "Thickness of walls that no room lies behind, metres")
      ->check(CLI::Range(0.01, 2.0))
      ->capture_default_str();
}

void declare_drawn(CLI::App& verb, Arguments& arguments) {
  const CLI::Range length(0.5, 1000.0);
  verb.add_option("--rules", arguments.rules,
                  "Rule file to draw the floor's rooms from, with their doors, windows and usual furniture");
  verb.add_option("--length", arguments.plain.length_m,
                  "Without a floor: clear length of the hallway and the space on either side, metres")
      ->check(length)
      ->capture_default_str();
  verb.add_option("--depth", arguments.plain.depth_m, "Without a floor: clear depth of the spaces, metres")
      ->check(length)
      ->capture_default_str();
  verb.add_option("--hallway-width", arguments.plain.hallway_m,
                  "Without a floor: clear width of the hallway, metres")
      ->check(length)
      ->capture_default_str();
  verb.add_option("--clutter", arguments.clutter,
                  "More furniture at random, and things on it: 0 none, 1 crammed")
      ->check(CLI::Range(0.0, 2.0))
      ->capture_default_str();
}

std::vector<std::size_t> chosen_rooms(const Building& building, const std::vector<std::string>& names,
                                      const std::string& file) {
  std::vector<std::size_t> chosen;
  std::set<std::string> wanted(names.begin(), names.end());
  for (std::size_t i = 0; i < building.rooms.size(); ++i) {
    check_file_name(building.rooms[i].id, file);
    if (names.empty() || wanted.erase(building.rooms[i].id) > 0) chosen.push_back(i);
  }
  if (!wanted.empty())
    throw InputError({file}, "there is no room '" + *wanted.begin() + "' in the truth",
                     "name rooms by the \"id\" of their features");
  return chosen;
}

void write_room(const std::filesystem::path& folder, const SimulatedRoom& room, int decimals) {
  make_folder(folder);
  for (std::size_t i = 0; i < room.scans.size(); ++i) {
    char name[32];
    std::snprintf(name, sizeof name, "scan%03zu", i);
    write_file(folder / (std::string(name) + ".xyz"), xyz_text(room.scans[i].points, decimals));
    write_file(folder / (std::string(name) + ".pose"), pose_to_text(room.scans[i].frame_from_scanner));
  }
}

/// Scans of an earlier run would be read together with the new ones.
void refuse_old_scans(const std::filesystem::path& scans) {
  std::error_code ignored;
  if (std::filesystem::exists(scans, ignored) && !std::filesystem::is_empty(scans, ignored))
    throw InputError({scans.string()}, "there are scans in this folder already",
                     "remove them, or write to another folder");
}

/// Furniture and what lies on it at random, besides what is there; all but the latter is truth as well.
void add_clutter(Building& building, FloorTruth& truth, const Arguments& arguments) {
  for (BuildingRoom& room : building.rooms) {
    const std::size_t before = room.furniture.size();
    Random random(seed_for(arguments.options.seed, "clutter " + room.id));
    furnish(room, arguments.clutter, random);
    for (std::size_t i = before; i < room.furniture.size(); ++i) {
      const BuildingFurniture& piece = room.furniture[i];
      if (piece.counts())
        truth.furniture.push_back({room.id, piece.type, piece.outline, piece.bottom_m, piece.top_m});
    }
  }
}

struct KnownFloor {
  FloorGroundTruth floor;
  FloorTruth truth;
};

KnownFloor known_floor(const Arguments& arguments) {
  if (arguments.rules.empty()) {
    KnownFloor known{read_floor(arguments.floor), {}};
    known.truth = read_truth(arguments.floor, known.floor.origin);
    return known;
  }
  const RuleSet rules = read_rules(arguments.rules);
  const FloorGroundTruth floor =
      arguments.floor.empty() ? plain_floor(rules, arguments.plain) : read_floor(arguments.floor);
  const FittedFloor drawn = drawn_floor(floor, rules, arguments.options.seed);
  return {drawn.floor, truth_of(drawn)};
}

int simulate(const Arguments& arguments) {
  auto [floor, truth] = known_floor(arguments);
  const std::string& source = arguments.floor.empty() ? arguments.rules : arguments.floor;
  Building building = building_of(truth, source);
  if (arguments.clutter > 0) add_clutter(building, truth, arguments);
  const std::vector<std::size_t> rooms = chosen_rooms(building, arguments.rooms, source);
  const std::filesystem::path out = arguments.out;
  refuse_old_scans(out / "scans");

  SimulateOptions options = arguments.options;
  options.room_frame = arguments.frame == "room";
  const std::vector<SimulatedRoom> simulated = simulate_rooms(building, rooms, options);

  floor.pins.clear();
  std::size_t points = 0;
  for (std::size_t i = 0; i < rooms.size(); ++i) {
    const std::string& id = building.rooms[rooms[i]].id;
    write_room(out / "scans" / id, simulated[i], arguments.decimals);
    for (const SimulatedScan& scan : simulated[i].scans) points += scan.points.size();
    if (options.room_frame) {
      Random random(seed_for(options.seed, "pin " + id));
      const double per_axis_m = arguments.pin_sigma_m / std::sqrt(2.0);
      const Vec2 error(per_axis_m * random.normal(), per_axis_m * random.normal());
      floor.pins.push_back({id, simulated[i].mean_position + error, arguments.pin_sigma_m});
    }
  }
  write_file(out / "floor.geojson", to_geojson(floor, {}));
  write_file(out / "truth.geojson", to_geojson({}, truth));
  std::fprintf(stderr, "%s, %s in %s\n", said_count(rooms.size(), "room").c_str(),
               said_count(points, "point").c_str(), (out / "scans").c_str());
  return kDone;
}

}  // namespace

Verb declare_simulate(CLI::App& gramap) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* verb = gramap.add_subcommand(
      "simulate", "Scans of a floor whose rooms are known, as a hand-held depth sensor would take them");
  verb->add_option("floor", arguments->floor,
                   "A floor folder with floor.geojson and truth.geojson, or one GeoJSON file with both; with "
                   "--rules the truth is drawn, and the floor may be left out");
  declare_drawn(*verb, *arguments);
  verb->add_option("-o,--output", arguments->out,
                   "Floor folder to write: scans/<room>/scanNNN.xyz and .pose, floor.geojson, truth.geojson")
      ->required();
  verb->add_option("--rooms", arguments->rooms, "Only these rooms, by id, separated by commas (default: all)")
      ->delimiter(',');
  verb->add_option(
          "--frame", arguments->frame,
          "The frame of the poses: the building's, or each room's own at an unknown heading (then every "
          "room gets a pin in floor.geojson)")
      ->check(CLI::IsMember({"building", "room"}))
      ->capture_default_str();
  verb->add_option("--pin-sigma", arguments->pin_sigma_m,
                   "How far off the pins are, metres (standard deviation)")
      ->check(CLI::Range(0.0, 10.0))
      ->capture_default_str();
  verb->add_option("--decimals", arguments->decimals, "Digits after the point in the scans: 3 is millimetres")
      ->check(CLI::Range(1, 9))
      ->capture_default_str();
  declare_walk(*verb, arguments->options);
  declare_sensor(*verb, arguments->options);
  declare_day(*verb, arguments->options);
  return [arguments] {
    if (arguments->floor.empty() && arguments->rules.empty())
      throw InputError({}, "nothing to simulate scans of", "give a FLOOR with its truth, or --rules RULES");
    return simulate(*arguments);
  };
}

}  // namespace gramap
