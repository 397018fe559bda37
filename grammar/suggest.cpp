#include "grammar/suggest.h"

#include <algorithm>
#include <cctype>

namespace gramap {
namespace {

char lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

/// Optimal string alignment distance (Damerau 1964), in quarters: a difference in case costs one quarter.
int distance(std::string_view a, std::string_view b) {
  std::vector<std::vector<int>> cost(a.size() + 1, std::vector<int>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) {
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        cost[i][j] = 4 * static_cast<int>(i + j);
        continue;
      }
      const int change = a[i - 1] == b[j - 1] ? 0 : lower(a[i - 1]) == lower(b[j - 1]) ? 1 : 4;
      cost[i][j] = std::min({cost[i - 1][j] + 4, cost[i][j - 1] + 4, cost[i - 1][j - 1] + change});
      if (i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1]))
        cost[i][j] = std::min(cost[i][j], cost[i - 2][j - 2] + 4);
    }
  }
  return cost[a.size()][b.size()];
}

}  // namespace

std::string nearest(std::string_view word, const std::vector<std::string_view>& candidates) {
  std::string_view best;
  const int limit = 4 * std::max(1, static_cast<int>(word.size()) / 3);
  int least = limit + 1;
  for (const std::string_view candidate : candidates) {
    if (candidate == word || candidate.size() > word.size() + 3 || word.size() > candidate.size() + 3 ||
        word.size() > 64)
      continue;
    const int errors = distance(word, candidate);
    if (errors >= least || errors >= 4 * static_cast<int>(candidate.size())) continue;
    least = errors;
    best = candidate;
  }
  return std::string(best);
}

}  // namespace gramap
