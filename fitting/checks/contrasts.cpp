// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/checks/contrasts.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_map>
#include <utility>

#include "fitting/distributions.hpp"

namespace gonio::fitting {
namespace {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

constexpr double seen = 1e-9;               // part of a pattern's information that must be left once the shared components are taken out
constexpr double most_understated = 3;      // nobody understates noise by more
constexpr double enough_to_see_shape = 50;  // degrees of freedom
constexpr double least_p = 1e-300;          // below that a quantile has no meaning

/// The contrasts with known variance.
struct Rows {
  std::vector<std::size_t> index;
  std::vector<double> variance;
};

Rows rows_of(const Contrasts& set) {
  Rows rows;
  for (std::size_t r = 0; r < set.contrasts.size(); ++r) {
    const Contrast& contrast = set.contrasts[r];
    double variance = contrast.u_interpolation * contrast.u_interpolation;
    for (const auto& [reading, weight] : contrast.terms) variance += weight * weight * set.readings[reading].u * set.readings[reading].u;
    if (!(variance > 0) || !std::isfinite(variance)) continue;
    rows.index.push_back(r);
    rows.variance.push_back(variance);
  }
  return rows;
}

double value_of(const Contrasts& set, const Contrast& contrast) {
  double c = 0;
  for (const auto& [reading, weight] : contrast.terms) c += weight * set.readings[reading].f;
  return c;
}

Matrix shared_of(const Contrasts& set, const Rows& rows, Eigen::Index components) {
  Matrix shared = Matrix::Zero(static_cast<Eigen::Index>(rows.index.size()), components);
  if (components == 0) return shared;
  for (std::size_t k = 0; k < rows.index.size(); ++k)
    for (const auto& [reading, weight] : set.contrasts[rows.index[k]].terms)
      shared.row(static_cast<Eigen::Index>(k)) +=
          weight * Eigen::Map<const Vector>(set.readings[reading].shared.data(), components).transpose();
  return shared;
}

/// Σ corr² over all pairs of rows: n if no two rows are correlated.
double squared_correlations(const Contrasts& set, const Rows& rows) {
  std::vector<std::vector<std::pair<std::size_t, double>>> users(set.readings.size());
  for (std::size_t k = 0; k < rows.index.size(); ++k)
    for (const auto& [reading, weight] : set.contrasts[rows.index[k]].terms) users[reading].emplace_back(k, weight);
  double sum = static_cast<double>(rows.index.size());
  std::unordered_map<std::size_t, double> covariance;
  for (std::size_t k = 0; k < rows.index.size(); ++k) {
    covariance.clear();
    for (const auto& [reading, weight] : set.contrasts[rows.index[k]].terms) {
      const double u2 = set.readings[reading].u * set.readings[reading].u;
      for (const auto& [other, other_weight] : users[reading])
        if (other != k) covariance[other] += weight * other_weight * u2;
    }
    for (const auto& [other, value] : covariance) sum += value * value / (rows.variance[k] * rows.variance[other]);
  }
  return sum;
}

/// Σ q_r (row r of the noise), squared and expected: the variance of a linear combination of contrasts.
double noise_variance(const Contrasts& set, const Rows& rows, const Vector& q) {
  std::vector<double> of_reading(set.readings.size(), 0.0);
  double variance = 0;
  for (std::size_t k = 0; k < rows.index.size(); ++k) {
    const Contrast& contrast = set.contrasts[rows.index[k]];
    const double factor = q[static_cast<Eigen::Index>(k)];
    variance += factor * factor * contrast.u_interpolation * contrast.u_interpolation;
    for (const auto& [reading, weight] : contrast.terms) of_reading[reading] += factor * weight;
  }
  for (std::size_t j = 0; j < of_reading.size(); ++j)
    if (of_reading[j] != 0) variance += of_reading[j] * of_reading[j] * set.readings[j].u * set.readings[j].u;
  return variance;
}

/// What the tests of one data set share.
struct Solved {
  const Vector &c, &weight;
  const Matrix &shared, &weighted;
  double scale2 = 0;
  const Eigen::LDLT<Matrix>& solver;
};

/// Every pattern with the shared components taken out of it, and the weighted Bonferroni combination of all tests.
void directed_tests(ContrastTest& test, const Contrasts& set, const Rows& rows, const Solved& solved, double alpha) {
  const auto n = static_cast<Eigen::Index>(rows.index.size());
  const bool any_shared = solved.shared.cols() > 0;
  double chi2_share = 1;
  for (const double share : set.pattern_share) chi2_share -= share;
  double used = chi2_share;
  std::vector<double> shares;
  for (std::size_t t = 0; t < set.pattern_names.size(); ++t) {
    Vector pattern(n);
    for (Eigen::Index k = 0; k < n; ++k) pattern[k] = set.contrasts[rows.index[static_cast<std::size_t>(k)]].pattern[t];
    const Vector raw = solved.weight.cwiseProduct(pattern);
    const Vector q = any_shared ? Vector(raw - solved.weighted * solved.solver.solve(solved.shared.transpose() * raw)) : raw;
    const double information = q.dot(pattern);
    if (!(information > seen * raw.dot(pattern))) continue;
    const double rms = std::sqrt(pattern.squaredNorm() / solved.scale2);
    const double u = std::sqrt(noise_variance(set, rows, q) + (any_shared ? (solved.shared.transpose() * q).squaredNorm() : 0));
    const double z = q.dot(solved.c) / u;
    test.directed.push_back({set.pattern_names[t], q.dot(solved.c) / information * rms, u / information * rms, z,
                             std::min(1.0, 2 * normal_upper_tail(std::abs(z)))});
    shares.push_back(set.pattern_share[t]);
    used += shares.back();
  }
  // The shares of patterns the data cannot see go to all the others.
  double least = 1;
  for (std::size_t t = 0; t < shares.size(); ++t) {
    const double p = test.directed[t].p_value * used / shares[t];
    if (p < least) least = p, test.strongest = static_cast<int>(t);
  }
  if (least >= alpha) test.strongest = -1;
  test.p_value = std::min({1.0, test.p_chi2 * used / chi2_share, least});
}

/// e² by moments: E c² = v + e² s², weighted as if e were the margin.
void relative_effect(ContrastTest& test, const Vector& residual, const Vector& weight, const Vector& scale2, double margin, double alpha) {
  double excess = 0, total = 0;
  for (Eigen::Index k = 0; k < residual.size(); ++k) {
    const double v = 1 / weight[k], s = scale2[k], w = 1 / std::pow(v + margin * margin * s, 2);
    excess += w * s * (residual[k] * residual[k] - v);
    total += w * s * s;
  }
  const double e2 = total > 0 ? excess / total : 0;
  double variance = 0;
  for (Eigen::Index k = 0; k < residual.size(); ++k) {
    const double v = 1 / weight[k], s = scale2[k], w = 1 / std::pow(v + margin * margin * s, 2), all = v + std::max(0.0, e2) * s;
    variance += w * w * s * s * 2 * all * all;
  }
  const double u_e2 = total > 0 ? std::sqrt(variance * test.dof / test.effective_dof) / total : INFINITY;
  test.effect = std::sqrt(std::max(0.0, e2));
  test.effect_upper = std::sqrt(std::max(0.0, e2 + normal_upper_quantile(alpha) * u_e2));
  test.u_effect = test.effect > 0 ? std::min(std::sqrt(u_e2), u_e2 / (2 * test.effect)) : std::sqrt(u_e2);
  if (test.strongest < 0) return;
  const DirectedTest& directed = test.directed[static_cast<std::size_t>(test.strongest)];
  if (directed.p_value >= test.p_chi2) return;
  test.effect = std::abs(directed.amplitude);
  test.u_effect = directed.u;
}

}  // namespace

ContrastTest test_contrasts(const Contrasts& set, double margin, double alpha) {
  ContrastTest test;
  test.n = set.contrasts.size();
  test.z.assign(set.contrasts.size(), std::nan(""));
  const Rows rows = rows_of(set);
  if (rows.index.empty()) return test;
  test.has_uncertainty = true;
  test.n = rows.index.size();
  const auto n = static_cast<Eigen::Index>(rows.index.size());
  const auto components = static_cast<Eigen::Index>(set.readings.empty() ? 0 : set.readings[0].shared.size());

  Vector c(n), weight(n), scale2(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const Contrast& contrast = set.contrasts[rows.index[static_cast<std::size_t>(k)]];
    c[k] = value_of(set, contrast);
    weight[k] = 1 / rows.variance[static_cast<std::size_t>(k)];
    scale2[k] = contrast.scale * contrast.scale;
  }
  // Shared components: posterior mean under the unit-normal prior.
  const Matrix shared = shared_of(set, rows, components);
  const Matrix weighted = weight.asDiagonal() * shared;
  const Eigen::LDLT<Matrix> solver(Matrix::Identity(components, components) + shared.transpose() * weighted);
  const Vector amplitude = components > 0 ? Vector(solver.solve(weighted.transpose() * c)) : Vector();
  if (components > 0) {
    const Matrix posterior = solver.solve(Matrix::Identity(components, components));
    for (Eigen::Index k = 0; k < components; ++k) {
      test.amplitude.push_back(amplitude[k]);
      test.u_amplitude.push_back(std::sqrt(posterior(k, k)));
    }
  }
  const Vector residual = components > 0 ? Vector(c - shared * amplitude) : c;
  test.chi2 = residual.dot(weight.asDiagonal() * residual) + amplitude.squaredNorm();
  test.dof = static_cast<double>(n);
  for (std::size_t k = test.amplitude.size() - set.free_components; k < test.amplitude.size(); ++k)
    test.dof -= std::max(0.0, 1 - test.u_amplitude[k] * test.u_amplitude[k]);
  test.effective_dof = test.dof * test.dof / squared_correlations(set, rows);
  test.p_chi2 = chi2_upper_tail(test.chi2 * test.effective_dof / test.dof, test.effective_dof);
  for (Eigen::Index k = 0; k < n; ++k) test.z[rows.index[static_cast<std::size_t>(k)]] = residual[k] * std::sqrt(weight[k]);

  directed_tests(test, set, rows, {c, weight, shared, weighted, scale2.sum(), solver}, alpha);
  relative_effect(test, residual, weight, scale2, margin, alpha);
  return test;
}

double understated_noise(const Contrasts& set, const ContrastTest& test, double alpha) {
  const double birge = test.dof > 0 ? std::sqrt(test.chi2 / test.dof) : 1;
  if (test.dof < enough_to_see_shape || birge <= 1 || birge > most_understated) return 1;
  for (const DirectedTest& directed : test.directed)
    if (2 * normal_upper_tail(std::abs(directed.z) / birge) * static_cast<double>(test.directed.size()) < alpha) return 1;
  // Normal shape: the kurtosis of a normal sample of n has the variance 24/n.
  double fourth = 0, n = 0;
  std::vector<std::pair<double, double>> by_mean;
  for (std::size_t r = 0; r < test.z.size(); ++r)
    if (std::isfinite(test.z[r])) {
      const double z = test.z[r] / birge;
      fourth += z * z * z * z, n += 1;
      by_mean.emplace_back(set.contrasts[r].mean, z * z);
    }
  const double q = normal_upper_quantile(alpha / 2);
  if (fourth / n - 3 > q * std::sqrt(24 / n)) return 1;
  // Even: the bright and the dark half have the same χ²/n.
  std::stable_sort(by_mean.begin(), by_mean.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  double dark = 0, bright = 0;
  for (std::size_t k = 0; k < by_mean.size(); ++k) (k < by_mean.size() / 2 ? dark : bright) += by_mean[k].second;
  return std::abs(bright - dark) / n > q * std::sqrt(2 / test.effective_dof) ? 1 : birge;
}

void judge_contrasts(Check& check, const ContrastTest& test, double margin, double alpha) {
  check.n = test.n;
  check.statistic = test.chi2;
  check.p_value = test.p_value;
  check.effect = test.effect;
  if (test.u_effect > 0) check.u_effect = test.u_effect;
  check.effect_upper = test.dof >= enough_dof ? test.effect_upper : INFINITY;
  check.directed = test.directed;
  check.verdict = judge(test.p_value < alpha, test.effect, *check.effect_upper, margin);
}

PlaceTests place_tests(const Contrasts& set, const ContrastTest& test, const std::vector<std::string>& channels) {
  struct Sum {
    double chi2 = 0, dof = 0, z = 0;
    double low = INFINITY, high = -INFINITY, first = 0, second = 0;
    std::size_t reading = 0;
  };
  std::map<std::pair<std::size_t, std::size_t>, Sum> sums;
  for (std::size_t r = 0; r < set.contrasts.size(); ++r) {
    const Contrast& contrast = set.contrasts[r];
    if (!std::isfinite(test.z[r])) continue;
    Sum& sum = sums[{contrast.place, set.readings[contrast.terms[0].reading].channel}];
    if (sum.dof == 0) sum.reading = contrast.terms[0].reading, sum.first = set.readings[sum.reading].f;
    sum.chi2 += test.z[r] * test.z[r], sum.dof += 1, sum.z = test.z[r];
    sum.second = sum.first - value_of(set, contrast);
    for (const auto& [reading, weight] : contrast.terms)
      sum.low = std::min(sum.low, set.readings[reading].f), sum.high = std::max(sum.high, set.readings[reading].f);
  }
  PlaceTests out;
  for (const auto& [key, sum] : sums) {
    Place place;
    place.angles = set.readings[sum.reading].angles;
    place.channel = channels[key.second];
    const bool pair = sum.dof == 1;
    const double p = chi2_upper_tail(sum.chi2, sum.dof);
    place.z = pair ? sum.z : normal_upper_quantile(std::max(p, least_p) / 2);
    const double above = pair ? sum.first : sum.high, below = pair ? sum.second : sum.low;
    if (below > 0) place.ratio = above / below;
    out.places.push_back(std::move(place));
    out.p.push_back(p);
  }
  return out;
}

}  // namespace gonio::fitting
