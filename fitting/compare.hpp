// SPDX-License-Identifier: BSD-3-Clause
// How two BRDFs differ: every metric, where most, by incidence, and against their uncertainties.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "fitting/compared_values.hpp"

namespace gonio::fitting {

/// Root mean square of the residuals B - A under one metric. The metrics of `Metric` count every sample alike (under quadrature by its
/// measure dwi dwo) and say how far B as a fit of A is off; `ngan` is Ngan, Durand and Matusik's "Experimental Analysis of BRDF Models"
/// (EGSR 2005): ((f_B - f_A) cos theta_i)² with solid-angle weights (for samples sin theta_i sin theta_o, right
/// on a grid of equal angular steps), both zenith angles at most 80°. Trap: a plain sum over MERL's cells is another metric, heavy on the
/// highlight.
struct MetricError {
  std::string metric;                  ///< linear, linear-cos, log, log1p, cbrt, ngan
  std::optional<std::size_t> channel;  ///< position in `ComparedValues::channels`; none: all together
  std::optional<double> absolute;      ///< none where no value counts
  std::optional<double> relative;      ///< over the root mean square of A under the same metric; none for `log`, which is relative itself
  std::size_t n = 0;                   ///< values that counted
};

struct LargestDifference {
  GonioAngles angles;
  std::size_t channel = 0;
  double a = 0, b = 0;  ///< 1/sr
  double difference = 0;
};

/// All channels together, under the terms of `linear_cos`.
struct IncidenceDifference {
  double theta_i_deg = 0;  ///< of the incidence, or the middle of a band 10° wide where there are too many
  std::size_t n = 0;
  double absolute = 0;             ///< rms of (f_B - f_A) cos theta_i
  std::optional<double> relative;  ///< over that of A
  std::optional<double> bias;      ///< Σ w (f_B - f_A) over Σ w f_A
  double largest_relative = 0;     ///< largest |relative_difference|
};

/// χ² of the differences where uncertainties are known. Independent parts only, and with the correlated components of both sides (taken
/// as independent of each other) by the matrix inversion lemma, so that a common scale is not counted once per sample.
struct ChiSquare {
  std::size_t n = 0;
  double independent_per_n = 0, correlated_per_n = 0;
  double p_value = 0;          ///< of the correlated one, n degrees of freedom
  std::string uncertainty_of;  ///< `both`, or `a` or `b` where the other side is a model or table, taken as exact
};

struct Comparison {
  std::size_t n = 0;               ///< values (directions times channels) known on both sides
  std::size_t n_unknown = 0;       ///< known on one side at most
  std::size_t n_not_positive = 0;  ///< f <= 0 on a side: left out under `log`
  std::vector<MetricError> metrics;
  std::optional<LargestDifference> largest_absolute, largest_relative;
  std::vector<IncidenceDifference> incidences;
  std::optional<ChiSquare> chi_square;
};

/// 2 (b - a) / (|a| + |b|), in [-2, 2]; 0 where both are 0.
double relative_difference(double a, double b) noexcept;

Comparison compare(const ComparedValues& values);

}  // namespace gonio::fitting
