// SPDX-License-Identifier: BSD-3-Clause
// Observations as the terms of the sum a fit minimises: one row per sample, or one per block where nothing is lost.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "brdf/observations.hpp"
#include "fitting/convolution.hpp"
#include "fitting/model_kernel.hpp"
#include "fitting/not_fitted.hpp"
#include "fitting/row_sums.hpp"
#include "fitting/transform.hpp"
#include "fitting/weighting.hpp"

namespace gonio::fitting {

/// One channel: row j adds weight[j] (φ(f̂_j) - target[j])², and all rows together the constant `within`.
struct ChannelTerms {
  std::vector<double> target;             ///< φ(f), or its weighted mean over a collapsed block
  std::vector<double> weight;             ///< 0: this row has no value in this channel
  std::vector<double> value;              ///< f [1/sr] where the rows are single samples, else empty
  std::vector<double> u2, read_variance;  ///< 1/sr², single samples with uncertainty only
  double within = 0;                      ///< centred sum of squares inside collapsed blocks
  std::vector<double> row_within;         ///< of every collapsed row, else empty
  std::vector<std::size_t> row_count;     ///< samples used in every collapsed row, else empty
  double weighted_value2 = 0;             ///< Σ weight φ'² f²: the signal-to-noise in all, where the data carry u
  std::size_t count = 0;                  ///< samples used
};

struct Terms {
  ModelKernel kernel;
  Transform transform;
  std::vector<LobeGeometry> geometry;  ///< one per row
  std::vector<std::size_t> sample;     ///< number of the sample of every row; empty if collapsed
  MeanRows mean;                       ///< rows whose f̂ is a mean over the apertures instead of the value at `geometry`
  std::vector<double> factor;          ///< of f̂ by row: correlated components that are being estimated; empty: 1
  std::vector<ChannelTerms> channel;
  bool weighted = false;    ///< weights are 1/variance, so that the sum is a χ²
  bool pure_error = false;  ///< weights are 1/variance of the scatter of the data among themselves, whatever the model misses
  bool collapsed = false;   ///< a row is many samples: a whole block, or a bin (angle_bins.hpp)
  RowsOf rows_of = RowsOf::samples;
  std::string approximation;  ///< what the rows lose and why, in a sentence; empty: nothing
  std::size_t n_observations = 0;
  NotFitted not_fitted;
  /// If set, the rows are a part of the data, with weights raised to stand for all; the profile is that of these sums, of all samples.
  std::shared_ptr<RowSums> sums;
  std::vector<double> represents;  ///< with `sums`: how many samples every row stands for
  std::vector<Outlier> outliers;   ///< of collapsed rows, left out or weighed down there

  std::size_t rows() const noexcept { return geometry.size(); }

  /// columns[k · stride + j] = basis_k of row begin + j at the nonlinear parameters `theta`. Together with the next the only place where
  /// the model meets the geometry of the rows.
  void basis(std::size_t begin, std::size_t end, const double* theta, double* columns, std::size_t stride) const;
  /// The same, and slopes[(i · linear + k) · stride + j] = d basis_k / d theta_i.
  void basis_and_slopes(std::size_t begin, std::size_t end, const double* theta, double* columns, double* slopes, std::size_t stride) const;
};

/// Which samples count and how much:
///   - what an Omission says (not_fitted.hpp) is left out and counted;
///   - the data carry u if every channel has it for at least half of its values; then values with unknown u are left out too, otherwise
///     every weight is 1;
///     Under `weights` none and solid_angle u is ignored; under solid_angle that takes the place of 1 (Error(usage) for scattered samples);
///   - a sample with a zenith angle of exactly 90° is compared with the model's limit there.
/// `n_observations` counts samples with a value used, `not_fitted` those with a value left out.
///
/// Blocks over which θh is constant collapse to one row if the model depends on nothing else and the metric allows it (log1p does not):
/// Σ w (φ - φ̂)² = W (φ̄ - φ̂)² + Σ w (φ - φ̄)², exact, with the centred sum formed apart.
/// `robust`: the loss of the mean of such a row, see collapse.hpp; nothing where the rows are single samples.
///
/// Of more than `most_samples` single samples (0: any number) one of every few becomes a row, at a pseudo-random place among them: even
/// in the order of the data, as likely for one sample as for another, in step with no grid, and the same whenever it is asked for.
/// `approximation` says so; `n_observations` counts the rows then, `not_fitted` looks at every sample all the same.
Terms make_terms(const Observations& observations, const ModelKernel& kernel, Metric metric, int threads, Robust robust = Robust::none,
                 Weights weights = Weights::automatic, std::size_t most_samples = 0);

/// The terms of one channel alone; it becomes channel 0 of its outliers.
Terms only_channel(const Terms& terms, std::size_t channel);

/// Weights from the fitted values instead of the readings, where the read variance is known: the shot part of the variance grows with
/// f, var(f̂) = var_read + (u² - var_read) f̂/f. Weights from the readings themselves favour low readings (numerics C13).
/// Returns false if there is nothing to change.
bool reweight(Terms& terms, const std::vector<std::vector<double>>& linear, const std::vector<double>& theta);

}  // namespace gonio::fitting
