// Evaluation of a rule's condition.
#pragma once

#include <string>

#include "grammar/rules.h"

namespace gramap {

/// What conditions may ask about a space.
struct SpaceAttributes {
  double depth_m = 0;
  std::string hallway;
  bool facade = true;
  double left_m = 0;  ///< how far a branch of a hallway could go
  double right_m = 0;
};

/// Whether the condition holds where `remaining_m` of clear length are left. Numbers are true when they are
/// not zero; texts compare by == and != only (other comparisons of texts, or of a text with a number, are
/// false).
bool holds(const Condition& condition, const SpaceAttributes& space, double remaining_m);

/// Whether the remaining length matters to the condition.
bool depends_on_length(const Condition& condition);

}  // namespace gramap
