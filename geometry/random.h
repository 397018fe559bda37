// Random numbers that are the same on every machine: the pieces that generators and distributions are made
// of (the standard library's distributions differ from one implementation to the next).
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

namespace gramap {

/// SplitMix64 (Steele, Lea, Flood 2014): the number that a generator in state `state` gives. Well mixed, so
/// that counters make good seeds.
constexpr std::uint64_t split_mix(std::uint64_t state) {
  std::uint64_t z = state + 0x9e3779b97f4a7c15U;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
  return z ^ (z >> 31);
}

/// In [0, 1), from the upper 53 of 64 random bits.
constexpr double unit_interval(std::uint64_t bits) {
  return static_cast<double>(bits >> 11) * 0x1p-53;
}

/// A standard normal number (Box and Muller 1958) from two uniform ones, `u` in (0, 1] and `v` in [0, 1).
inline double box_muller(double u, double v) {
  return std::sqrt(-2 * std::log(u)) * std::cos(2 * std::numbers::pi * v);
}

}  // namespace gramap
