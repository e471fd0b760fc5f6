// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/linear_part.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <optional>

namespace gonio::fitting {
namespace {

/// Columns whose part orthogonal to the others is below this part of their length are dependent: the rounding of the rows themselves.
constexpr double rank_tolerance = 1e-13;

/// A sum of squares below this has lost digits to the denormal numbers: a reflection by it would not keep lengths. Lobes far from their
/// peak are so small, and of no account there.
constexpr double least_square = 1e-280;

/// Systems of at most max_linear unknowns live on the stack.
constexpr int most = static_cast<int>(max_linear);
using Dense = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most, most>;
using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most, 1>;

/// Where the unknowns are: a value for those held or at a bound, NaN for those that are free to move.
using Places = std::array<double, max_linear>;

struct Subset {
  std::vector<std::size_t> columns;  ///< the free ones
  Vector x;                          ///< least squares on the subset
  Dense covariance;                  ///< (RᵀR)⁻¹ of the subset
  double square = 0;
};

auto column_of(const Matrix& matrix, std::size_t k) {
  return Eigen::Map<const Eigen::VectorXd>(matrix.column(k).data(), static_cast<Eigen::Index>(matrix.rows()));
}

/// Least squares on the free unknowns; none if their columns are dependent.
std::optional<Subset> solve_subset(const SmallSystem& system, const Places& places, bool with_covariance) {
  Subset subset;
  Vector rhs = Eigen::Map<const Eigen::VectorXd>(system.rhs.data(), static_cast<Eigen::Index>(system.rhs.size()));
  for (std::size_t k = 0; k < system.r.columns(); ++k) {
    if (std::isnan(places[k]))
      subset.columns.push_back(k);
    else if (places[k] != 0)
      rhs -= column_of(system.r, k) * places[k];
  }
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
  if (with_covariance) {
    const Dense upper = qr.matrixR().topLeftCorner(n, n);
    const Dense inverse = upper.triangularView<Eigen::Upper>().solve(Dense::Identity(n, n));
    const Dense permuted = qr.colsPermutation() * inverse;
    const Dense unscaled = lengths.cwiseInverse().asDiagonal() * permuted;
    subset.covariance = unscaled * unscaled.transpose();
  }
  return subset;
}

Places places_of(const SmallSystem& system) {
  Places places;
  places.fill(std::numeric_limits<double>::quiet_NaN());
  std::copy(system.held.begin(), system.held.end(), places.begin());
  return places;
}

/// The best solution so far and the sets it has been looked for in.
struct Search {
  const SmallSystem& system;
  Bounded best{{}, std::numeric_limits<double>::infinity()};
  std::vector<Places> seen;

  void visit(const Places& places) {
    const auto same = [&](const Places& other) { return std::memcmp(other.data(), places.data(), sizeof places) == 0; };
    if (std::any_of(seen.begin(), seen.end(), same)) return;
    const auto subset = solve_subset(system, places, false);
    if (subset && !(subset->square < best.square)) return;
    bool feasible = subset.has_value();
    const auto pin = [&](std::size_t k, double value) {
      Places next = places;
      next[k] = value;
      visit(next);
    };
    if (!subset) {
      seen.push_back(places);
      for (std::size_t k = 0; k < system.r.columns(); ++k) {
        if (!std::isnan(places[k])) continue;
        pin(k, system.low(k));
        if (std::isfinite(system.high(k))) pin(k, system.high(k));
      }
      return;
    }
    for (std::size_t j = 0; j < subset->columns.size(); ++j) {
      const std::size_t k = subset->columns[j];
      const double x = subset->x[static_cast<Eigen::Index>(j)];
      if (x >= system.low(k) && x <= system.high(k)) continue;
      if (feasible) seen.push_back(places);
      feasible = false;
      pin(k, x < system.low(k) ? system.low(k) : system.high(k));
    }
    if (!feasible) return;
    best.square = subset->square;
    best.x.assign(places.begin(), places.begin() + static_cast<std::ptrdiff_t>(system.r.columns()));
    for (std::size_t j = 0; j < subset->columns.size(); ++j) best.x[subset->columns[j]] = subset->x[static_cast<Eigen::Index>(j)];
  }
};

/// Calls `use` for every choice of free unknowns and of bounds for the others.
template <class Use>
void for_each_choice(const SmallSystem& system, std::size_t from, Places& places, Use&& use) {
  while (from < system.r.columns() && !std::isnan(places[from])) ++from;
  if (from == system.r.columns()) {
    use(places);
    return;
  }
  const double free = places[from];
  for_each_choice(system, from + 1, places, use);
  for (const double bound : {system.low(from), system.high(from)})
    if (std::isfinite(bound)) {
      places[from] = bound;
      for_each_choice(system, from + 1, places, use);
    }
  places[from] = free;
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
    if (!(below > least_square)) continue;
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

Bounded solve_bounded(const SmallSystem& system) {
  Search search{system, {{}, std::numeric_limits<double>::infinity()}, {}};
  search.visit(places_of(system));
  return search.best;
}

Range range_of(const SmallSystem& system, std::size_t k, double budget) {
  Range range;
  const auto include = [&](double value) {
    range.low = std::min(range.low, value);
    range.high = std::max(range.high, value);
  };
  const auto feasible = [&](const Subset& subset, const Vector& x) {
    for (std::size_t j = 0; j < subset.columns.size(); ++j) {
      const double value = x[static_cast<Eigen::Index>(j)];
      if (!(value >= system.low(subset.columns[j]) && value <= system.high(subset.columns[j]))) return false;
    }
    return true;
  };
  const auto look = [&](const Places& places) {
    const auto subset = solve_subset(system, places, true);
    if (!subset || subset->square > budget) return;
    if (!std::isnan(places[k])) {
      if (feasible(*subset, subset->x)) include(places[k]);
      return;
    }
    Eigen::Index at = 0;
    while (subset->columns[static_cast<std::size_t>(at)] != k) ++at;
    const double variance = subset->covariance(at, at);
    const double reach = std::sqrt((budget - subset->square) * variance);
    // The other unknowns of the set move along with x_k; where one of them would leave its bounds a smaller set has the end.
    for (const double side : {-1.0, 1.0}) {
      const Vector end = subset->x + subset->covariance.col(at) * (side * reach / variance);
      if (feasible(*subset, end)) include(end[at]);
    }
  };
  Places places = places_of(system);
  for_each_choice(system, 0, places, look);
  // A column that no sample sees limits nothing.
  if (!range.empty() && !(length(system.r.column(k)) > 0)) range = {system.low(k), system.high(k)};
  return range;
}

}  // namespace gonio::fitting
