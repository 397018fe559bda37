#include "floor/fuse.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <map>
#include <tuple>

namespace gramap {
namespace {

bool agree(const RoomEvidence& a, const RoomEvidence& b) {
  const double sigma = std::hypot(a.width_sigma_m, b.width_sigma_m);
  if (a.centre_m && b.centre_m &&
      std::abs(*a.centre_m - *b.centre_m) > 3 * std::hypot(a.centre_sigma_m, b.centre_sigma_m))
    return false;
  return std::abs(a.width_m - b.width_m) <= std::max(0.02, 3 * sigma);
}

/// Inverse-variance mean of some quantity of the group: value and standard deviation.
template <typename Value, typename Sigma>
std::pair<double, double> mean(const std::vector<RoomEvidence>& group, Value value, Sigma sigma) {
  double weights = 0, sum = 0;
  for (const RoomEvidence& evidence : group) {
    const double weight = 1 / std::pow(std::max(1e-4, sigma(evidence)), 2);
    weights += weight, sum += weight * value(evidence);
  }
  return {sum / weights, std::sqrt(1 / weights)};
}

RoomEvidence fuse_group(const std::vector<RoomEvidence>& group) {
  RoomEvidence result = group.front();
  if (group.size() == 1) return result;
  std::tie(result.width_m, result.width_sigma_m) = mean(
      group, [](const RoomEvidence& e) { return e.width_m; },
      [](const RoomEvidence& e) { return e.width_sigma_m; });
  const auto all = [&](auto has) { return std::all_of(group.begin(), group.end(), has); };
  if (all([](const RoomEvidence& e) { return e.other_width_m.has_value(); })) {
    const auto [other, sigma] = mean(
        group, [](const RoomEvidence& e) { return *e.other_width_m; },
        [](const RoomEvidence& e) { return e.other_sigma_m; });
    result.other_width_m = other, result.other_sigma_m = sigma;
  } else {
    result.other_width_m.reset();
  }
  // Where a room lies is known no better for many scans that share one pin or one drift: the mean, but no
  // smaller sigma.
  if (all([](const RoomEvidence& e) { return e.centre_m.has_value(); })) {
    const auto [centre, unused] = mean(
        group, [](const RoomEvidence& e) { return *e.centre_m; },
        [](const RoomEvidence& e) { return e.centre_sigma_m; });
    static_cast<void>(unused);
    result.centre_m = centre;
    for (const RoomEvidence& evidence : group)
      result.centre_sigma_m = std::min(result.centre_sigma_m, evidence.centre_sigma_m);
  }
  return result;
}

}  // namespace

std::vector<RoomEvidence> fused(const std::vector<RoomEvidence>& evidence,
                                std::vector<SetAsideInput>& set_aside) {
  std::map<std::string, std::vector<RoomEvidence>> rooms;
  std::vector<std::string> order;
  for (const RoomEvidence& one : evidence) {
    if (!rooms.count(one.id)) order.push_back(one.id);
    rooms[one.id].push_back(one);
  }
  std::vector<RoomEvidence> result;
  for (const std::string& id : order) {
    const std::vector<RoomEvidence>& all = rooms[id];
    std::vector<RoomEvidence> best;
    for (const RoomEvidence& middle : all) {
      std::vector<RoomEvidence> group;
      std::copy_if(all.begin(), all.end(), std::back_inserter(group),
                   [&](const RoomEvidence& e) { return agree(middle, e); });
      if (group.size() > best.size()) best = group;
    }
    if (all.size() == 2 && best.size() == 1) {
      result.insert(result.end(), all.begin(), all.end());
      continue;
    }
    result.push_back(fuse_group(best));
    for (const RoomEvidence& one : all) {
      if (std::any_of(best.begin(), best.end(),
                      [&](const RoomEvidence& e) { return e.width_m == one.width_m; }))
        continue;
      char text[160];
      std::snprintf(
          text, sizeof text,
          "one of its %zu scans says a width of %.2f m where %zu agree on %.2f m; that scan was not used",
          all.size(), one.width_m, best.size(), result.back().width_m);
      set_aside.push_back({id, text});
    }
  }
  return result;
}

}  // namespace gramap
