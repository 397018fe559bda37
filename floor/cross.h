// The honest test of learned rules: learn on all floors but one, then fit that one with only a share of its
// rooms scanned, and compare with its truth.
//
// Scans are simulated as widths: the true width with a relative error, and a position as a pin or a pose
// would give it. Three methods are compared: learned rules; the same rules with all probabilities made alike;
// and no rules at all, the stretches between scanned rooms divided into equal rooms of about the scanned
// rooms' width. All three are told the same: the space's length, the scanned rooms' widths and places; none
// knows how many rooms there are.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "grammar/learn.h"
#include "grammar/rules.h"

namespace gramap {

struct CrossOptions {
  std::vector<double> shares = {1.0, 0.5, 0.25, 0.1};  ///< of the floor's rooms that are scanned
  int draws = 5;                                       ///< random choices of rooms (and errors) per share
  std::uint64_t seed = 1;
  double width_error = 0.03;   ///< standard deviation of a scanned width, relative
  double place_sigma_m = 0.3;  ///< standard deviation of a scanned room's position
  double grid_m = 0.05;        ///< step of the fit's positions: plans drawn to 0.2 m need no centimetres
  /// Likeness::deviation, instead of what the scans of a draw show.
  std::optional<double> likeness;
  bool least_error = true;  ///< FitOptions::least_error: the score is the error of widths; else the mode
  bool doors = false;       ///< hallways are scanned too: every door of the plan is seen, to 5 cm
};

enum class CrossMethod { learned, uniform, equal_division };
const char* to_string(CrossMethod method);

struct CrossScore {
  CrossMethod method = CrossMethod::learned;
  double share = 0;
  double present = 0;            ///< share of true rooms that are there, in order, overlapping by half
  double spaces_right = 0;       ///< share of spaces with the right number of rooms
  double unscanned_error_m = 0;  ///< mean absolute width error of the rooms that were not scanned
  double unscanned_error_deviation_m = 0;  ///< standard deviation of that mean, from the draws
  double unscanned_within_10cm = 0;
  /// ln p(their widths and places, to 5 cm | rules, scans), per room; not for equal division, which is sure
  /// of what it says.
  double unscanned_nats = 0;
  int unscanned = 0;  ///< how many went into that
  int failed = 0;     ///< spaces that the rules could not fill
};

struct HeldOutLikelihood {
  std::string floor;
  std::string rules;
  double nats_per_room = 0;
};

/// Turns learned rules into a rule set (the text is parsed again, as a user would).
using RuleMaker = std::function<RuleSet(const LearnedRules&)>;

/// Called after each space of each draw, from one thread at a time, and with the scores of a share when it is
/// done.
struct CrossListener {
  std::function<void(const std::string& what, std::size_t total)> step;
  std::function<void(const CrossScore&)> score;
};

/// Scores averaged over floors, spaces and draws; learned from `data` less the floor itself. Rows belong to a
/// floor by KnownRow::floor. The same seed gives the same numbers.
std::vector<CrossScore> cross_validate(const LearnData& data, const LearnOptions& learning,
                                       const RuleMaker& make, const CrossOptions& options,
                                       const CrossListener& listener = {});

/// ln p(all rooms of a floor | rules) per room, widths and positions known to 5 cm, for rules learned on the
/// other floors, the same made uniform, and the `others` by name.
std::vector<HeldOutLikelihood> held_out_likelihoods(
    const LearnData& data, const LearnOptions& learning, const RuleMaker& make,
    const std::vector<std::pair<std::string, RuleSet>>& others, double grid_m = 0.01);

}  // namespace gramap
