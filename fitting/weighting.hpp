// SPDX-License-Identifier: BSD-3-Clause
// How much each sample of a fit counts, why, and which ones were found to be wrong.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "brdf/coordinates.hpp"
#include "fitting/robust.hpp"
#include "fitting/variance_model.hpp"

namespace gonio::fitting {

/// What is asked for:
///   automatic    1/u² where the data carry u; else 1/σ² of a variance model estimated from the data if no metric is named, and 1 if
///                one is: then the sum is the metric as its table has it, and nothing else
///   none         1, whatever the data carry
///   solid_angle  what the sample stands for of all pairs of directions, whatever the data carry (solid_angles.hpp): the sum is an
///                integral of the metric. Trap: the intervals take the noise for smaller where the weight is larger
///   uncertainty  1/u² where the data carry u, else 1
///   variance     1/u² where the data carry u, else the variance model under any metric
enum class Weights { automatic, none, uncertainty, variance, solid_angle };
const char* name(Weights weights) noexcept;
std::optional<Weights> weights_named(std::string_view text);

/// Where the weights came from.
enum class WeightSource {
  none,         ///< every weight 1 (cos² θi under linear-cos)
  solid_angle,  ///< what the samples stand for (times cos² θi under linear-cos)
  uncertainty,  ///< u of the data
  repeats,      ///< a variance model from readings of the same directions: independent of the model that is fitted
  rows,         ///< the scatter within the rows of a table over which the model is constant: independent of it too
  residuals     ///< a variance model from the residuals of the fit itself
};
const char* name(WeightSource source) noexcept;

/// A reading far from what the others say.
struct Outlier {
  std::size_t sample = 0;        ///< number of the sample, from 0 in the order of the observations
  std::size_t channel = 0;       ///< number of the channel
  double value = 0, fitted = 0;  ///< 1/sr
  double z = 0;                  ///< (value - fitted) over the standard deviation of one reading
  GonioAngles angles = {};       ///< of the sample
};

struct Weighting {
  WeightSource source = WeightSource::none;
  std::vector<VarianceModel> variance;  ///< per channel; empty unless the source is repeats, rows or residuals
  Robust robust = Robust::none;         ///< what was done; automatic: outliers were left out
  std::string reason;                   ///< one sentence on why that was done; empty if nothing was asked for
  std::size_t n_outliers = 0;           ///< values left out, or beyond the outlier limit under a loss
  std::vector<Outlier> outliers;        ///< the farthest `most_listed` of them, by sample, then channel

  static constexpr std::size_t most_listed = 1000;
  /// Counts these as outliers too and keeps the farthest.
  void add(std::vector<Outlier> more);
};

}  // namespace gonio::fitting
