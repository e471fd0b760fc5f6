// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/covariance.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>

namespace gonio::fitting {
namespace {

constexpr double dependent = 1e-10;  // a singular value below this part of the largest determines nothing
constexpr double part_in_null_space = 0.1;

/// The joint Jacobian from the triangles of the channels, columns of unit length, zero columns left out; its decomposition.
struct Joint {
  std::vector<std::size_t> place;  ///< of every column
  Eigen::VectorXd length;
  Eigen::MatrixXd y;
  Eigen::JacobiSVD<Eigen::MatrixXd> svd;
  Eigen::Index rank = 0;

  Joint(const Linearisation& at, const ParameterPlaces& places, const SearchSpace& space) {
    std::size_t rows = 0, columns = 0;
    for (const auto& own : at.columns) rows += own.size() + at.free, columns += own.size();
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(columns + at.free));
    y = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(at.right));
    std::vector<std::size_t> all_places;
    Eigen::Index row = 0, column = 0;
    for (std::size_t c = 0; c < at.r.size(); ++c) {
      const std::size_t n = at.columns[c].size();
      for (std::size_t i = 0; i < n + at.free; ++i) {
        const Eigen::Index to = row + static_cast<Eigen::Index>(i);
        for (std::size_t k = 0; k < n; ++k) all(to, column + static_cast<Eigen::Index>(k)) = at.r[c](i, k);
        for (std::size_t a = 0; a < at.free; ++a) all(to, static_cast<Eigen::Index>(columns + a)) = at.r[c](i, n + a);
        for (std::size_t k = 0; k < at.right; ++k) y(to, static_cast<Eigen::Index>(k)) = at.r[c](i, n + at.free + k);
      }
      for (const std::size_t k : at.columns[c]) all_places.push_back(places.of_linear(c, k));
      row += static_cast<Eigen::Index>(n + at.free), column += static_cast<Eigen::Index>(n);
    }
    for (const SearchAxis& axis : space.axes()) all_places.push_back(places.of_nonlinear(axis.parameter));
    Eigen::MatrixXd scaled(all.rows(), all.cols());
    Eigen::Index used = 0;
    length.resize(all.cols());
    for (Eigen::Index k = 0; k < all.cols(); ++k) {
      const double norm = all.col(k).norm();
      if (!(norm > 0) || !std::isfinite(norm)) continue;
      length[used] = norm;
      scaled.col(used++) = all.col(k) / norm;
      place.push_back(all_places[static_cast<std::size_t>(k)]);
    }
    if (used == 0) return;
    svd.compute(scaled.leftCols(used), Eigen::ComputeThinU | Eigen::ComputeThinV);
    const auto& values = svd.singularValues();
    while (rank < values.size() && values[rank] > dependent * values[0]) ++rank;
  }

  bool determined(Eigen::Index column) const {
    const Eigen::Index count = static_cast<Eigen::Index>(place.size());
    // With fewer rows than columns the null space has no vectors in the thin factor: what the others leave of a unit vector.
    const double in_range = svd.matrixV().row(column).head(rank).squaredNorm();
    return column < count && 1 - in_range <= part_in_null_space * part_in_null_space;
  }
};

}  // namespace

Matrix covariance(const Linearisation& at, const ParameterPlaces& places, const SearchSpace& space, double scale) {
  const Joint joint(at, places, space);
  Matrix out(places.size(), places.size(), std::numeric_limits<double>::quiet_NaN());
  const auto count = static_cast<Eigen::Index>(joint.place.size());
  for (Eigen::Index a = 0; a < count; ++a)
    for (Eigen::Index b = 0; b < count; ++b) {
      if (!joint.determined(a) || !joint.determined(b)) continue;
      double sum = 0;
      for (Eigen::Index i = 0; i < joint.rank; ++i) {
        const double value = joint.svd.singularValues()[i];
        sum += joint.svd.matrixV()(a, i) * joint.svd.matrixV()(b, i) / (value * value);
      }
      out(joint.place[static_cast<std::size_t>(a)], joint.place[static_cast<std::size_t>(b)]) =
          scale * sum / (joint.length[a] * joint.length[b]);
    }
  return out;
}

std::optional<double> variance_of(const Linearisation& at, const ParameterPlaces& places, const SearchSpace& space, double scale,
                                  const std::vector<double>& gradient) {
  const Joint joint(at, places, space);
  Eigen::VectorXd scaled(static_cast<Eigen::Index>(joint.place.size()));
  std::size_t touched = 0;
  for (Eigen::Index a = 0; a < scaled.size(); ++a) {
    const double slope = gradient[joint.place[static_cast<std::size_t>(a)]];
    scaled[a] = slope / joint.length[a];
    touched += slope != 0;
  }
  const auto all = gradient.size() - static_cast<std::size_t>(std::count(gradient.begin(), gradient.end(), 0.0));
  if (touched == 0 || touched < all) return std::nullopt;
  double in_range = 0, variance = 0;
  for (Eigen::Index i = 0; i < joint.rank; ++i) {
    const double part = joint.svd.matrixV().col(i).dot(scaled), value = joint.svd.singularValues()[i];
    in_range += part * part;
    variance += part * part / (value * value);
  }
  if (scaled.squaredNorm() - in_range > part_in_null_space * part_in_null_space * scaled.squaredNorm()) return std::nullopt;
  return scale * variance;
}

std::vector<std::vector<double>> responses(const Linearisation& at, const ParameterPlaces& places, const SearchSpace& space) {
  const Joint joint(at, places, space);
  std::vector<std::vector<double>> out(at.right, std::vector<double>(places.size(), 0.0));
  const auto count = static_cast<Eigen::Index>(joint.place.size());
  for (std::size_t k = 0; k < at.right; ++k)
    for (Eigen::Index a = 0; a < count; ++a) {
      if (!joint.determined(a)) continue;
      double sum = 0;
      for (Eigen::Index i = 0; i < joint.rank; ++i)
        sum += joint.svd.matrixV()(a, i) * joint.svd.matrixU().col(i).dot(joint.y.col(static_cast<Eigen::Index>(k))) /
               joint.svd.singularValues()[i];
      out[k][joint.place[static_cast<std::size_t>(a)]] = sum / joint.length[a];
    }
  return out;
}

}  // namespace gonio::fitting
