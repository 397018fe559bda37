// How often things were found and missed, as tables.
#pragma once

#include <string>

#include "perception/training.h"

namespace gramap {

/// A row for each kind: recall and precision with their confidence intervals; with `mistakes` each one of
/// them below.
std::string score_table(const std::string& what, const Scores& scores, bool mistakes);

/// The share of the true things that there is a candidate for: no forest finds more.
std::string reach_table(const std::string& what, const Scores& reach, bool mistakes);

}  // namespace gramap
