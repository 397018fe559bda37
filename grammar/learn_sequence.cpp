#include "grammar/learn_sequence.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace gramap {
namespace {

double token_length(const SequenceToken& token, std::size_t symbols) {
  if (token.symbols.size() == 1 && token.most == 0) return 0;
  double length =
      (static_cast<double>(token.symbols.size()) + 1) * std::log(static_cast<double>(symbols) + 1);
  if (token.most > 0) length += 2 * std::log(static_cast<double>(token.most) + 1);
  return length;
}

double total_length(const SequenceModel& model, std::size_t symbols) {
  double length = sequence_length(model.sequences, model.tokens.size());
  for (std::size_t t = 0; t < model.tokens.size(); ++t) {
    length += token_length(model.tokens[t], symbols);
    if (model.tokens[t].most == 0) continue;
    const double choices = model.tokens[t].most - model.tokens[t].least + 1;  // each count alike
    for (const auto& sequence : model.sequences)
      length += static_cast<double>(std::count(sequence.begin(), sequence.end(), static_cast<int>(t))) *
                std::log(choices);
  }
  return length;
}

SequenceModel with_unit(const SequenceModel& model, int a, int b) {
  SequenceModel next = model;
  SequenceToken unit = model.tokens[static_cast<std::size_t>(a)];
  const SequenceToken& second = model.tokens[static_cast<std::size_t>(b)];
  unit.symbols.insert(unit.symbols.end(), second.symbols.begin(), second.symbols.end());
  const int name = static_cast<int>(next.tokens.size());
  next.tokens.push_back(unit);
  for (auto& sequence : next.sequences) {
    std::vector<int> shorter;
    for (std::size_t i = 0; i < sequence.size(); ++i) {
      const bool here = i + 1 < sequence.size() && sequence[i] == a && sequence[i + 1] == b;
      shorter.push_back(here ? name : sequence[i]);
      i += here;
    }
    sequence = std::move(shorter);
  }
  return next;
}

SequenceModel with_repeat(const SequenceModel& model, int a) {
  SequenceModel next = model;
  SequenceToken repeat = model.tokens[static_cast<std::size_t>(a)];
  const int name = static_cast<int>(next.tokens.size());
  for (auto& sequence : next.sequences) {
    std::vector<int> shorter;
    for (std::size_t i = 0; i < sequence.size();) {
      std::size_t end = i;
      while (end < sequence.size() && sequence[end] == a) ++end;
      const int run = static_cast<int>(end - i);
      if (run >= 2) {
        repeat.least = repeat.least == 0 ? run : std::min(repeat.least, run);
        repeat.most = std::max(repeat.most, run);
        shorter.push_back(name);
        i = end;
      } else {
        shorter.push_back(sequence[i++]);
      }
    }
    sequence = std::move(shorter);
  }
  next.tokens.push_back(repeat);
  return next;
}

}  // namespace

double log_evidence_of_own(const std::vector<double>& counts, const std::vector<double>& overall,
                           double strength) {
  double n = 0, own = 0, shared = 0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (counts[i] == 0) continue;
    const double prior = strength * overall[i];
    own += std::lgamma(prior + counts[i]) - std::lgamma(prior);
    shared += counts[i] * std::log(overall[i]);
    n += counts[i];
  }
  return own + std::lgamma(strength) - std::lgamma(strength + n) - shared;
}

// The tokens' shares learned on the way (Krichevsky-Trofimov), each token
// after its own distribution where that pays.
double sequence_length(const std::vector<std::vector<int>>& sequences, std::size_t tokens) {
  std::vector<double> total(tokens, 0);
  std::map<int, std::vector<double>> following;
  for (const auto& sequence : sequences) {
    int before = -1;
    for (const int token : sequence) {
      total[static_cast<std::size_t>(token)] += 1;
      auto& counts = following.try_emplace(before, tokens, 0.0).first->second;
      counts[static_cast<std::size_t>(token)] += 1;
      before = token;
    }
  }
  double n = 0, used = 0;
  for (const double count : total) n += count, used += count > 0;
  if (n == 0) return 0;
  double length = std::lgamma(n + used / 2) - std::lgamma(used / 2);
  for (const double count : total)
    if (count > 0) length -= std::lgamma(count + 0.5) - std::lgamma(0.5);
  std::vector<double> overall;
  for (const double count : total) overall.push_back(count / n);
  for (const auto& [before, counts] : following)
    length -= std::max(0.0, log_evidence_of_own(counts, overall, 1.0) - std::log(2.0));
  return length;
}

SequenceModel describe_sequences(const std::vector<std::vector<int>>& sequences, int symbols) {
  SequenceModel model;
  for (int i = 0; i < symbols; ++i) model.tokens.push_back({{i}, 0, 0});
  model.sequences = sequences;
  const std::size_t alphabet = static_cast<std::size_t>(symbols);
  model.length = total_length(model, alphabet);
  for (int round = 0; round < 12; ++round) {
    std::map<std::pair<int, int>, int> pairs;
    for (const auto& sequence : model.sequences)
      for (std::size_t i = 0; i + 1 < sequence.size(); ++i) ++pairs[{sequence[i], sequence[i + 1]}];
    SequenceModel best = model;
    const auto consider = [&](SequenceModel candidate) {
      candidate.length = total_length(candidate, alphabet);
      if (candidate.length < best.length - 1e-9) best = std::move(candidate);
    };
    for (const auto& [pair, count] : pairs) {
      if (count < 2) continue;
      const bool plain = model.tokens[static_cast<std::size_t>(pair.first)].most == 0 &&
                         model.tokens[static_cast<std::size_t>(pair.second)].most == 0;
      if (pair.first == pair.second && plain)
        consider(with_repeat(model, pair.first));
      else if (plain)
        consider(with_unit(model, pair.first, pair.second));
    }
    if (best.length >= model.length - 1e-9) break;
    model = std::move(best);
  }
  return model;
}

}  // namespace gramap
