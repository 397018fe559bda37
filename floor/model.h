// The floor model: a fitted floor as an exact planar partition and closed solids, ready to be verified and
// exported. Plan coordinates are the floor file's; heights are metres above the floor's own finished level
// (z = 0), its elevation is added on export.
#pragma once

#include <string>
#include <vector>

#include "floor/fitted_floor.h"
#include "geometry/mesh.h"
#include "geometry/partition.h"
#include "geometry/polygon.h"

namespace gramap {

/// A room, hallway or fixed room with its faces. `fitted` is what the fit says of it.
struct ModelRoom {
  enum class Kind { room, hallway, fixed };
  Kind kind = Kind::room;
  std::string node;  ///< unique name of [A-Za-z0-9_-]
  FittedRoom fitted;
  double height_m = 0;
  Mesh floor;    ///< faces up, z = 0
  Mesh ceiling;  ///< faces down, z = height
  Mesh volume;   ///< closed
};

/// "room", "hallway" or "fixed", as files say it.
const char* kind_name(ModelRoom::Kind kind);

/// A wall between two rooms or a room and the outside, a junction of walls, or solid mass.
struct ModelWall {
  std::string node;
  std::string type;                ///< "inner", "outer", "junction", "mass"
  std::vector<std::string> sides;  ///< ids of the rooms on both sides, "outside"
  bool facade = false;             ///< part of it is seen from outside
  double thickness_m = 0;
  double length_m = 0;
  Mesh solid;
  std::vector<int> cells;  ///< into FloorModel::plan.cells
};

/// A door or window with the parts that fill it, each a closed solid.
struct ModelOpening {
  std::string node;
  std::string room;   ///< the id of the room whose observation or rule it comes from
  std::string other;  ///< the id of the room behind the wall, or "outside"
  int wall = -1;      ///< into FloorModel::walls
  FittedOpening fitted;
  /// The cut through the wall: a, b on the room's face, then the points opposite b and a. The opening's own
  /// frame has its origin at a, z = sill; x along the face to b, y into the wall.
  Polygon footprint;
  double width_m = 0;
  double thickness_m = 0;
};

struct ModelFurniture {
  std::string node;
  std::string room;
  FittedFurniture fitted;
  OrientedBox box;  ///< its own frame: x along the axis from the corner, y to the left
};

struct FloorModel {
  std::string name;
  double elevation_m = 0;
  double height_m = 0;  ///< of the walls
  double slab_thickness_m = 0.3;
  double finish_m = 0.02;        ///< the slab's top lies so much below the finished floor
  FittedFloor fitted;            ///< what it was built from
  std::vector<Polygon> outline;  ///< outer faces, counter-clockwise; courtyards clockwise
  Partition plan;
  std::vector<ModelRoom> rooms;  ///< hallways, fixed rooms, rooms
  std::vector<ModelWall> walls;
  std::vector<ModelOpening> openings;
  std::vector<ModelFurniture> furniture;
  Mesh slab;
  std::vector<SetAsideInput> set_aside;  ///< seen openings and furniture that had no place, and why
};

struct BuildOptions {
  double slab_thickness_m = 0.3;  ///< of the floor slab, below the finished floor
  double finish_m = 0.02;         ///< the slab's top lies so much below the finished floor
};

/// Builds the model. Throws InputError when the floor's own geometry cannot be built (a self-crossing
/// outline, a hallway that touches it, overlapping rooms), naming the parts and the place.
FloorModel build_model(const FittedFloor& fitted, const BuildOptions& options = {});

/// The part of build_model that can be told before a fit: throws InputError when hallways, fixed rooms and
/// `rooms` (named `room_kind` in messages) overlap, touch the outline or lie outside it.
void check_plan(const FittedFloor& given, const std::string& room_kind);

}  // namespace gramap
