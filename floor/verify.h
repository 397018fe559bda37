// Proof that a model is what it claims: gap-free, without overlap, watertight, every room reachable.
#pragma once

#include <string>
#include <vector>

#include "floor/model.h"

namespace gramap {

struct VerifyFault {
  /// "gap", "overlap", "open", "manifold", "orientation", "degenerate", "self-intersection", "opening",
  /// "door", "unreachable", "bounds", "name"
  std::string code;
  std::string message;  ///< one sentence naming the part
  Vec3 at = Vec3::Zero();
};

struct VerifyTotals {
  double outline_m2 = 0;
  double rooms_m2 = 0;
  double hallways_m2 = 0;
  double fixed_m2 = 0;
  double walls_m2 = 0;
  bool area_exact = false;  ///< rooms + hallways + fixed + walls = outline in exact arithmetic
  int rooms = 0;
  int hallways = 0;
  int fixed = 0;
  int walls = 0;
  int junctions = 0;
  int doors = 0;
  int windows = 0;
  int furniture = 0;
  /// Closed meshes checked, by what they are. A model in memory has room volumes and no parts yet; a file has
  /// parts, and volumes only when they were asked for.
  int slabs = 0;
  int wall_solids = 0;
  int room_volumes = 0;
  int opening_parts = 0;  ///< frames, leaves, handles, panes, sills
  int furniture_parts = 0;
  int triangles = 0;  ///< of all these
  int solids() const { return slabs + wall_solids + room_volumes + opening_parts + furniture_parts; }
};

struct VerifyReport {
  std::vector<VerifyFault> faults;    ///< the model must not be written
  std::vector<VerifyFault> warnings;  ///< true of the building, but worth a look: no door, unreachable
  VerifyTotals totals;
  bool ok() const { return faults.empty(); }
};

VerifyReport verify(const FloorModel& model);

/// The report as text for people, a fault a line, and as JSON.
std::string to_text(const VerifyReport& report);
std::string to_json(const VerifyReport& report);

}  // namespace gramap
