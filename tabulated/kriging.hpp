// SPDX-License-Identifier: BSD-3-Clause
// Weights of samples around a place, and how far a value there may be from what they give.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "tabulated/pair_coordinates.hpp"

namespace gonio::tabulated {

/// How far two values have to do with each other, in the units of the points: along s (the place in the lobe) and along t (the incidence).
struct CorrelationRanges {
  double s = 4, t = 4;
};

/// Matérn's correlation of order 3/2, (1 + √3 d) exp(-√3 d) with d² = |Δs|²/range_s² + |Δt|²/range_t² (B. Matérn, Spatial Variation, 1960):
/// one continuous derivative, which is what interpolation needs and no more than a residual has.
double matern_correlation(const PairPoint& a, const PairPoint& b, const CorrelationRanges& ranges) noexcept;

struct KrigingWeights {
  std::vector<double> weight;  ///< adds up to 1
  double variance = 0;         ///< of the error of the weighted mean, in units of the variance of the field
};

/// Ordinary kriging (G. Matheron, "Principles of geostatistics", Economic Geology 58, 1963): the weighted mean with the smallest variance
/// of its error for a field of unknown mean. No nugget: at a point the weights are that point's alone, and the variance is 0.
/// Factored once for its points, which must be distinct, at least one; then weights for any number of places.
class KrigingSystem {
 public:
  KrigingSystem() = default;
  KrigingSystem(std::span<const PairPoint> points, const CorrelationRanges& ranges);
  /// `out` is overwritten. Safe from several threads.
  void weights_at(const PairPoint& at, KrigingWeights& out) const;

 private:
  std::size_t size_ = 0;
  PairPoint scale_{};                ///< of the axes: distances become arguments of the correlation
  std::vector<double> coordinates_;  ///< [axis][point] scaled
  std::vector<double> inverse_;      ///< [row][column] of the matrix of correlations
  std::vector<double> of_mean_;      ///< inverse times 1
  double mean_sum_ = 0;              ///< 1 times inverse times 1
};

/// The same once. `out` is overwritten.
void ordinary_kriging(const PairPoint& at, std::span<const PairPoint> points, const CorrelationRanges& ranges, KrigingWeights& out);

}  // namespace gonio::tabulated
