// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/checks/equality.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "fitting/distributions.hpp"

namespace gonio::fitting {
namespace {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

bool all_known(const EqualGroup& group) {
  return std::all_of(group.begin(), group.end(), [](const EqualMember& m) { return m.u > 0 && std::isfinite(m.u); });
}

/// Weights of a group: from a common variance where the members' differ little, because a u made from its own reading favours low
/// readings (numerics C13).
std::vector<double> weights_of(const EqualGroup& group) {
  double sum = 0, least = INFINITY, most = 0;
  for (const EqualMember& m : group) sum += m.u * m.u, least = std::min(least, m.u * m.u), most = std::max(most, m.u * m.u);
  std::vector<double> weights;
  for (const EqualMember& m : group) weights.push_back(most < 4 * least ? static_cast<double>(group.size()) / sum : 1 / (m.u * m.u));
  return weights;
}

Vector to_vector(const std::vector<double>& values) {
  return Eigen::Map<const Vector>(values.data(), static_cast<Eigen::Index>(values.size()));
}

/// One group with its mean taken out of everything.
struct Centred {
  std::vector<double> weight;
  double mean = 0, mean_variance = 0;
  std::vector<double> residual;
  std::vector<Vector> shared, pattern;
};

Centred centre(const EqualGroup& group) {
  Centred out;
  out.weight = weights_of(group);
  double total = 0;
  Vector shared = Vector::Zero(static_cast<Eigen::Index>(group[0].shared.size()));
  Vector pattern = Vector::Zero(static_cast<Eigen::Index>(group[0].pattern.size()));
  for (std::size_t k = 0; k < group.size(); ++k) {
    const double w = out.weight[k];
    total += w;
    out.mean += w * group[k].f;
    out.mean_variance += group[k].u * group[k].u / static_cast<double>(group.size());
    shared += w * to_vector(group[k].shared);
    pattern += w * to_vector(group[k].pattern);
  }
  out.mean /= total;
  for (const EqualMember& m : group) {
    out.residual.push_back(m.f - out.mean);
    out.shared.push_back(to_vector(m.shared) - shared / total);
    out.pattern.push_back(out.mean * (to_vector(m.pattern) - pattern / total));
  }
  return out;
}

/// Without uncertainties: the rms relative difference, noise and all.
EqualityTest effect_only(const std::vector<EqualGroup>& groups, double factor) {
  EqualityTest test;
  test.groups = groups.size();
  double square = 0, mean2 = 0;
  for (const EqualGroup& group : groups) {
    const auto n = static_cast<double>(group.size());
    double mean = 0;
    for (const EqualMember& m : group) mean += m.f / n;
    for (const EqualMember& m : group) square += (m.f - mean) * (m.f - mean) / (n - 1);
    mean2 += mean * mean;
    test.dof += n - 1;
  }
  if (mean2 > 0) test.effect = factor * std::sqrt(square / mean2);
  return test;
}

}  // namespace

EqualityTest test_equality(const std::vector<EqualGroup>& groups, double margin, double alpha, double factor) {
  std::vector<Centred> known;
  for (const EqualGroup& group : groups)
    if (group.size() > 1 && all_known(group)) known.push_back(centre(group));
  if (known.empty()) return effect_only(groups, factor);

  EqualityTest test;
  test.groups = known.size();
  test.has_uncertainty = true;
  const Eigen::Index components = known[0].shared[0].size(), patterns = known[0].pattern[0].size();
  Matrix gg = Matrix::Identity(components, components), pg = Matrix::Zero(patterns, components);
  Vector gr = Vector::Zero(components), pr = Vector::Zero(patterns), pp = Vector::Zero(patterns), pattern2 = Vector::Zero(patterns);
  double rr = 0, mean2 = 0;
  for (const Centred& group : known) {
    for (std::size_t k = 0; k < group.residual.size(); ++k) {
      const double w = group.weight[k], r = group.residual[k];
      rr += w * r * r;
      gr += w * r * group.shared[k];
      gg += w * group.shared[k] * group.shared[k].transpose();
      pr += w * r * group.pattern[k];
      pp += w * group.pattern[k].cwiseAbs2();
      pg += w * group.pattern[k] * group.shared[k].transpose();
      pattern2 += group.pattern[k].cwiseAbs2();
    }
    const auto members = static_cast<double>(group.residual.size());
    test.dof += members - 1;
    mean2 += (members - 1) * group.mean * group.mean;
  }
  const Eigen::LDLT<Matrix> solver(gg);
  const Vector amplitude = components > 0 ? Vector(solver.solve(gr)) : Vector();
  test.chi2 = rr - (components > 0 ? gr.dot(amplitude) : 0);
  const double p_chi2 = chi2_upper_tail(test.chi2, test.dof);
  double tests = 1, largest_z = 0, directed_amplitude = 0, directed_u = 0;
  for (Eigen::Index k = 0; k < patterns; ++k) {
    double numerator = pr[k], information = pp[k];
    if (components > 0) {
      const Vector row = pg.row(k).transpose();
      numerator -= row.dot(amplitude);
      information -= row.dot(Vector(solver.solve(row)));
    }
    if (!(information > 1e-9 * pp[k]) || !(pp[k] > 0)) continue;
    tests += 1;
    const double z = std::abs(numerator) / std::sqrt(information);
    if (z <= largest_z) continue;
    largest_z = z;
    test.strongest = static_cast<int>(k);
    directed_amplitude = std::abs(numerator) / information * std::sqrt(pattern2[k] / mean2);
    directed_u = std::sqrt(pattern2[k] / mean2 / information);
  }
  const double p_directed = 2 * normal_upper_tail(largest_z);
  test.p_value = std::min(1.0, tests * std::min(p_chi2, p_directed));
  if (p_directed * tests >= alpha) test.strongest = -1;

  // τ² by moments: E s² = v + τ² m² in every group.
  double weighted = 0, total = 0;
  std::vector<double> s2(known.size());
  const auto weight_of = [&](const Centred& group) {
    const double v = group.mean_variance + margin * margin * group.mean * group.mean;
    return static_cast<double>(group.residual.size() - 1) / (v * v);
  };
  for (std::size_t g = 0; g < known.size(); ++g) {
    const Centred& group = known[g];
    for (std::size_t k = 0; k < group.residual.size(); ++k) {
      const double r = group.residual[k] - (components > 0 ? group.shared[k].dot(amplitude) : 0);
      s2[g] += r * r / static_cast<double>(group.residual.size() - 1);
    }
    const double m2 = group.mean * group.mean, w = weight_of(group);
    weighted += w * m2 * (s2[g] - group.mean_variance);
    total += w * m2 * m2;
  }
  const double tau2 = total > 0 ? weighted / total : 0;
  double variance = 0;
  for (const Centred& group : known) {
    const double m2 = group.mean * group.mean, w = weight_of(group), v = group.mean_variance + std::max(0.0, tau2) * m2;
    variance += w * w * m2 * m2 * 2 * v * v / static_cast<double>(group.residual.size() - 1);
  }
  const double u_tau2 = total > 0 ? std::sqrt(variance) / total : INFINITY;
  test.effect = factor * std::sqrt(std::max(0.0, tau2));
  test.effect_upper = factor * std::sqrt(std::max(0.0, tau2 + normal_upper_quantile(alpha) * u_tau2));
  test.u_effect =
      test.effect > 0 ? std::min(factor * std::sqrt(u_tau2), factor * factor * u_tau2 / (2 * test.effect)) : factor * std::sqrt(u_tau2);
  if (test.strongest >= 0 && p_directed < p_chi2) {
    test.effect = factor * directed_amplitude;
    test.u_effect = factor * directed_u;
  }
  return test;
}

void judge_equality(Check& check, const EqualityTest& test, const CheckOptions& options) {
  check.n = test.groups;
  check.unit = "relative";
  check.threshold = options.margin;
  check.effect = test.effect;
  if (!test.has_uncertainty) {
    check.verdict = Verdict::vacuous;
    return;
  }
  check.statistic = test.chi2;
  check.p_value = test.p_value;
  check.u_effect = test.u_effect;
  check.effect_upper = test.dof >= enough_dof ? test.effect_upper : INFINITY;
  check.verdict = judge(test.p_value < options.alpha, test.effect, *check.effect_upper, options.margin);
}

}  // namespace gonio::fitting
