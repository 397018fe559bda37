// Reference line segments (RLS) and the room widths observed along them, as the Stuttgart grammar tool
// exchanges them: two CSV files.
//
//   rls.csv    index,startX,startY,endX,endY
//   rules.csv  index,rlsStartX,rlsStartY,rlsEndX,rlsEndY,Reversed,rules,
//
// `rules` is lengths in metres, each ended by ';': first the distance from the segment's start to the first
// wall line, then the gaps between successive wall lines. With `Reversed` "Yes" the list counts from the
// segment's end. Real files hold traps, all of them met here: either file may lack its header; rows end in a
// comma; the first distance has lost its sign (a wall *before* the start is written like one behind it),
// which is recovered where a collinear neighbour ends in the same wall; and the lengths need not add up to
// the segment.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "floor/fitted_floor.h"
#include "geometry/types.h"

namespace gramap {

struct RlsSegment {
  int index = 0;  ///< its number in the files
  Vec2 start = Vec2::Zero();
  Vec2 end = Vec2::Zero();
  bool reversed = false;
  /// As they stand in the file: the unsigned distance to the first wall line, then gaps. Empty: nothing
  /// observed.
  std::vector<double> lengths_m;
  /// The wall lines along the segment, from its start (also when `reversed`), increasing. The first sign is
  /// recovered; walls may lie before the start or behind the end.
  std::vector<double> walls_m;
  /// Collinear neighbours: positions in the list of segments, -1 for none. `previous` ends where this one
  /// starts.
  int previous = -1;
  int next = -1;
  bool shares_first_wall = false;  ///< walls_m.front() is the last wall of `previous` too (to 1 cm)
  bool shares_last_wall = false;   ///< walls_m.back() is the first wall of `next` too

  double length_m() const { return (end - start).norm(); }
};

/// Reads both files; segments in the order of `rls`. A segment without a row in `rules` has nothing observed.
/// Throws InputError with line and column.
std::vector<RlsSegment> read_rls(const std::filesystem::path& rls, const std::filesystem::path& rules);

/// The two files as text, from any fit: a segment for each space, wall lines in the middle of the inner walls
/// and at the space's two ends. Six decimals.
struct RlsCsv {
  std::string rls;
  std::string rules;
};
RlsCsv to_rls_csv(const FittedFloor& floor);

/// The same from segments, as they were read.
RlsCsv to_rls_csv(const std::vector<RlsSegment>& segments);

}  // namespace gramap
