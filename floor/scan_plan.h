// Where to scan next: the rooms nobody scanned, ranked by how much a scan of each is expected to shrink the
// floor's uncertainty.
#pragma once

#include <string>
#include <vector>

#include "grammar/rules.h"
#include "grammar/space.h"

namespace gramap {

struct ScanPlanOptions {
  double target_sigma_m = 0.05;  ///< done when every wall is known this well (1 sigma)
  double scan_sigma_m = 0.01;    ///< what a scan will tell of a room's width
  double place_sigma_m = 0.25;   ///< and of where along the line it lies
  int layouts = 4;  ///< how many of a space's most probable layouts the expectation is taken over
  double expectation_grid_m = 0.02;  ///< grid of the fits that only serve the expectation
  FitOptions fit;
};

/// A room worth scanning. Uncertainty is the sum over walls of (sigma / target)² plus the sum over rooms of
/// the entropy of their type in nats.
struct ScanAdvice {
  std::string space;
  int room = 0;  ///< its number in the space's best layout, from 0
  std::string type;
  double start_m = 0;
  double width_m = 0;
  double wall_sigma_m = 0;  ///< of its less certain wall
  double gain = 0;          ///< expected drop of the uncertainty
};

/// What is known of the walls, of one space or of a floor.
struct Certainty {
  double uncertainty = 0;
  double worst_sigma_m = 0;  ///< of the least certain wall
};

struct ScanPlan {
  std::vector<ScanAdvice> rooms;  ///< best first; rooms that were scanned are not among them
  Certainty now;                  ///< of the floor (or space) as it is
  bool done = false;              ///< every wall is within the target
};

/// What the evidence so far tells of a space's walls.
Certainty certainty(const RuleSet& rules, const SpaceProblem& problem, const ScanPlanOptions& options = {});

/// The plan of one space by itself.
ScanPlan plan_space(const RuleSet& rules, const SpaceProblem& problem, const ScanPlanOptions& options = {});

/// The plan of a floor from those of its spaces.
ScanPlan joined(const std::vector<ScanPlan>& spaces, const ScanPlanOptions& options = {});

/// Plans the next scan from the evidence so far. The expectation of a scan is taken over the most probable
/// layouts of its space, each with the probability that the fit gives it: the scan would show the room that
/// this layout has at that place.
ScanPlan plan_scans(const RuleSet& rules, const std::vector<SpaceProblem>& problems,
                    const ScanPlanOptions& options = {});

}  // namespace gramap
