// SPDX-License-Identifier: BSD-3-Clause
// Blocks of samples reduced to their weight, mean and centred sum of squares.
#pragma once

#include <vector>

#include "brdf/observations.hpp"
#include "fitting/transform.hpp"

namespace gonio::fitting {

struct BlockSums {
  double weight = 0, mean = 0, within = 0, weighted_value2 = 0;
  std::size_t count = 0;
};

struct CollapsedBlock {
  std::vector<BlockSums> channel;
  std::size_t used = 0, masked = 0;  ///< samples with a value used, and with a value left out
};

/// One block under one metric; `weighted`: w = 1/(u φ')². A plain table (f64, no u, metric linear) takes a loop that the compiler
/// vectorises, about a nanosecond a value.
CollapsedBlock collapse(const Observations& observations, std::size_t index, Transform transform, bool weighted);

}  // namespace gonio::fitting
