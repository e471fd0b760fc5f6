// SPDX-License-Identifier: BSD-3-Clause
// Weighted least squares with a few non-negative unknowns, from the triangle of a QR decomposition built row block by row block.
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "fitting/model_kernel.hpp"

namespace gonio::fitting {

/// A small dense matrix, column by column.
class Matrix {
 public:
  Matrix() = default;
  Matrix(std::size_t rows, std::size_t columns, double value = 0) : rows_(rows), columns_(columns), values_(rows * columns, value) {}

  std::size_t rows() const noexcept { return rows_; }
  std::size_t columns() const noexcept { return columns_; }
  double* data() noexcept { return values_.data(); }
  const double* data() const noexcept { return values_.data(); }
  double& operator()(std::size_t row, std::size_t column) { return values_[column * rows_ + row]; }
  double operator()(std::size_t row, std::size_t column) const { return values_[column * rows_ + row]; }
  std::span<double> column(std::size_t k) { return std::span(values_).subspan(k * rows_, rows_); }
  std::span<const double> column(std::size_t k) const { return std::span(values_).subspan(k * rows_, rows_); }
  /// The first `rows` rows of the first `columns` columns.
  Matrix top_left(std::size_t rows, std::size_t columns) const;

 private:
  std::size_t rows_ = 0, columns_ = 0;
  std::vector<double> values_;
};

/// Euclidean length of a column.
double length(std::span<const double> column) noexcept;

/// The upper triangle R of the QR decomposition of a tall matrix whose rows arrive in blocks (Householder, sequential TSQR:
/// J. Demmel et al., "Communication-optimal parallel and sequential QR and LU factorizations", SISC 34(1), 2012).
/// No normal equations are formed: nearly equal columns (s -> 0) and a residual far below the signal keep their digits.
class Triangle {
 public:
  explicit Triangle(std::size_t columns) : r_(columns, columns) {}
  /// Folds in the first `rows` rows of `block`, which has the triangle's number of columns and is overwritten.
  void add(Matrix& block, std::size_t rows);
  const Matrix& r() const { return r_; }

 private:
  Matrix r_;
};

/// min |R x - rhs|² over lower <= x <= upper, where some x may be held at a value. `square` is the least value.
struct Bounded {
  std::vector<double> x;
  double square = 0;
};

/// A small system: R has one column per unknown, `held[k]` is NaN where x_k is free.
struct SmallSystem {
  Matrix r;
  std::vector<double> rhs;
  std::vector<double> held;
  std::vector<double> lower = {}, upper = {};  ///< empty: 0 and no bound

  double low(std::size_t k) const { return lower.empty() ? 0 : lower[k]; }
  double high(std::size_t k) const { return upper.empty() ? std::numeric_limits<double>::infinity() : upper[k]; }
};

/// Exact, by branching: if the least squares on a set of unknowns leave their bounds, at least one of those that do lies at its violated
/// bound in the solution (else a step towards the least squares would stay within the bounds and lower the cost). Sets whose columns are
/// linearly dependent have a solution with one of them at a bound.
Bounded solve_bounded(const SmallSystem& system);

/// The range of x_k over all x within their bounds with |R x - rhs|² <= budget, by enumeration of the sets of unknowns at a bound. An end
/// at the bound of x_k is that bound; high infinity: nothing limits x_k.
struct Range {
  double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();
  bool empty() const noexcept { return low > high; }
};
Range range_of(const SmallSystem& system, std::size_t k, double budget);

}  // namespace gonio::fitting
