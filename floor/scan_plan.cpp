#include "floor/scan_plan.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <exception>

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

void plan_space(const RuleSet& rules, const SpaceProblem& problem, const ScanPlanOptions& options,
                ScanPlan& plan) {
  FitOptions fit_options = options.fit;
  fit_options.alternatives = std::max(0, options.layouts - 1);
  const SpaceFit fit = fit_space(rules, problem, fit_options);
  plan.uncertainty = uncertainty(fit.best, options.target_sigma_m);
  std::vector<const Layout*> layouts{&fit.best};
  for (const Layout& layout : fit.alternatives) layouts.push_back(&layout);

  for (std::size_t i = 0; i < fit.best.rooms.size(); ++i) {
    const PlacedRoom& room = fit.best.rooms[i];
    plan.worst_sigma_m = std::max({plan.worst_sigma_m, room.start_sigma_m, room.end_sigma_m});
    if (!room.evidence.empty()) continue;
    const double middle = room.start_m + room.width_m / 2;
    double expected = 0, weights = 0;
    for (const Layout* layout : layouts) {
      const PlacedRoom& there = room_at(*layout, middle);
      SpaceProblem scanned = problem;
      RoomEvidence evidence;
      evidence.id = "expected scan";
      evidence.width_m = there.width_m;
      evidence.width_sigma_m = options.scan_sigma_m;
      evidence.centre_m = there.start_m + there.width_m / 2;
      evidence.centre_sigma_m = options.place_sigma_m;
      scanned.rooms.push_back(evidence);
      const double weight = layout->probability > 0 ? layout->probability : (layout == &fit.best ? 1.0 : 0.0);
      if (weight <= 0) continue;
      expected += weight * uncertainty(fit_space(rules, scanned, options.fit).best, options.target_sigma_m);
      weights += weight;
    }
    ScanAdvice advice;
    advice.space = problem.id;
    advice.room = static_cast<int>(i);
    advice.type = room.type;
    advice.start_m = room.start_m;
    advice.width_m = room.width_m;
    advice.wall_sigma_m = std::max(room.start_sigma_m, room.end_sigma_m);
    advice.gain = plan.uncertainty - expected / weights;
    plan.rooms.push_back(advice);
  }
}

}  // namespace

ScanPlan plan_scans(const RuleSet& rules, const std::vector<SpaceProblem>& problems,
                    const ScanPlanOptions& options) {
  std::vector<ScanPlan> plans(problems.size());
  std::vector<std::exception_ptr> faults(problems.size());
  tbb::parallel_for(std::size_t{0}, problems.size(), [&](std::size_t i) {
    try {
      plan_space(rules, problems[i], options, plans[i]);
    } catch (...) {
      faults[i] = std::current_exception();
    }
  });
  for (const std::exception_ptr& fault : faults)
    if (fault) std::rethrow_exception(fault);

  ScanPlan whole;
  for (const ScanPlan& plan : plans) {
    whole.uncertainty += plan.uncertainty;
    whole.worst_sigma_m = std::max(whole.worst_sigma_m, plan.worst_sigma_m);
    whole.rooms.insert(whole.rooms.end(), plan.rooms.begin(), plan.rooms.end());
  }
  std::stable_sort(whole.rooms.begin(), whole.rooms.end(),
                   [](const ScanAdvice& a, const ScanAdvice& b) { return a.gain > b.gain; });
  whole.done = whole.worst_sigma_m <= options.target_sigma_m;
  return whole;
}

}  // namespace gramap
