// What is usual in the rooms of one type: where the door is, which windows, which furniture, how deep.
#pragma once

#include <vector>

#include "grammar/learn.h"

namespace gramap {

/// Fills in depth, door, windows and furniture of a type from its rooms. A habit that few rooms share is left
/// out: half of the rooms must have it.
void learn_habits(const std::vector<const KnownRoom*>& rooms, double resolution_m, LearnedType& type);

double median(std::vector<double> values);

}  // namespace gramap
