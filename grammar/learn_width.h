// Lengths in groups, and the structural axis that orders them.
#pragma once

#include <optional>
#include <vector>

namespace gramap {

/// A group of lengths that are taken for one normal distribution.
struct LengthGroup {
  double mean_m = 0;
  double sd_m = 0;
  std::vector<int> members;  ///< indices of the values, ascending by value
};

/// The best grouping of the values: contiguous groups that maximise the classification likelihood of a
/// mixture of normals, the number of groups chosen by the Bayesian information criterion (three parameters a
/// group). Exact, by dynamic programming (Fisher, "On grouping for maximum homogeneity", 1958). No group's
/// spread is taken to be below `resolution_m`, no group has fewer than `least_members` (unless there are
/// fewer values in all). Groups come in ascending order.
std::vector<LengthGroup> group_lengths(const std::vector<double>& values_m, double resolution_m,
                                       int most_groups = 8, int least_members = 1);

/// The best grouping into just so many groups (fewer when there are fewer values).
std::vector<LengthGroup> group_lengths_into(const std::vector<double>& values_m, double resolution_m,
                                            int groups);

/// Negative log density of the values, each under its own group's normal, in nats: the code length of the
/// values once their groups are known.
double length_within_groups(const std::vector<double>& values_m, const std::vector<LengthGroup>& groups,
                            double resolution_m);

/// The code length of the grouping in nats: negative log likelihood and half the BIC's penalty.
double code_length(const std::vector<double>& values_m, const std::vector<LengthGroup>& groups,
                   double resolution_m);

struct StructuralAxis {
  double period_m = 0;
  double residual_sd_m = 0;  ///< of the pitches about their multiples
  double period_sd_m = 0;    ///< standard error of the period
  double code_length = 0;    ///< nats
};

/// The period of which the pitches (distances between the middles of neighbouring inner walls) are multiples,
/// when saying so is shorter than grouping them freely; of equally short ones the longest. Few pitches that
/// fit no multiple are paid for one by one.
std::optional<StructuralAxis> find_axis(const std::vector<double>& pitches_m, double resolution_m);

}  // namespace gramap
