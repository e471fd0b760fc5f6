// SPDX-License-Identifier: BSD-3-Clause
// All that a fit needs of some samples, small enough to be sent, and added up to what a fit needs of all of them.
#pragma once

#include <string>
#include <vector>

#include "fitting/fit.hpp"
#include "fitting/terms.hpp"

namespace gonio::fitting {

/// Weight, mean and centred sum of squares of the samples of a row, by channel: Σ w (φ - φ̂)² = W (φ̄ - φ̂)² + Σ w (φ - φ̄)², exactly, for
/// every model that is constant over the row (numerics D.2).
struct SufficientStatistics {
  /// What a row is: a row of a table over which θh is constant, kept apart from equal rows of other tables so that its scatter stays its
  /// own; or all samples with the same geometry, as far as the models see it.
  enum class Rows { table_rows, directions };

  struct Channel {
    std::vector<double> weight, mean, within;  ///< one per row; weight 0: no sample of this channel
    std::vector<std::size_t> count;
    double weighted_value2 = 0;  ///< Σ weight φ'² f²: the signal-to-noise in all, where the data carry u
  };

  DependsOn depends_on = DependsOn::theta_h;  ///< models that depend on this, or on nothing, can be fitted
  Metric metric = Metric::linear;
  bool weighted = false;  ///< weights are 1/u², so that the sum is a χ²
  Rows rows = Rows::table_rows;
  Channels channels;
  std::vector<double> log_cosine;   ///< ln cos θh or ln cos ψ of every row, -infinity where there is no lobe; empty if depends_on is all
  std::vector<GonioAngles> angles;  ///< of every row if depends_on is all
  std::vector<Channel> channel;
  std::vector<CorrelatedComponent> correlated;  ///< common to all samples
  std::size_t n_observations = 0, n_outliers = 0;
  NotFitted not_fitted;

  std::size_t row_count() const noexcept { return depends_on == DependsOn::all ? angles.size() : log_cosine.size(); }
};

/// The statistics of observations for a model and all that depend on the same geometry. Of `options` count model, metric, weights, robust
/// (the means of table rows) and threads.
/// Error(usage) for log1p with a model that depends on one angle only (the metric holds the incidence inside), Error(input) for
/// correlated components with sensitivities, which no sum over samples keeps.
SufficientStatistics sufficient_statistics(const Observations& observations, const FitOptions& options);

/// The statistics of all parts: rows one after the other, equal directions as one row. A fit of them is the fit of all samples at once to
/// the rounding of sums. Error(input) naming every part that differs from the first in geometry, metric, weights, rows, channels or
/// correlated components.
SufficientStatistics merge(const std::vector<SufficientStatistics>& parts);

/// The fit of all samples that went in: see fit(Observations, FitOptions). Table rows take every default; statistics of directions know no
/// scatter of single samples, so no variance is estimated and no reading is left out. Of the errors only that of the metric is known,
/// and that only without weights; the others are NaN.
/// Error(usage) as for observations, for another metric than that of the statistics, for a model that depends on more than they hold, and
/// where require_estimable refuses.
FitResult fit(const SufficientStatistics& statistics, const FitOptions& options);

/// Error(usage) if the options ask for a variance model or against outliers where there are only sums over directions: with samples that
/// state no uncertainty, a metric or `Weights::none` must be named.
void require_estimable(bool weighted, SufficientStatistics::Rows rows, const FitOptions& options);

/// The terms a fit minimises. Error(usage) if the model depends on more than the statistics hold.
Terms make_terms(const SufficientStatistics& statistics, const ModelKernel& kernel);

const char* name(DependsOn depends_on) noexcept;  ///< `nothing`, `theta_h`, `psi` or `all`

}  // namespace gonio::fitting
