// SPDX-License-Identifier: BSD-3-Clause
// Hash of a key and the normal deviate made from it.
#include "acquisition/simulated/noise.hpp"

#include <cmath>
#include <numbers>

namespace gonio::acquisition::simulated {
namespace {

std::uint64_t mix(std::uint64_t z) noexcept {
  z += 0x9e3779b97f4a7c15;
  z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9;
  z = (z ^ z >> 27) * 0x94d049bb133111eb;
  return z ^ z >> 31;
}

/// Uniform in (0, 1]: 53 bits, never 0, so that its logarithm is finite.
double uniform(std::uint64_t bits) noexcept { return static_cast<double>((bits >> 11) + 1) * 0x1p-53; }

}  // namespace

std::uint64_t hash(std::initializer_list<std::uint64_t> key) noexcept {
  std::uint64_t state = 0;
  for (const std::uint64_t word : key) state = mix(state ^ word);
  return state;
}

double normal_deviate(std::initializer_list<std::uint64_t> key) noexcept {
  const std::uint64_t first = hash(key), other = mix(first);
  return std::sqrt(-2 * std::log(uniform(first))) * std::cos(2 * std::numbers::pi * uniform(other));
}

}  // namespace gonio::acquisition::simulated
