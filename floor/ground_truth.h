// What a user knows of a floor beforehand: `floor.geojson`. Plan coordinates are local metres.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "floor/projection.h"
#include "geometry/types.h"

namespace gramap {

struct Hallway {
  std::string id;
  std::string name;
  Polygon outline;
};

/// A known room that no rule splits: stairs, lifts.
struct FixedRoom {
  std::string id;
  std::string type;
  std::string name;
  Polygon outline;
};

/// The clear area beside a hallway that rules split. Its reference line runs from `start` to `end` with the
/// space on its left.
struct Space {
  std::string id;
  std::string hallway;
  Polygon outline;
  Vec2 start = Vec2::Zero();
  Vec2 end = Vec2::Zero();
};

/// "This room was scanned about here."
struct Pin {
  std::string room;
  Vec2 at = Vec2::Zero();
  double sigma_m = 0;
};

/// Rooms, openings and furniture as they really are; for learning and evaluation, never for a fit.
struct TrueRoom {
  std::string id;
  std::string type;
  std::string name;
  Polygon outline;
  double floor_m = 0;
  double ceiling_m = 0;
};
struct TrueOpening {
  std::string kind;  ///< "door" or "window"
  std::string room;
  Vec2 a = Vec2::Zero();
  Vec2 b = Vec2::Zero();
  double width_m = 0;
  double sill_m = 0;
  double head_m = 0;
};
struct TrueFurniture {
  std::string room;
  std::string type;
  Polygon outline;
  double bottom_m = 0;
  double top_m = 0;
};
struct FloorTruth {
  std::vector<TrueRoom> rooms;
  std::vector<TrueOpening> openings;
  std::vector<TrueFurniture> furniture;
};

/// Something of the input that was not used, and why.
struct SetAsideInput {
  std::string what;
  std::string reason;
};

struct FloorGroundTruth {
  std::string name;
  double elevation_m = 0;
  std::optional<double> ceiling_height_m;
  std::optional<double> inner_wall_m;
  std::optional<double> outer_wall_m;
  Polygon outline;                  ///< outer face of the outer walls; empty when the file has none
  std::vector<Polygon> courtyards;  ///< holes of the outline: the outer faces of the walls around them
  std::vector<Hallway> hallways;
  std::vector<FixedRoom> fixed;
  std::vector<Space> spaces;
  std::vector<Pin> pins;
  std::optional<GeoOrigin> origin;       ///< where plan (0, 0) is, when the file was WGS84 or says so
  std::vector<std::string> remarks;      ///< what the reader put right, for people: one sentence each
  std::vector<SetAsideInput> set_aside;  ///< features of somebody's plan that could not be used
};

/// Reads a floor file, or `floor.geojson` in a floor folder; the truth kinds are skipped. Rings are made
/// counter-clockwise, reference lines turned so that their space is on the left (with a remark), missing
/// reference lines and missing hallways of spaces found. Throws InputError.
FloorGroundTruth read_floor(const std::filesystem::path& path);

/// Reads the truth kinds of a file, or of `truth.geojson` in a floor folder. A WGS84 file is projected about
/// `about` so that it lies on its floor; in a folder that is the origin of its `floor.geojson`.
FloorTruth read_truth(const std::filesystem::path& path,
                      const std::optional<GeoOrigin>& about = std::nullopt);

/// The floor and what is truly there as GeoJSON in local metres, rounded to a micrometre, one feature a line;
/// either may be empty. What this writes, `read_floor` and `read_truth` read.
std::string to_geojson(const FloorGroundTruth& floor, const FloorTruth& truth);

}  // namespace gramap
