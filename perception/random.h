// Random numbers that are the same on every machine: an explicit generator with its own distributions (the
// standard library's differ from one implementation to the next).
#pragma once

#include <cstdint>
#include <string_view>

#include "geometry/random.h"

namespace gramap {

/// SplitMix64 (Steele, Lea, Flood 2014): 64 bits of state, every seed gives a good stream.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  std::uint64_t next() {
    const std::uint64_t number = split_mix(state_);
    state_ += 0x9e3779b97f4a7c15U;
    return number;
  }

  /// Uniform in [0, 1).
  double uniform() { return unit_interval(next()); }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }

  /// Uniform in 0 … n−1; n > 0.
  int below(int n) { return static_cast<int>(uniform() * n); }
  bool chance(double probability) { return uniform() < probability; }

  /// Standard normal (Box and Muller 1958).
  double normal() {
    const double u = 1 - uniform();
    return box_muller(u, uniform());
  }

 private:
  std::uint64_t state_;
};

/// A seed of its own for a named thing, so that what happens to one room does not depend on the others.
inline std::uint64_t seed_for(std::uint64_t seed, std::string_view name) {
  std::uint64_t hash = 0xcbf29ce484222325U ^ seed;
  for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
  return Random(hash).next();
}

}  // namespace gramap
