// SPDX-License-Identifier: BSD-3-Clause
// Numbers of samples made pseudo-random, so that no grid can resonate with a choice among them.
#pragma once

#include <cstdint>

namespace gonio::fitting {

/// The n-th number of the generator splitmix64 with the seed 0 (Steele, Lea and Flood 2014): equal for equal n, whoever asks.
inline std::uint64_t scrambled(std::uint64_t n) noexcept {
  std::uint64_t z = (n + 1) * 0x9E3779B97F4A7C15u;
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
  return z ^ (z >> 31);
}

}  // namespace gonio::fitting
