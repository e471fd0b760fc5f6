// SPDX-License-Identifier: BSD-3-Clause
// Blocks of samples reduced to their weight, mean and centred sum of squares.
#pragma once

#include <span>
#include <vector>

#include "brdf/observations.hpp"
#include "fitting/not_fitted.hpp"
#include "fitting/transform.hpp"
#include "fitting/weighting.hpp"

namespace gonio::fitting {

struct BlockSums {
  double weight = 0, mean = 0, within = 0, weighted_value2 = 0;
  std::size_t count = 0;
};

struct CollapsedBlock {
  std::vector<BlockSums> channel;
  std::size_t used = 0;           ///< samples with a value used
  NotFitted not_fitted;           ///< those with a value left out; directions are not looked at
  std::vector<Outlier> outliers;  ///< by channel; `sample` within the block, `fitted` the mean of the row
};

/// One block under one metric; `weighted`: w = 1/(u φ')². A plain table (f64, no u, metric linear) takes a loop that the compiler
/// vectorises, about a nanosecond a value.
///
/// `robust`: the loss of the mean (robust_mean) where a channel of an unweighted block does not look clean; a clean one keeps its plain
/// sums, bit for bit. Values with their own u stay as they are.
/// `weights`: factors of the weights of its samples, or none; then without `robust`.
CollapsedBlock collapse(const Observations& observations, std::size_t index, Transform transform, bool weighted,
                        Robust robust = Robust::none, std::span<const double> weights = {});

}  // namespace gonio::fitting
