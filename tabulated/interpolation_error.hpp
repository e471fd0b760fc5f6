// SPDX-License-Identifier: BSD-3-Clause
// How well samples are predicted by the others: the ranges of kriging and the size of its error, from the samples themselves.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "tabulated/guided_samples.hpp"
#include "tabulated/kriging.hpp"

namespace gonio::tabulated {

/// Samples around a place that take part in its value, and how far off they may lie, in steps of the plan.
constexpr std::size_t kriging_neighbours = 16;
constexpr double kriging_reach = 3;

/// What the error of an interpolated rest y is made of: the error of the samples, their noise carried through the weights, and the error of
/// interpolation, (variance · variance of kriging + bend · L²) · (how much the neighbourhood differs from the rest of the samples), where L
/// is the logarithm of g + floor at the place less that of its neighbours by their weights: a guide that is a little too narrow is wrong
/// where it is steep and curved, and nowhere else.
///
/// Samples are left out, one at a time and whole incidences at a time, and predicted from the others; ranges and variances are those of the
/// largest likelihood of what the predictions miss by, under a Student distribution (4 degrees of freedom, so that a lobe in few places
/// does not rule all of them). The variance is then stretched or shrunk until 95 % of the misses lie within 1.96 of their uncertainty.
/// Places beyond the other samples take no part.
struct InterpolationError {
  CorrelationRanges ranges;      ///< in steps of the plan
  std::vector<double> variance;  ///< of y per channel
  std::vector<double> bend;      ///< per channel: of y, per L²
  std::vector<double> noise;     ///< of y per channel: of samples of unknown u, estimated together with the variance; else 0
  std::vector<std::vector<double>>
      local;  ///< [channel][mean] mean (miss/its uncertainty)² of the sample left out alone and with its incidence; NaN: not predicted
  std::size_t n_left_out = 0;  ///< predictions the estimate rests on
  double rms = 0;              ///< of what single samples are missed by, relative to g + floor, all channels
  /// Mean relative error of samples predicted from the others, |predicted - f|/|f|, at most 1 for each: left out alone, and with the whole
  /// of their incidence (NaN where there are too few). By these one guide is better than another.
  double mean_alone = 0, mean_incidence = 0;

  /// Variance of y at a place of a channel from its neighbours: noise through the weights, and interpolation.
  struct Parts {
    double noise = 0, interpolation = 0;
  };
  /// `scale` is g + floor at the place.
  Parts parts(const GuidedSamples& samples, std::size_t channel, double scale, std::span<const std::size_t> places,
              const KrigingWeights& weights) const;
  /// Variance of y of one place by itself: u², or the estimated noise.
  double sample_variance(const GuidedSamples& samples, std::size_t channel, std::size_t place) const;
};

/// At most `most` samples, spread over all of them, are predicted; the others have no `local`. All are wanted for a table, fewer tell
/// which guide is better.
InterpolationError estimate_interpolation_error(const GuidedSamples& samples, int threads,
                                                std::size_t most = std::numeric_limits<std::size_t>::max());

}  // namespace gonio::tabulated
