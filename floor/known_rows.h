// Rows of rooms to learn from, out of floors whose truth is known.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "floor/ground_truth.h"
#include "grammar/learn.h"

namespace gramap {

/// The rooms of each space in their order along its reference line; positions of the walls between them such
/// that clear widths and inner walls fill the space exactly. A space whose truth has a hole gives the parts
/// (not `whole`); rooms behind others are left out. A floor without spaces has its rows found along its
/// hallways (or along rooms of type Hallway). `inner_wall_m`: thickness between neighbours.
std::vector<KnownRow> known_rows(const FloorGroundTruth& floor, const FloorTruth& truth, double inner_wall_m);

/// What is left of a row without the rooms that nobody saw, by id: its stretches of rooms that were seen.
std::vector<KnownRow> seen_parts(const KnownRow& row, const std::set<std::string>& unseen,
                                 double inner_wall_m);

/// All floors together, with the walls and heights that they agree on: the medians. `unseen`, by floor where
/// given: rooms that rules made up, from which nothing is to be learned.
LearnData learn_data(const std::vector<FloorGroundTruth>& floors, const std::vector<FloorTruth>& truths,
                     const std::vector<std::set<std::string>>& unseen = {});

}  // namespace gramap
