#include "grammar/learn_width.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>

namespace gramap {
namespace {

/// Negative log density of n values at their own mean with spread sd, given their mean squared deviation.
double normal_cost(double n, double variance, double sd) {
  return n * (std::log(sd) + 0.5 * std::log(2 * std::numbers::pi) + variance / (2 * sd * sd));
}

struct Sums {
  std::vector<double> first, second;  // prefix sums of values and squares
  explicit Sums(const std::vector<double>& values) : first(values.size() + 1), second(values.size() + 1) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      first[i + 1] = first[i] + values[i];
      second[i + 1] = second[i] + values[i] * values[i];
    }
  }
  double mean(std::size_t a, std::size_t b) const {
    return (first[b] - first[a]) / static_cast<double>(b - a);
  }
  double variance(std::size_t a, std::size_t b) const {
    const double m = mean(a, b);
    return std::max(0.0, (second[b] - second[a]) / static_cast<double>(b - a) - m * m);
  }
};

double penalty(std::size_t groups, std::size_t values) {
  return 0.5 * (3.0 * static_cast<double>(groups) - 1) * std::log(static_cast<double>(values));
}

/// Where groups may begin and end among n sorted values: anywhere or, so that many values cost no more than
/// their sorting, where the gaps are widest. Ascending, with 0 and n.
std::vector<std::size_t> cuts_of(const std::vector<double>& sorted) {
  constexpr std::size_t most = 1000;
  const std::size_t n = sorted.size();
  std::vector<std::size_t> cuts(n + 1);
  std::iota(cuts.begin(), cuts.end(), std::size_t{0});
  if (n <= most) return cuts;
  const auto gap = [&](std::size_t i) { return sorted[i] - sorted[i - 1]; };
  const auto inner = cuts.begin() + 1, end = cuts.begin() + static_cast<std::ptrdiff_t>(most);
  std::nth_element(inner, end, cuts.end() - 1,
                   [&](std::size_t i, std::size_t j) { return gap(i) != gap(j) ? gap(i) > gap(j) : i < j; });
  *end = n;
  cuts.resize(most + 1);
  std::sort(cuts.begin(), cuts.end());
  return cuts;
}

/// Between `fewest` and `most_groups` groups, as many as make the code shortest.
std::vector<LengthGroup> best_groups(const std::vector<double>& values_m, double resolution_m, int fewest,
                                     int most_groups, int least_members) {
  const std::size_t n = values_m.size();
  if (n == 0) return {};
  std::vector<int> order(n);
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    return values_m[static_cast<std::size_t>(a)] < values_m[static_cast<std::size_t>(b)];
  });
  std::vector<double> sorted;
  for (const int i : order) sorted.push_back(values_m[static_cast<std::size_t>(i)]);
  // About the mean, so that the sums of squares keep their digits.
  const double shift = std::accumulate(sorted.begin(), sorted.end(), 0.0) / static_cast<double>(n);
  std::vector<double> centred = sorted;
  for (double& value : centred) value -= shift;
  const Sums sums(centred);
  const double total = static_cast<double>(n);
  std::vector<double> log_share(n + 1);
  for (std::size_t members = 1; members <= n; ++members)
    log_share[members] = std::log(static_cast<double>(members) / total);
  const auto cost = [&](std::size_t a, std::size_t b) {
    const double members = static_cast<double>(b - a), variance = sums.variance(a, b);
    const double sd = std::max(std::sqrt(variance), resolution_m);
    return normal_cost(members, variance, sd) - members * log_share[b - a];
  };

  const std::size_t most = std::min(n, static_cast<std::size_t>(most_groups));
  const std::size_t least = std::min(n, static_cast<std::size_t>(least_members));
  const double never = std::numeric_limits<double>::infinity();
  // best[k][j]: the shortest code of the values before cut j in k groups, the last of which begins at cut
  // from[k][j].
  const std::vector<std::size_t> cuts = cuts_of(sorted);
  const std::size_t last = cuts.size() - 1;
  std::vector<std::vector<double>> best(most + 1, std::vector<double>(last + 1, never));
  std::vector<std::vector<std::size_t>> from(most + 1, std::vector<std::size_t>(last + 1, 0));
  best[0][0] = 0;
  for (std::size_t j = 1; j <= last; ++j) {
    for (std::size_t i = 0; i < j && cuts[i] + least <= cuts[j]; ++i) {
      const double group = cost(cuts[i], cuts[j]);
      for (std::size_t k = 1; k <= most; ++k) {
        if (best[k - 1][i] + group >= best[k][j]) continue;
        best[k][j] = best[k - 1][i] + group;
        from[k][j] = i;
      }
    }
  }
  std::size_t chosen = most;
  double shortest = never;
  for (std::size_t k = static_cast<std::size_t>(std::max(1, fewest)); k <= most; ++k) {
    const double length = best[k][last] + penalty(k, n);
    if (length >= shortest - 1e-9) continue;
    shortest = length;
    chosen = k;
  }
  std::vector<LengthGroup> groups(chosen);
  for (std::size_t k = chosen, j = last; k > 0; --k) {
    const std::size_t a = cuts[from[k][j]], b = cuts[j];
    LengthGroup& group = groups[k - 1];
    group.mean_m = sums.mean(a, b) + shift;
    group.sd_m = std::max(std::sqrt(sums.variance(a, b)), resolution_m);
    group.members.assign(order.begin() + static_cast<std::ptrdiff_t>(a),
                         order.begin() + static_cast<std::ptrdiff_t>(b));
    j = from[k][j];
  }
  return groups;
}

}  // namespace

std::vector<LengthGroup> group_lengths(const std::vector<double>& values_m, double resolution_m,
                                       int most_groups, int least_members) {
  return best_groups(values_m, resolution_m, 1, most_groups, least_members);
}

std::vector<LengthGroup> group_lengths_into(const std::vector<double>& values_m, double resolution_m,
                                            int groups) {
  const int count = std::min(groups, static_cast<int>(values_m.size()));
  return best_groups(values_m, resolution_m, count, count, 1);
}

double length_within_groups(const std::vector<double>& values_m, const std::vector<LengthGroup>& groups,
                            double resolution_m) {
  double length = 0;
  for (const LengthGroup& group : groups) {
    const double members = static_cast<double>(group.members.size());
    double squares = 0;
    for (const int i : group.members)
      squares += std::pow(values_m[static_cast<std::size_t>(i)] - group.mean_m, 2);
    length += normal_cost(members, squares / members, std::max(std::sqrt(squares / members), resolution_m));
  }
  return length;
}

double code_length(const std::vector<double>& values_m, const std::vector<LengthGroup>& groups,
                   double resolution_m) {
  const double total = static_cast<double>(values_m.size());
  double length =
      penalty(groups.size(), values_m.size()) + length_within_groups(values_m, groups, resolution_m);
  for (const LengthGroup& group : groups) {
    const double members = static_cast<double>(group.members.size());
    length -= members * std::log(members / total);
  }
  return length;
}

namespace {

struct Explained {
  double length = 0;  ///< nats
  double sd = 0;
  double refined = 0;    ///< least-squares period
  double multiples = 0;  ///< root of the sum of squared multiples of what fits
};

/// The pitches as multiples of `period`, with normal residuals, first of `sd`, and stragglers.
Explained explain(const std::vector<double>& pitches, double period, double sd, double resolution_m) {
  const double n = static_cast<double>(pitches.size());
  double share = 1 / (n + 1);  // of stragglers
  Explained result;
  for (int round = 0; round < 4; ++round) {
    const double straggler = std::log(12.0) - std::log(share);  // a width of its own, and that it is one
    std::map<int, double> counts;
    double squares = 0, fitting = 0, kp = 0, kk = 0, stragglers = 0;
    for (const double pitch : pitches) {
      const int k = std::max(1, static_cast<int>(std::lround(pitch / period)));
      const double residual = pitch - k * period;
      if (normal_cost(1, residual * residual, sd) > straggler) {
        stragglers += 1;
        continue;
      }
      counts[k] += 1;
      squares += residual * residual;
      fitting += 1;
      kp += k * pitch;
      kk += static_cast<double>(k) * k;
    }
    result.length = std::numeric_limits<double>::infinity();
    if (fitting < 2 || fitting < 0.6 * n) return result;
    sd = std::max(resolution_m, std::sqrt(squares / fitting));
    share = (stragglers + 1) / (n + 1);
    result.sd = sd;
    result.refined = kp / kk;
    result.multiples = std::sqrt(kk);
    double length = normal_cost(fitting, squares / fitting, sd) + stragglers * straggler;
    for (const auto& [k, count] : counts) length += -count * std::log(count / n) + std::log(k + 1.0);
    length += 0.5 * (static_cast<double>(counts.size()) + 1) * std::log(n);  // shares, period and spread
    result.length = length;
  }
  return result;
}

}  // namespace

std::optional<StructuralAxis> find_axis(const std::vector<double>& pitches_m, double resolution_m) {
  if (pitches_m.size() < 4) return std::nullopt;
  const double longest = *std::max_element(pitches_m.begin(), pitches_m.end());
  std::optional<StructuralAxis> best;
  const int most_cm = static_cast<int>(100 * std::min(longest + 0.5, 12.0));
  for (int period_cm = 100; period_cm <= most_cm; ++period_cm) {
    const double period = 0.01 * period_cm;
    // Rooms that an outer wall cuts, or that take what is left, hide a sharp axis from a wide first look.
    for (const double sd : {std::max(resolution_m, 0.02 * period), resolution_m}) {
      const Explained first = explain(pitches_m, period, sd, resolution_m);
      if (!std::isfinite(first.length)) continue;
      const Explained refined = explain(pitches_m, first.refined, first.sd, resolution_m);
      if (!std::isfinite(refined.length)) continue;
      // Longer ones later: of equally good ones the longest is kept.
      if (best && refined.length > best->code_length + 1e-6) continue;
      best = StructuralAxis{first.refined, refined.sd, refined.sd / refined.multiples, refined.length};
    }
  }
  if (!best) return std::nullopt;
  const double free = code_length(pitches_m, group_lengths(pitches_m, resolution_m), resolution_m);
  // A period that leaves residuals as wide as itself says nothing.
  if (best->code_length > free || best->residual_sd_m > 0.2 * best->period_m) return std::nullopt;
  return best;
}

}  // namespace gramap
