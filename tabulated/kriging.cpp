// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/kriging.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "tabulated/multiversion.hpp"

namespace gonio::tabulated {
namespace {

/// Keeps the factorisation going for points that nearly coincide; far below any noise of a reading.
constexpr double jitter = 1e-10;

/// Cholesky factor of the lower triangle of `matrix` (n x n, row by row), in place.
void factor(std::vector<double>& matrix, std::size_t n) {
  for (std::size_t row = 0; row < n; ++row)
    for (std::size_t column = 0; column <= row; ++column) {
      double sum = matrix[row * n + column];
      for (std::size_t k = 0; k < column; ++k) sum -= matrix[row * n + k] * matrix[column * n + k];
      matrix[row * n + column] = row == column ? std::sqrt(std::max(sum, jitter)) : sum / matrix[column * n + column];
    }
}

/// The inverse of L L', whole, from the lower triangle of L.
std::vector<double> inverse_of(const std::vector<double>& lower, std::size_t n) {
  std::vector<double> of_lower(n * n, 0.0), out(n * n, 0.0);
  for (std::size_t column = 0; column < n; ++column)
    for (std::size_t row = column; row < n; ++row) {
      double sum = row == column ? 1 : 0;
      for (std::size_t k = column; k < row; ++k) sum -= lower[row * n + k] * of_lower[k * n + column];
      of_lower[row * n + column] = sum / lower[row * n + row];
    }
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t row = 0; row <= k; ++row)
      for (std::size_t column = 0; column <= k; ++column) out[row * n + column] += of_lower[k * n + row] * of_lower[k * n + column];
  return out;
}

}  // namespace

double matern_correlation(const PairPoint& a, const PairPoint& b, const CorrelationRanges& ranges) noexcept {
  const double s2 = (a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]);
  const double t2 = (a[2] - b[2]) * (a[2] - b[2]) + (a[3] - b[3]) * (a[3] - b[3]);
  const double d = std::numbers::sqrt3 * std::sqrt(s2 / (ranges.s * ranges.s) + t2 / (ranges.t * ranges.t));
  return (1 + d) * std::exp(-d);
}

KrigingSystem::KrigingSystem(std::span<const PairPoint> points, const CorrelationRanges& ranges)
    : size_(points.size()),
      scale_{std::numbers::sqrt3 / ranges.s, std::numbers::sqrt3 / ranges.s, std::numbers::sqrt3 / ranges.t,
             std::numbers::sqrt3 / ranges.t},
      coordinates_(4 * points.size()) {
  const std::size_t n = size_;
  std::vector<double> matrix(n * n);
  for (std::size_t row = 0; row < n; ++row) {
    for (std::size_t column = 0; column < row; ++column) matrix[row * n + column] = matern_correlation(points[row], points[column], ranges);
    matrix[row * n + row] = 1 + jitter;
    for (std::size_t axis = 0; axis < 4; ++axis) coordinates_[axis * n + row] = points[row][axis] * scale_[axis];
  }
  factor(matrix, n);
  inverse_ = inverse_of(matrix, n);
  of_mean_.assign(n, 0.0);
  for (std::size_t row = 0; row < n; ++row)
    for (std::size_t column = 0; column < n; ++column) of_mean_[row] += inverse_[row * n + column];
  for (const double part : of_mean_) mean_sum_ += part;
}

GONIO_MULTIVERSION void KrigingSystem::weights_at(const PairPoint& at, KrigingWeights& out) const {
  const std::size_t n = size_;
  thread_local std::vector<double> to_place;
  to_place.resize(n);
  out.weight.assign(n, 0.0);
  double* const c = to_place.data();
  double* const weight = out.weight.data();
  for (std::size_t k = 0; k < n; ++k) {
    double squared = 0;
    for (std::size_t axis = 0; axis < 4; ++axis) {
      const double d = at[axis] * scale_[axis] - coordinates_[axis * n + k];
      squared += d * d;
    }
    c[k] = std::sqrt(squared);
  }
  for (std::size_t k = 0; k < n; ++k) c[k] = (1 + c[k]) * std::exp(-c[k]);
  for (std::size_t row = 0; row < n; ++row) {
    const double* const inverse = inverse_.data() + row * n;
    for (std::size_t k = 0; k < n; ++k) weight[k] += inverse[k] * c[row];
  }
  double sum = 0, explained = 0;
  for (std::size_t k = 0; k < n; ++k) sum += weight[k], explained += c[k] * weight[k];
  const double missing = (1 - sum) / mean_sum_;
  for (std::size_t k = 0; k < n; ++k) weight[k] += missing * of_mean_[k];
  out.variance = std::max(0.0, 1 - explained + missing * missing * mean_sum_);
}

void ordinary_kriging(const PairPoint& at, std::span<const PairPoint> points, const CorrelationRanges& ranges, KrigingWeights& out) {
  KrigingSystem(points, ranges).weights_at(at, out);
}

}  // namespace gonio::tabulated
