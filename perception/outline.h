// The room's outline: which cells between the wall lines are the room, and the ring around them.
//
// Each cell between the lines is room or not. It should be room if the scanners saw into it, and its border
// should run along walls that were measured; both wishes are summed up and the best labelling is a minimum
// cut (as in Mura et al., Automatic room detection and reconstruction in cluttered indoor environments,
// Computers & Graphics 44, 2014).
#pragma once

#include <string>
#include <vector>

#include "perception/free_space.h"

namespace gramap {

struct OutlineOptions {
  double border_cost_m =
      0.4;  ///< what a metre of border without a wall costs, in m² of cells wrongly labelled
  double min_edge_m = 0.08;  ///< shorter edges are noise of the lines that cross there
};

struct RoomOutline {
  std::vector<int> lines;  ///< of the edges in counter-clockwise order, into the wall lines
  Polygon ring;            ///< corner i is where edge i begins
  std::vector<std::string> remarks;
};

/// The outline around the scanners. Empty when walls do not enclose them.
RoomOutline room_outline(const std::vector<WallLine>& lines, const FreeSpace& space,
                         const RegisteredCloud& cloud, const OutlineOptions& options);

/// Takes out edges that only come from lines crossing at small angles or close to one another: a short piece
/// nearly in line with its neighbour goes, of two nearly parallel lines around a short edge the stronger
/// stays; otherwise the edge's neighbours meet in one corner.
void tidy(RoomOutline& outline, const std::vector<WallLine>& lines, double min_edge_m);

/// Where two lines cross.
Vec2 crossing_of(const WallLine& a, const WallLine& b);

}  // namespace gramap
