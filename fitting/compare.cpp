// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/compare.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "fitting/distributions.hpp"
#include "fitting/fit.hpp"
#include "fitting/transform.hpp"

namespace gonio::fitting {
namespace {

constexpr std::array metrics{Metric::linear, Metric::linear_cos, Metric::log, Metric::log1p, Metric::cbrt};
constexpr std::size_t ngan = metrics.size();

/// Weighted sums of squares of residuals and of A itself, by metric.
struct Sums {
  struct Entry {
    double residual = 0, reference = 0, weight = 0;
    std::size_t n = 0;
    void add(double w, double difference, double a) {
      residual += w * difference * difference;
      reference += w * a * a;
      weight += w;
      ++n;
    }
  };
  std::array<Entry, metrics.size() + 1> entries;

  void merge(const Sums& other) {
    for (std::size_t m = 0; m < entries.size(); ++m) {
      entries[m].residual += other.entries[m].residual, entries[m].reference += other.entries[m].reference;
      entries[m].weight += other.entries[m].weight, entries[m].n += other.entries[m].n;
    }
  }
};

bool known(const ComparedValues& values, std::size_t c, std::size_t k) {
  return std::isfinite(values.a.f[c][k]) && std::isfinite(values.b.f[c][k]);
}

/// The measure Ngan's metric gives a direction; 0 beyond 80°.
double ngan_weight(const ComparedValues& values, std::size_t k) {
  constexpr double slack_deg = 1e-9;  // 80° that came from radians
  const GonioAngles& angles = values.angles[k];
  if (angles.theta_i.degrees() > compared_up_to_deg + slack_deg || angles.theta_o.degrees() > compared_up_to_deg + slack_deg) return 0;
  return values.at == ComparedAt::quadrature ? values.weight[k] : angles.theta_i.sin() * angles.theta_o.sin();
}

Sums sums_of(const ComparedValues& values, std::size_t c) {
  Sums out;
  for (std::size_t k = 0; k < values.angles.size(); ++k) {
    if (!known(values, c, k)) continue;
    const double a = values.a.f[c][k], b = values.b.f[c][k], cos_i = values.angles[k].theta_i.cos();
    for (std::size_t m = 0; m < metrics.size(); ++m) {
      const Transform transform{metrics[m]};
      if (!transform.defined(a, cos_i) || !transform.defined(b, cos_i)) continue;
      const double cosine = metrics[m] == Metric::linear_cos ? cos_i : 1;
      const double at_a = cosine * transform.value(a, cos_i);
      out.entries[m].add(values.weight[k], cosine * transform.value(b, cos_i) - at_a, at_a);
    }
    if (const double w = ngan_weight(values, k); w > 0) out.entries[ngan].add(w, (b - a) * cos_i, a * cos_i);
  }
  return out;
}

void append(std::vector<MetricError>& out, const Sums& sums, std::optional<std::size_t> channel) {
  for (std::size_t m = 0; m < sums.entries.size(); ++m) {
    const Sums::Entry& sum = sums.entries[m];
    MetricError error{m == ngan ? "ngan" : name(metrics[m]), channel, {}, {}, sum.n};
    if (sum.weight > 0) error.absolute = std::sqrt(sum.residual / sum.weight);
    if (sum.reference > 0 && !(m < ngan && metrics[m] == Metric::log)) error.relative = std::sqrt(sum.residual / sum.reference);
    out.push_back(std::move(error));
  }
}

/// Groups of directions with the same incidence, or of the same 10° where there are many.
std::map<double, std::vector<std::size_t>> by_incidence(const ComparedValues& values) {
  constexpr std::size_t most_incidences = 24;
  constexpr double same_deg = 0.01, band_deg = 10;
  std::map<double, std::vector<std::size_t>> out;
  for (std::size_t k = 0; k < values.angles.size() && values.at != ComparedAt::quadrature && out.size() <= most_incidences; ++k)
    out[same_deg * std::round(values.angles[k].theta_i.degrees() / same_deg)].push_back(k);
  if (!out.empty() && out.size() <= most_incidences) return out;
  out.clear();
  for (std::size_t k = 0; k < values.angles.size(); ++k)
    out[band_deg * (std::floor(std::min(values.angles[k].theta_i.degrees(), 89.0) / band_deg) + 0.5)].push_back(k);
  return out;
}

IncidenceDifference difference_at(const ComparedValues& values, double theta_i_deg, const std::vector<std::size_t>& directions) {
  IncidenceDifference out;
  out.theta_i_deg = theta_i_deg;
  Sums::Entry sum;
  double difference = 0, reference = 0;
  for (std::size_t c = 0; c < values.channels.size(); ++c)
    for (const std::size_t k : directions) {
      if (!known(values, c, k)) continue;
      const double a = values.a.f[c][k], b = values.b.f[c][k], cos_i = values.angles[k].theta_i.cos(), w = values.weight[k];
      sum.add(w, (b - a) * cos_i, a * cos_i);
      difference += w * (b - a);
      reference += w * a;
      out.largest_relative = std::max(out.largest_relative, std::fabs(relative_difference(a, b)));
    }
  out.n = sum.n;
  if (sum.weight > 0) out.absolute = std::sqrt(sum.residual / sum.weight);
  if (sum.reference > 0) out.relative = std::sqrt(sum.residual / sum.reference);
  if (reference > 0) out.bias = difference / reference;
  return out;
}

void find_largest(const ComparedValues& values, Comparison& out) {
  for (std::size_t c = 0; c < values.channels.size(); ++c)
    for (std::size_t k = 0; k < values.angles.size(); ++k) {
      if (!known(values, c, k)) {
        ++out.n_unknown;
        continue;
      }
      ++out.n;
      const double a = values.a.f[c][k], b = values.b.f[c][k];
      if (a <= 0 || b <= 0) ++out.n_not_positive;
      const auto keep = [&](std::optional<LargestDifference>& largest, double difference) {
        if (!largest || std::fabs(difference) > std::fabs(largest->difference))
          largest = LargestDifference{values.angles[k], c, a, b, difference};
      };
      keep(out.largest_absolute, b - a);
      keep(out.largest_relative, relative_difference(a, b));
    }
}

/// χ² = dᵀ (D + V Vᵀ)⁻¹ d = dᵀ D⁻¹ d - gᵀ (1 + M)⁻¹ g with g = Vᵀ D⁻¹ d, M = Vᵀ D⁻¹ V (Woodbury 1950).
std::optional<ChiSquare> chi_square_of(const ComparedValues& values) {
  const bool a_known = !values.a.u.empty(), b_known = !values.b.u.empty();
  const bool both_measured = values.at == ComparedAt::common_directions;
  if (values.at == ComparedAt::quadrature || values.other_is_samples || (both_measured ? !(a_known && b_known) : !(a_known || b_known)))
    return std::nullopt;
  const std::size_t from_a = values.a.shared.size(), components = from_a + values.b.shared.size();
  const auto size = static_cast<Eigen::Index>(components);
  Eigen::VectorXd g = Eigen::VectorXd::Zero(size), v(size);
  Eigen::MatrixXd m = Eigen::MatrixXd::Zero(size, size);
  ChiSquare out;
  double sum = 0;
  for (std::size_t c = 0; c < values.channels.size(); ++c)
    for (std::size_t k = 0; k < values.angles.size(); ++k) {
      if (!known(values, c, k)) continue;
      const double u_a = a_known ? values.a.u[c][k] : 0, u_b = b_known ? values.b.u[c][k] : 0;
      const double variance = u_a * u_a + u_b * u_b, d = values.b.f[c][k] - values.a.f[c][k];
      if (!(variance > 0)) continue;
      for (std::size_t j = 0; j < components; ++j)
        v[static_cast<Eigen::Index>(j)] = j < from_a ? values.a.shared[j][c][k] : values.b.shared[j - from_a][c][k];
      sum += d * d / variance;
      g += d / variance * v;
      m += v * v.transpose() / variance;
      ++out.n;
    }
  if (out.n == 0) return std::nullopt;
  const Eigen::MatrixXd inner = Eigen::MatrixXd::Identity(size, size) + m;
  const double correlated = components == 0 ? sum : std::max(0.0, sum - g.dot(inner.ldlt().solve(g)));
  const auto n = static_cast<double>(out.n);
  out.independent_per_n = sum / n;
  out.correlated_per_n = correlated / n;
  out.p_value = chi2_upper_tail(correlated, n);
  out.uncertainty_of = both_measured ? "both" : a_known ? "a" : "b";
  return out;
}

}  // namespace

double relative_difference(double a, double b) noexcept {
  const double sum = std::fabs(a) + std::fabs(b);
  return sum > 0 ? 2 * (b - a) / sum : 0;
}

Comparison compare(const ComparedValues& values) {
  Comparison out;
  find_largest(values, out);
  Sums all;
  std::vector<Sums> sums;
  for (std::size_t c = 0; c < values.channels.size(); ++c) {
    sums.push_back(sums_of(values, c));
    all.merge(sums.back());
  }
  append(out.metrics, all, std::nullopt);
  if (sums.size() > 1)
    for (std::size_t c = 0; c < sums.size(); ++c) append(out.metrics, sums[c], c);
  for (const auto& [theta_i_deg, directions] : by_incidence(values))
    out.incidences.push_back(difference_at(values, theta_i_deg, directions));
  out.chi_square = chi_square_of(values);
  return out;
}

}  // namespace gonio::fitting
