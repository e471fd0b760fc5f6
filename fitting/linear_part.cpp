// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/linear_part.hpp"

#include <Eigen/QR>
#include <cmath>
#include <optional>

namespace gonio::fitting {
namespace {

/// Columns whose part orthogonal to the others is below this part of their length are dependent: the rounding of the rows themselves.
constexpr double rank_tolerance = 1e-13;

/// Systems of at most max_linear unknowns live on the stack.
constexpr int most = static_cast<int>(max_linear);
using Dense = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most, most>;
using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most, 1>;

struct Subset {
  std::vector<std::size_t> columns;
  Vector x;          ///< least squares on the subset
  Dense covariance;  ///< (RᵀR)⁻¹ of the subset
  double square = 0;

  bool feasible() const { return columns.empty() || x.minCoeff() >= 0; }
};

auto column_of(const Matrix& matrix, std::size_t k) {
  return Eigen::Map<const Eigen::VectorXd>(matrix.column(k).data(), static_cast<Eigen::Index>(matrix.rows()));
}

Vector remaining_rhs(const SmallSystem& system) {
  Vector rhs = Eigen::Map<const Eigen::VectorXd>(system.rhs.data(), static_cast<Eigen::Index>(system.rhs.size()));
  for (std::size_t k = 0; k < system.held.size(); ++k)
    if (!std::isnan(system.held[k])) rhs -= column_of(system.r, k) * system.held[k];
  return rhs;
}

/// Least squares on the columns of a bit mask; none if they are dependent.
std::optional<Subset> solve_subset(const SmallSystem& system, const Vector& rhs, unsigned mask) {
  Subset subset;
  for (std::size_t k = 0; k < system.r.columns(); ++k)
    if (mask & (1u << k)) subset.columns.push_back(k);
  const auto n = static_cast<Eigen::Index>(subset.columns.size());
  if (n == 0) {
    subset.square = rhs.squaredNorm();
    return subset;
  }
  Dense a(rhs.size(), n);
  Vector lengths(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const auto column = column_of(system.r, subset.columns[static_cast<std::size_t>(k)]);
    lengths[k] = column.norm();
    if (!(lengths[k] > 0)) return std::nullopt;
    a.col(k) = column / lengths[k];
  }
  Eigen::ColPivHouseholderQR<Dense> qr(a);
  qr.setThreshold(rank_tolerance);
  if (qr.rank() < n) return std::nullopt;
  const Vector scaled = qr.solve(rhs);
  subset.square = (rhs - a * scaled).squaredNorm();
  subset.x = scaled.cwiseQuotient(lengths);
  const Dense upper = qr.matrixR().topLeftCorner(n, n);
  const Dense inverse = upper.triangularView<Eigen::Upper>().solve(Dense::Identity(n, n));
  const Dense permuted = qr.colsPermutation() * inverse;
  const Dense unscaled = lengths.cwiseInverse().asDiagonal() * permuted;
  subset.covariance = unscaled * unscaled.transpose();
  return subset;
}

unsigned free_mask(const SmallSystem& system) {
  unsigned mask = 0;
  for (std::size_t k = 0; k < system.held.size(); ++k)
    if (std::isnan(system.held[k])) mask |= 1u << k;
  return mask;
}

}  // namespace

Matrix Matrix::top_left(std::size_t rows, std::size_t columns) const {
  Matrix out(rows, columns);
  for (std::size_t c = 0; c < columns; ++c)
    for (std::size_t r = 0; r < rows; ++r) out(r, c) = (*this)(r, c);
  return out;
}

double length(std::span<const double> column) noexcept {
  return Eigen::Map<const Eigen::VectorXd>(column.data(), static_cast<Eigen::Index>(column.size())).norm();
}

void Triangle::add(Matrix& block, std::size_t rows) {
  const auto column = [&](std::size_t k) { return Eigen::Map<Eigen::VectorXd>(block.column(k).data(), static_cast<Eigen::Index>(rows)); };
  const std::size_t n = r_.columns();
  for (std::size_t j = 0; j < n; ++j) {
    const double below = column(j).squaredNorm();
    if (!(below > 0)) continue;
    const double alpha = r_(j, j);
    const double beta = std::copysign(std::sqrt(alpha * alpha + below), -alpha);
    const double head = alpha - beta, tau = -head / beta;
    for (std::size_t l = j + 1; l < n; ++l) {
      const double w = tau * (r_(j, l) + column(j).dot(column(l)) / head);
      r_(j, l) -= w;
      column(l) -= (w / head) * column(j);
    }
    r_(j, j) = beta;
  }
}

NonNegative solve_non_negative(const SmallSystem& system) {
  const Vector rhs = remaining_rhs(system);
  NonNegative best;
  best.square = std::numeric_limits<double>::infinity();
  const unsigned all = free_mask(system);
  for (unsigned mask = all;; mask = (mask - 1) & all) {
    const auto subset = solve_subset(system, rhs, mask);
    if (subset && subset->square < best.square && subset->feasible()) {
      best.square = subset->square;
      best.x.assign(system.r.columns(), 0.0);
      for (std::size_t k = 0; k < subset->columns.size(); ++k) best.x[subset->columns[k]] = subset->x[static_cast<Eigen::Index>(k)];
      for (std::size_t k = 0; k < system.held.size(); ++k)
        if (!std::isnan(system.held[k])) best.x[k] = system.held[k];
    }
    if (mask == 0) break;
  }
  return best;
}

Range range_of(const SmallSystem& system, std::size_t k, double budget) {
  const Vector rhs = remaining_rhs(system);
  Range range;
  const auto include = [&](double value) {
    range.low = std::min(range.low, value);
    range.high = std::max(range.high, value);
  };
  const unsigned all = free_mask(system), own = 1u << k;
  for (unsigned mask = all;; mask = (mask - 1) & all) {
    const auto subset = solve_subset(system, rhs, mask);
    if (subset && subset->square <= budget) {
      if (!(mask & own)) {
        if (subset->feasible()) include(0);
      } else {
        Eigen::Index at = 0;
        while (subset->columns[static_cast<std::size_t>(at)] != k) ++at;
        const double variance = subset->covariance(at, at);
        const double reach = std::sqrt((budget - subset->square) * variance);
        // The other unknowns of the set move along with x_k; where one of them would turn negative a smaller set has the end.
        for (const double side : {-1.0, 1.0}) {
          const Vector end = subset->x + subset->covariance.col(at) * (side * reach / variance);
          if (end.minCoeff() >= 0) include(end[at]);
        }
      }
    }
    if (mask == 0) break;
  }
  // A column that no sample sees limits nothing.
  if (!range.empty() && !(length(system.r.column(k)) > 0)) range = {0, std::numeric_limits<double>::infinity()};
  return range;
}

}  // namespace gonio::fitting
