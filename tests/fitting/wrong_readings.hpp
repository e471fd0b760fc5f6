// SPDX-License-Identifier: BSD-3-Clause
// Readings made wrong, as a cosmic ray or a slipped filter does.
#pragma once

#include <cstddef>
#include <random>
#include <vector>

namespace gonio::test {

/// Makes 1 % of the readings that are not negative 20 times too high, [channel][sample]; returns how many.
inline std::size_t spoil(std::vector<std::vector<double>>& f, unsigned seed) {
  std::mt19937_64 random(seed);
  std::bernoulli_distribution wrong(.01);
  std::size_t count = 0;
  for (std::vector<double>& channel : f)
    for (double& value : channel)
      if (wrong(random) && value >= 0) value *= 20, ++count;
  return count;
}

}  // namespace gonio::test
