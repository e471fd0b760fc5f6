// SPDX-License-Identifier: BSD-3-Clause
// Isotonic regression: the nearest sequence that never rises.
#pragma once

#include <vector>

namespace gonio::fitting {

/// The non-increasing sequence g that minimises Σ weight (value - g)², by pooling adjacent violators (Ayer et al. 1955), in linear time.
/// Weights > 0.
std::vector<double> non_increasing(const std::vector<double>& values, const std::vector<double>& weights);

}  // namespace gonio::fitting
