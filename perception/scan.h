// A room's scans: points as each scan measured them, and the pose of each scanner.
//
// Frames: `scanner` is the scanner's own, right-handed, Z up, metres. `room` is the frame that the poses are
// in: the building's or the room's own. On disk, poses are 3DTK's: centimetres and degrees in a left-handed
// frame.
#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/types.h"

namespace gramap {

using Point = Eigen::Vector3f;

struct Scan {
  std::filesystem::path file;
  Eigen::Isometry3d room_from_scanner = Eigen::Isometry3d::Identity();
  std::vector<Point> points_m;  ///< in the scanner's frame
};

struct RoomScans {
  std::string room;  ///< the folder's name
  std::vector<Scan> scans;
  std::vector<std::string> remarks;  ///< what a user should know: a file that was not read, …
};

struct ReadOptions {
  double unit_m =
      0;  ///< length of one unit of the points, metres; 0: a metre, and clouds in other units are refused
  char up = 'z';  ///< the points' axis that points up: 'z' or 'y'
};

/// Reads every scan of a room's folder, in the order of the file names; a folder of one file may be that file
/// instead. A scan that is there in several formats (scan000.xyz and scan000.gpc share scan000.pose) is read
/// once, compressed only when there is nothing else. Throws InputError for a folder without scans and for
/// every fault of a file, with its place.
RoomScans read_room_scans(const std::filesystem::path& folder, const ReadOptions& options = {});

/// The pose of 3DTK's six numbers as text. `name` is used in messages.
Eigen::Isometry3d pose_from_text(std::string_view text, const std::filesystem::path& name);

/// The six numbers as text: what pose_from_text reads.
std::string pose_to_text(const Eigen::Isometry3d& room_from_scanner);

/// All scans of a room in one frame. Points are relative to `origin_m`, so that single precision keeps a
/// hundredth of a millimetre however large the building's coordinates are.
struct RegisteredCloud {
  struct Part {
    Vec3 scanner_m = Vec3::Zero();   ///< the scanner's position, relative to origin_m
    std::size_t begin = 0, end = 0;  ///< its points
  };
  Vec3 origin_m = Vec3::Zero();  ///< in the room's frame
  std::vector<Point> points_m;
  std::vector<Part> parts;  ///< one per scan
  std::vector<std::string> remarks;
};
RegisteredCloud registered(const RoomScans& scans);

}  // namespace gramap
