// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/kriging.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

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

/// Solves L Lᵀ x = x in place.
void solve(const std::vector<double>& lower, std::size_t n, std::vector<double>& x) {
  for (std::size_t row = 0; row < n; ++row) {
    for (std::size_t k = 0; k < row; ++k) x[row] -= lower[row * n + k] * x[k];
    x[row] /= lower[row * n + row];
  }
  for (std::size_t row = n; row-- > 0;) {
    for (std::size_t k = row + 1; k < n; ++k) x[row] -= lower[k * n + row] * x[k];
    x[row] /= lower[row * n + row];
  }
}

}  // namespace

double matern_correlation(const PairPoint& a, const PairPoint& b, const CorrelationRanges& ranges) noexcept {
  const double s2 = (a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]);
  const double t2 = (a[2] - b[2]) * (a[2] - b[2]) + (a[3] - b[3]) * (a[3] - b[3]);
  const double d = std::numbers::sqrt3 * std::sqrt(s2 / (ranges.s * ranges.s) + t2 / (ranges.t * ranges.t));
  return (1 + d) * std::exp(-d);
}

void ordinary_kriging(const PairPoint& at, std::span<const PairPoint> points, const CorrelationRanges& ranges, KrigingWeights& out) {
  const std::size_t n = points.size();
  thread_local std::vector<double> matrix, to_place, of_place, of_mean;
  matrix.resize(n * n);
  to_place.resize(n);
  for (std::size_t row = 0; row < n; ++row) {
    for (std::size_t column = 0; column < row; ++column) matrix[row * n + column] = matern_correlation(points[row], points[column], ranges);
    matrix[row * n + row] = 1 + jitter;
    to_place[row] = matern_correlation(at, points[row], ranges);
  }
  factor(matrix, n);
  of_place = to_place;
  of_mean.assign(n, 1.0);
  solve(matrix, n, of_place);
  solve(matrix, n, of_mean);
  double place_sum = 0, mean_sum = 0, explained = 0;
  for (std::size_t k = 0; k < n; ++k) place_sum += of_place[k], mean_sum += of_mean[k], explained += to_place[k] * of_place[k];
  const double missing = (1 - place_sum) / mean_sum;
  out.weight.resize(n);
  for (std::size_t k = 0; k < n; ++k) out.weight[k] = of_place[k] + missing * of_mean[k];
  out.variance = std::max(0.0, 1 - explained + missing * missing * mean_sum);
}

}  // namespace gonio::tabulated
