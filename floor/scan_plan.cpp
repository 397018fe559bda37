#include "floor/scan_plan.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <utility>

namespace gramap {
namespace {

double entropy(double probability) {
  // Only the best type's probability is known: the least entropy that leaves.
  const double p = std::clamp(probability, 1e-12, 1 - 1e-12);
  return -p * std::log(p) - (1 - p) * std::log(1 - p);
}

double uncertainty(const Layout& layout, double target_m) {
  double sum = 0;
  for (std::size_t i = 0; i < layout.rooms.size(); ++i) {
    const PlacedRoom& room = layout.rooms[i];
    if (i + 1 < layout.rooms.size()) sum += std::pow(room.end_sigma_m / target_m, 2);
    sum += entropy(room.type_probability);
  }
  return sum;
}

/// The room of a layout that has the position within it, or the nearest one.
const PlacedRoom& room_at(const Layout& layout, double position) {
  const auto distance = [&](const PlacedRoom& room) {
    return std::max(room.start_m - position, position - room.start_m - room.width_m);
  };
  return *std::min_element(
      layout.rooms.begin(), layout.rooms.end(),
      [&](const PlacedRoom& a, const PlacedRoom& b) { return distance(a) < distance(b); });
}

Certainty certainty(const Layout& layout, double target_m) {
  Certainty now;
  now.uncertainty = uncertainty(layout, target_m);
  for (const PlacedRoom& room : layout.rooms)
    now.worst_sigma_m = std::max({now.worst_sigma_m, room.start_sigma_m, room.end_sigma_m});
  return now;
}

/// What a scan of the room would give.
RoomEvidence expected_scan(const PlacedRoom& room, const ScanPlanOptions& options) {
  RoomEvidence evidence;
  evidence.id = "expected scan";
  evidence.width_m = room.width_m;
  evidence.width_sigma_m = options.scan_sigma_m;
  evidence.centre_m = room.start_m + room.width_m / 2;
  evidence.centre_sigma_m = options.place_sigma_m;
  return evidence;
}

}  // namespace

Certainty certainty(const RuleSet& rules, const SpaceProblem& problem, const ScanPlanOptions& options) {
  return certainty(fit_space(rules, problem, options.fit).best, options.target_sigma_m);
}

ScanPlan plan_space(const RuleSet& rules, const SpaceProblem& problem, const ScanPlanOptions& options) {
  constexpr double kLeastShare = 0.01;  // of the likeliest layout's probability
  FitOptions fit_options = options.fit;
  fit_options.alternatives = std::max(0, options.layouts - 1);
  const SpaceFit fit = fit_space(rules, problem, fit_options);
  ScanPlan plan;
  plan.now = certainty(fit.best, options.target_sigma_m);
  std::vector<const Layout*> layouts{&fit.best};
  for (const Layout& layout : fit.alternatives)
    if (layout.probability > kLeastShare * fit.best.probability) layouts.push_back(&layout);

  FitOptions quick = options.fit;
  quick.grid_m = std::max(quick.grid_m, options.expectation_grid_m);
  for (std::size_t i = 0; i < fit.best.rooms.size(); ++i) {
    const PlacedRoom& room = fit.best.rooms[i];
    if (!room.evidence.empty()) continue;
    const double middle = room.start_m + room.width_m / 2;
    double expected = 0;
    double weights = 0;
    std::vector<std::pair<RoomEvidence, double>> tried;  // layouts often agree on the room
    for (const Layout* layout : layouts) {
      const RoomEvidence evidence = expected_scan(room_at(*layout, middle), options);
      const double weight = layouts.size() > 1 ? layout->probability : 1;
      const auto known = std::find_if(tried.begin(), tried.end(), [&](const auto& other) {
        return std::abs(other.first.width_m - evidence.width_m) < options.scan_sigma_m &&
               std::abs(*other.first.centre_m - *evidence.centre_m) < options.scan_sigma_m;
      });
      double after = 0;
      if (known != tried.end()) {
        after = known->second;
      } else {
        SpaceProblem scanned = problem;
        scanned.rooms.push_back(evidence);
        after = uncertainty(fit_space(rules, scanned, quick).best, options.target_sigma_m);
        tried.emplace_back(evidence, after);
      }
      expected += weight * after;
      weights += weight;
    }
    ScanAdvice advice;
    advice.space = problem.id;
    advice.room = static_cast<int>(i);
    advice.type = room.type;
    advice.start_m = room.start_m;
    advice.width_m = room.width_m;
    advice.wall_sigma_m = std::max(room.start_sigma_m, room.end_sigma_m);
    advice.gain = plan.now.uncertainty - expected / weights;
    plan.rooms.push_back(advice);
  }
  return plan;
}

ScanPlan joined(const std::vector<ScanPlan>& spaces, const ScanPlanOptions& options) {
  ScanPlan whole;
  for (const ScanPlan& plan : spaces) {
    whole.now.uncertainty += plan.now.uncertainty;
    whole.now.worst_sigma_m = std::max(whole.now.worst_sigma_m, plan.now.worst_sigma_m);
    whole.rooms.insert(whole.rooms.end(), plan.rooms.begin(), plan.rooms.end());
  }
  std::stable_sort(whole.rooms.begin(), whole.rooms.end(),
                   [](const ScanAdvice& a, const ScanAdvice& b) { return a.gain > b.gain; });
  whole.done = whole.now.worst_sigma_m <= options.target_sigma_m;
  return whole;
}

ScanPlan plan_scans(const RuleSet& rules, const std::vector<SpaceProblem>& problems,
                    const ScanPlanOptions& options) {
  std::vector<ScanPlan> plans(problems.size());
  std::vector<std::exception_ptr> faults(problems.size());
  tbb::parallel_for(std::size_t{0}, problems.size(), [&](std::size_t i) {
    try {
      plans[i] = plan_space(rules, problems[i], options);
    } catch (...) {
      faults[i] = std::current_exception();
    }
  });
  for (const std::exception_ptr& fault : faults)
    if (fault) std::rethrow_exception(fault);
  return joined(plans, options);
}

}  // namespace gramap
