// Spaces found from a plan of rooms and hallways, at any angle: rooms that lie side by side along a hallway's
// border make a row, and a row is a space with its reference line. For plans that were drawn without spaces
// (OpenStreetMap indoor tagging, IMDF, a truth file alone).
#pragma once

#include <vector>

#include "floor/ground_truth.h"

namespace gramap {

struct FindSpacesOptions {
  double reach_m = 0.6;        ///< most distance between a room's edge and the hallway's border: a thick wall
  double overlap_m = 0.5;      ///< least length of border that a room shares with its hallway
  double step_m = 0.6;         ///< most offset across the hallway between neighbours of a row
  double parallel_rad = 0.08;  ///< most angle between a room's edge and the hallway's border (4.6°)
  double interior_gap_m = 0.6;  ///< most gap between neighbours of a row: a thick wall
  double interior_lap_m = 0.4;  ///< most overlap between neighbours: how badly a plan may be drawn
};

/// A room's contact with its hallway: `edge` runs along the room's border with the room on its left, over all
/// of the room's border on that line.
struct HallwayContact {
  int room = 0;     ///< index into the rooms
  int hallway = 0;  ///< index into the hallways
  Vec2 start = Vec2::Zero();
  Vec2 end = Vec2::Zero();
  double depth_m = 0;  ///< extent of the room across the line
};

/// The contact of every room that has one: where it has a door (`doors`: their centres), else along the
/// longest common border.
std::vector<HallwayContact> hallway_contacts(const std::vector<Hallway>& hallways,
                                             const std::vector<TrueRoom>& rooms,
                                             const std::vector<Vec2>& doors,
                                             const FindSpacesOptions& options = {});

/// The rows that the contacts make, each in the order along its reference line; every contact is in one row.
std::vector<std::vector<HallwayContact>> contact_rows(const std::vector<HallwayContact>& contacts,
                                                      const FindSpacesOptions& options = {});

/// The space of a row: as long as the row; before and behind it goes as far as each of its rooms does, so
/// that its outline has a step where neighbours differ. It keeps `wall_m` away from the `others` (hallways,
/// fixed rooms, rooms of other rows), however badly the plan was drawn.
Space space_of_row(const std::vector<HallwayContact>& row, const std::string& id, const std::string& hallway,
                   const std::vector<Polygon>& others, double wall_m);

}  // namespace gramap
