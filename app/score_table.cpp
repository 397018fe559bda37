#include "app/score_table.h"

#include <cstdio>

namespace gramap {
namespace {

std::string mistakes_of(const Scores& scores) {
  std::string text;
  for (const auto& [kind, score] : scores)
    for (const std::string& mistake : score.mistakes) text += "  " + mistake + "\n";
  return text;
}

}  // namespace

std::string score_table(const std::string& what, const Scores& scores, bool mistakes) {
  char line[200];
  std::string text = "\n" + what + "\n";
  std::snprintf(line, sizeof line, "%-14s %6s %6s %6s  %-22s %-22s\n", "kind", "truth", "found", "right",
                "recall (95 %)", "precision (95 %)");
  text += line;
  for (const auto& [kind, score] : scores) {
    const Interval r = wilson(score.right, score.truth), p = wilson(score.right, score.found);
    std::snprintf(line, sizeof line, "%-14s %6d %6d %6d  %.3f (%.3f to %.3f) %.3f (%.3f to %.3f)\n",
                  kind.c_str(), score.truth, score.found, score.right, score.recall(), r.low, r.high,
                  score.precision(), p.low, p.high);
    text += line;
  }
  return mistakes ? text + mistakes_of(scores) : text;
}

std::string reach_table(const std::string& what, const Scores& reach, bool mistakes) {
  char line[200];
  std::string text = "\n" + what + ": things that there is a candidate for\n";
  for (const auto& [kind, score] : reach) {
    std::snprintf(line, sizeof line, "%-14s %6d of %6d  %.3f\n", kind.c_str(), score.right, score.truth,
                  score.recall());
    text += line;
  }
  return mistakes ? text + mistakes_of(reach) : text;
}

}  // namespace gramap
