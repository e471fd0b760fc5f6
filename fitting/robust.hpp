// SPDX-License-Identifier: BSD-3-Clause
// What keeps a few wrong readings from moving a fit: losses, the limit beyond which a reading is wrong, and robust means.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace gonio::fitting {

/// automatic  least squares unless the residuals of a robust start show isolated outliers; those are left out and listed
/// none       least squares
/// huber      weight min(1, k/|z|), k = 1.345: 95 % efficient on normal noise (Huber 1964)
/// cauchy     weight 1/(1 + (z/k)²), k = 2.385: as efficient, and gross outliers lose all influence
enum class Robust { automatic, none, huber, cauchy };
const char* name(Robust robust) noexcept;
std::optional<Robust> robust_named(std::string_view text);

/// The weight of a standardised residual in iteratively re-weighted least squares; 1 for `none` and `automatic`.
double loss_weight(Robust loss, double z) noexcept;

/// The |z| that one of `n` normal residuals exceeds with a probability of 0.1 %, the two-sided Bonferroni limit: 5.5 for 30 000.
double outlier_limit(std::size_t n) noexcept;
/// The same in units of a standard deviation that was estimated with `dof` degrees of freedom: Student's t, by the approximation of
/// Wallace (1959).
double outlier_limit(std::size_t n, double dof) noexcept;

/// Median of |z|; 0.674 for standard normal residuals. Reorders its argument; NaN if it is empty.
double median_of(std::span<double> values) noexcept;

/// Whether outliers stand in runs: more than half of them lie beside another one in the order of the samples. A model that does not
/// fit leaves runs, wrong readings stand alone. `samples` ascending.
bool in_runs(std::span<const std::size_t> samples) noexcept;

/// Readings of one quantity with normal noise, a few of them wrong.
struct RobustMean {
  double mean = 0;
  double within = 0;                  ///< Σ weight (value - mean)², scaled so that within/(count - 1) estimates the variance
  std::size_t count = 0;              ///< values not rejected
  std::vector<std::size_t> outliers;  ///< their numbers in `values`, ascending
  double scale = 0;                   ///< standard deviation of the good ones
};

/// At most this many values judge a row.
inline constexpr std::size_t judges = 129;

/// The values among which `n` readings of one quantity look clean: those within the outlier limit of the median of some of them, with
/// room for what a median deviation of few values may be wrong by. Wrong readings lie outside, and so do some where the spread is far
/// from normal. Everything for fewer than ten values. Reorders `some`.
struct CleanRange {
  double low, high;
};
CleanRange clean_range(std::span<double> some, std::size_t n) noexcept;
/// The same for a limit in standard deviations.
CleanRange clean_range_within(std::span<double> some, double limit) noexcept;

/// Median and median deviation, then location and scale together (Huber's proposal 2, k = 2), then:
///   automatic  the mean of all values within the outlier limit, unless the others stand in runs
///   huber, cauchy  the mean with that loss
/// `scratch` is used as working space.
RobustMean robust_mean(std::span<const double> values, Robust loss, std::vector<double>& scratch);
/// The same with another limit than outlier_limit(values.size()), where the values are a few of many.
RobustMean robust_mean_within(std::span<const double> values, Robust loss, double limit, std::vector<double>& scratch);

}  // namespace gonio::fitting
