// `gramap compress`: rooms' scans in, the same as octrees out, small enough to upload from a phone.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/fault.h"
#include "app/scan_format.h"
#include "app/verbs.h"
#include "geometry/error.h"
#include "geometry/file.h"
#include "perception/compressed_cloud.h"
#include "perception/perceive.h"

namespace gramap {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::string folder, output;
  ScanFormat format;
  std::vector<double> resolutions_m = {0.02};
  bool table = false;
};

/// The folders under `folder`, itself included, that hold scans.
std::vector<fs::path> room_folders(const fs::path& folder) {
  const fs::path root = fs::is_directory(folder / "scans") ? folder / "scans" : folder;
  std::vector<fs::path> rooms;
  std::error_code error;
  for (fs::directory_iterator it(root, error), last; !error && it != last; it.increment(error))
    if (it->is_directory()) rooms.push_back(it->path());
  if (error) throw InputError({folder.string()}, "cannot be read: " + error.message());
  if (rooms.empty()) rooms.push_back(root);
  std::sort(rooms.begin(), rooms.end());
  return rooms;
}

struct Row {
  double resolution_m = 0;
  std::uintmax_t bytes_in = 0, bytes_out = 0;
  std::size_t points_in = 0, points_out = 0;
  double moved_sum_m = 0, moved_most_m = 0;
  std::vector<double> width_errors_m;  // against the room perceived from the scans as they came
  int lost = 0;                        // rooms that were perceived before and no longer are
};

/// How far points are from the centres of the voxels that stand for them, from a sample.
void add_displacement(Row& row, const std::vector<Point>& points, double resolution_m) {
  for (const Point& point : points) {
    double squares = 0;
    for (const float coordinate : point) {
      const double in_voxels = static_cast<double>(coordinate) / resolution_m;
      const double off = (in_voxels - std::floor(in_voxels) - 0.5) * resolution_m;
      squares += off * off;
    }
    row.moved_sum_m += std::sqrt(squares);
    row.moved_most_m = std::max(row.moved_most_m, std::sqrt(squares));
  }
}

bool perceived(const RoomScans& scans, RoomObservation& room) {
  PerceptionOptions options;
  options.find_openings = options.find_furniture = false;
  try {
    room = perceive_room(scans, options);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

void compress_room(const RoomScans& scans, const Options& options, const fs::path& to, bool write,
                   const RoomObservation* before, Row& row) {
  RoomScans after = scans;
  for (Scan& scan : after.scans) {
    std::error_code ignored;
    row.bytes_in += fs::file_size(scan.file, ignored);
    row.points_in += scan.points_m.size();
    add_displacement(row, scan.points_m, row.resolution_m);
    const std::string bytes = compress_points(scan.points_m, row.resolution_m);
    row.bytes_out += bytes.size();
    scan.points_m = decompress_points(bytes, scan.file);
    row.points_out += scan.points_m.size();
    if (!write) continue;
    fs::path name = scan.file.filename();
    if (name.extension() == ".gz") name = name.stem();
    write_file(to / name.replace_extension(".gpc"), bytes);
    write_file(to / name.replace_extension(".pose"), pose_to_text(scan.room_from_scanner));
  }
  if (!options.table || !before) return;
  RoomObservation room;
  if (!perceived(after, room)) {
    ++row.lost;
    return;
  }
  row.width_errors_m.push_back(std::abs(room.width.value_m - before->width.value_m));
  row.width_errors_m.push_back(std::abs(room.depth.value_m - before->depth.value_m));
}

void print_rows(const std::vector<Row>& rows, bool table) {
  std::printf(
      "| resolution mm | bytes in | bytes out | bits a point | points kept | moved, mean mm | most mm |%s\n",
      table ? " width change, mean mm | most mm | rooms lost |" : "");
  std::printf("|---|---|---|---|---|---|---|%s\n", table ? "---|---|---|" : "");
  for (const Row& row : rows) {
    const auto points = static_cast<double>(std::max<std::size_t>(1, row.points_in));
    std::printf("| %.0f | %ju | %ju | %.1f | %.1f %% | %.1f | %.1f |", row.resolution_m * 1e3, row.bytes_in,
                row.bytes_out, 8 * static_cast<double>(row.bytes_out) / points,
                100 * static_cast<double>(row.points_out) / points, row.moved_sum_m / points * 1e3,
                row.moved_most_m * 1e3);
    if (table) {
      double sum = 0, most = 0;
      for (const double error : row.width_errors_m) sum += error, most = std::max(most, error);
      std::printf(" %.1f | %.1f | %d |",
                  1e3 * sum / static_cast<double>(std::max<std::size_t>(1, row.width_errors_m.size())),
                  1e3 * most, row.lost);
    }
    std::printf("\n");
  }
}

int run(const Options& options) {
  if (options.output.empty() && !options.table)
    throw CLI::ValidationError("-o", "say where to write: -o FOLDER (or only --table)");
  const ReadOptions reading = read_options(options.format);
  std::vector<Row> rows;
  for (const double resolution : options.resolutions_m) rows.emplace_back().resolution_m = resolution;
  const std::vector<fs::path> folders = room_folders(options.folder);
  const bool many = folders.size() > 1;
  std::size_t bad = 0;
  for (const fs::path& folder : folders) {
    const fs::path to = many ? fs::path(options.output) / folder.filename() : fs::path(options.output);
    std::error_code ignored;
    if (!options.output.empty() && fs::equivalent(to, folder, ignored))
      throw InputError({to.string()}, "the scans themselves are here: every scan would be there twice",
                       "write to another folder");
    RoomScans scans;
    try {
      scans = read_room_scans(folder, reading);
    } catch (const InputError& error) {
      if (!many) throw;
      print_fault(error);
      ++bad;
      continue;
    }
    if (!options.output.empty()) make_folder(to);
    RoomObservation before;
    const bool known = options.table && perceived(scans, before);
    for (std::size_t i = 0; i < rows.size(); ++i)
      compress_room(scans, options, to, !options.output.empty() && i == 0, known ? &before : nullptr,
                    rows[i]);
  }
  if (bad == folders.size()) return kInputFault;
  print_rows(rows, options.table);
  return bad ? kSetAside : kDone;
}

}  // namespace

Verb declare_compress(CLI::App& gramap) {
  auto options = std::make_shared<Options>();
  CLI::App* verb = gramap.add_subcommand(
      "compress", "Pack rooms' scans as octrees, poses kept, for upload; perceive and fit read the result");
  verb->add_option("folder", options->folder,
                   "Folder of one room's scans, or of such folders, or a floor folder")
      ->required();
  verb->add_option("-o,--output", options->output,
                   "Folder for scanNNN.gpc and scanNNN.pose (for several rooms, a folder each)");
  verb->add_option("-r,--resolution", options->resolutions_m,
                   "Edge of the voxels in metres; several are compared, the first is written")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  declare_scan_format(*verb, options->format);
  verb->add_flag("--table", options->table,
                 "Also perceive the rooms before and after, and print what widths change");
  return [options] { return run(*options); };
}

}  // namespace gramap
