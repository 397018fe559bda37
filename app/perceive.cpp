// `gramap perceive`: the scans of rooms in, what they say of each room out.
#include "perception/perceive.h"

#include <sys/resource.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "app/fault.h"
#include "app/perceive_table.h"
#include "app/png.h"
#include "app/scan_format.h"
#include "app/verbs.h"
#include "floor/ground_truth.h"
#include "geometry/error.h"
#include "geometry/file.h"
#include "geometry/say.h"
#include "perception/debug.h"
#include "perception/label_image.h"
#include "perception/random.h"

namespace gramap {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::vector<std::string> folders;
  std::string output = "-";
  ScanFormat format;
  std::string debug, truth;
  std::optional<std::uint64_t> own_frames;
  bool verbose = false, mistakes = false;
  std::string images;
  PerceptionOptions perception;
};

/// Folders of rooms named directly, and those inside a `scans` folder or a floor folder.
std::vector<fs::path> rooms_of(const std::vector<std::string>& folders) {
  std::vector<fs::path> rooms;
  for (const std::string& folder : folders) {
    fs::path path = folder;
    if (fs::is_directory(path / "scans")) path /= "scans";
    std::vector<fs::path> inside;
    std::error_code error;
    bool has_files = false;
    for (fs::directory_iterator it(path, error), last; !error && it != last; it.increment(error)) {
      has_files |= it->is_regular_file();
      if (it->is_directory()) inside.push_back(it->path());
    }
    std::sort(inside.begin(), inside.end());
    if (has_files || inside.empty())
      rooms.push_back(path);
    else
      rooms.insert(rooms.end(), inside.begin(), inside.end());
  }
  return rooms;
}

/// A frame that a device could have made up when it was switched on in a room: any heading, any origin.
Eigen::Isometry3d made_up_frame(const std::string& room, std::uint64_t seed) {
  Random random(seed_for(seed, room));
  Eigen::Isometry3d frame(
      Eigen::AngleAxisd(random.uniform(-std::numbers::pi, std::numbers::pi), Vec3::UnitZ()));
  frame.pretranslate(Vec3(random.uniform(-50, 50), random.uniform(-50, 50), random.uniform(-2, 2)));
  return frame;
}

constexpr std::array<std::uint8_t, 3> kDoorColour = {180, 95, 0}, kWindowColour = {0, 60, 255};

/// What each wall looks like from the scanner positions, as pictures ROOM_wallN.png.
void write_wall_images(const fs::path& folder, const Perception& found) {
  make_folder(folder);
  const std::vector<WallImage> walls = label_images(found.cloud, found.observation);
  for (std::size_t i = 0; i < walls.size(); ++i) {
    Picture picture = wall_picture(walls[i]);
    for (const OpeningObservation& one : found.observation.openings)
      if (one.wall == static_cast<int>(i))
        frame_opening(picture, walls[i], one, one.kind == "door" ? kDoorColour : kWindowColour);
    write_file(folder / (found.observation.room + "_wall" + std::to_string(i) + ".png"),
               png_bytes(picture.width, picture.height, picture.rgb));
  }
}

int run(const Options& options) {
  const std::vector<fs::path> rooms = rooms_of(options.folders);
  const ReadOptions reading = read_options(options.format);
  PerceptionOptions perception = options.perception;
  if (options.verbose)
    perception.on_stage = [](const std::string& stage, double seconds) {
      rusage usage{};
      getrusage(RUSAGE_SELF, &usage);
      std::fprintf(stderr, "  %-12s %8.1f ms   peak memory so far %6.0f MB\n", stage.c_str(), seconds * 1e3,
                   static_cast<double>(usage.ru_maxrss) / 1024);
    };
  std::optional<FloorTruth> truth;
  if (!options.truth.empty()) truth = read_truth(options.truth);
  std::vector<RoomObservation> perceived;
  std::vector<std::string> scanned;
  const bool many = rooms.size() > 1;
  if (many && options.output == "-" && !truth)
    throw CLI::ValidationError("-o", "several rooms need a folder to write to: -o FOLDER");
  std::size_t bad = 0;
  for (const fs::path& folder : rooms) {
    scanned.push_back(folder.filename());
    try {
      if (options.verbose) std::fprintf(stderr, "%s\n", folder.c_str());
      if (!options.debug.empty())
        perception.on_found = [&](const Perception& found) {
          fs::path to = options.debug;
          if (many) to /= folder.filename();
          write_debug(to, found);
        };
      const auto start = std::chrono::steady_clock::now();
      RoomScans scans = read_room_scans(folder, reading);
      if (options.own_frames)
        for (Scan& scan : scans.scans)
          scan.room_from_scanner = made_up_frame(scans.room, *options.own_frames) * scan.room_from_scanner;
      RegisteredCloud cloud = registered(scans);
      const std::string name = scans.room;
      scans = {};  // the cloud has the points now
      if (perception.on_stage)
        perception.on_stage("reading",
                            std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
      const Perception found = perceive(std::move(cloud), name, perception);
      const RoomObservation& room = found.observation;
      if (!options.images.empty()) write_wall_images(options.images, found);
      if (truth) perceived.push_back(room);
      fs::path output = options.output;
      if (many && output != "-") {
        make_folder(output);
        output /= room.room + ".json";
      }
      if (output != "-" || !truth) write_file(output, to_json(room));
      std::fprintf(stderr, "%s: width %.3f ± %.3f m, depth %.3f ± %.3f m, height %.3f ± %.3f m, %s, %s, %s\n",
                   room.room.c_str(), room.width.value_m, room.width.sigma_m, room.depth.value_m,
                   room.depth.sigma_m, room.height.value_m, room.height.sigma_m,
                   said_count(room.walls.size(), "wall").c_str(),
                   said_count(room.openings.size(), "door or window", "doors and windows").c_str(),
                   said_count(room.furniture.size(), "piece of furniture", "pieces of furniture").c_str());
      for (const std::string& remark : room.remarks) std::fprintf(stderr, "  %s\n", remark.c_str());
    } catch (const InputError& error) {
      if (!many) throw;
      print_fault(error);
      ++bad;
    }
  }
  if (truth) {
    std::fputs(accuracy_table(perceived, *truth).c_str(), stdout);
    std::fputs(things_table(scanned, perceived, *truth, options.mistakes).c_str(), stdout);
  }
  if (bad == rooms.size()) return kInputFault;
  return bad ? kSetAside : kDone;
}

}  // namespace

Verb declare_perceive(CLI::App& gramap) {
  auto options = std::make_shared<Options>();
  CLI::App* verb = gramap.add_subcommand(
      "perceive", "Say of each room's scans how large the room is and where its walls are");
  verb->add_option("folders", options->folders,
                   "Folders of one room's scans each, or a folder of such folders")
      ->required();
  verb->add_option(
          "-o,--output", options->output,
          "The file for one room (- is standard output); for several, the folder for their ROOM.json")
      ->capture_default_str();
  declare_scan_format(*verb, options->format);
  verb->add_option("--seed", options->perception.hough.seed, "Seed of the random triples")
      ->capture_default_str();
  verb->add_option(
      "--debug", options->debug,
      "Folder for what each stage saw: planes.ply, planes.txt, plan.svg (for several rooms, a folder each)");
  verb->add_option(
      "--wall-images", options->images,
      "Folder for a picture of every wall as the scanners saw it: labels (grey: wall, white: seen "
      "through, red: not seen) and depth, doors found framed brown, windows blue");
  verb->add_flag("!--no-openings", options->perception.find_openings, "Do not look for doors and windows");
  verb->add_flag("!--no-furniture", options->perception.find_furniture, "Do not look for furniture");
  verb->add_option(
      "--truth", options->truth,
      "A truth.geojson, or the floor folder with one: print how far each room is from it, and how "
      "many doors, windows and pieces of furniture were found");
  verb->add_option(
          "--own-frames", options->own_frames,
          "A seed: turn and shift the scans of each room at random before anything else, as if every room "
          "had been scanned in a frame of its own. With --truth it shows that no figure depends on the "
          "building's frame")
      ->type_name("SEED");
  verb->add_flag("--mistakes", options->mistakes,
                 "With --truth: name each thing missed and each found in vain");
  verb->add_flag("-v,--verbose", options->verbose, "Say what each stage takes, time and memory");
  return [options] { return run(*options); };
}

}  // namespace gramap
