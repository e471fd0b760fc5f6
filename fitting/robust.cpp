// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/robust.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "fitting/distributions.hpp"
#include "fitting/variance_model.hpp"

namespace gonio::fitting {
namespace {

constexpr double huber_k = 1.345, cauchy_k = 2.385;
constexpr double false_alarm = 1e-3;  // of a whole data set: clean data keep every sample
constexpr double normal_median_deviation = 0.6744897501960817;
constexpr double truncation = 2;  // of the scale estimate
constexpr int most_rounds = 30;
constexpr double settled = 1e-8;           // of location and scale, in scales
constexpr double judges_slack = 1.5;       // the median deviation of 129 values is uncertain by 11 %, four of those
constexpr std::size_t fewest_values = 10;  // below it nothing can be told apart

constexpr std::array<std::pair<Robust, const char*>, 4> robust_names{
    {{Robust::automatic, "auto"}, {Robust::none, "none"}, {Robust::huber, "huber"}, {Robust::cauchy, "cauchy"}}};

struct Spread {
  double centre, scale;
};

Spread median_and_deviation(std::span<const double> values, std::vector<double>& scratch) {
  scratch.assign(values.begin(), values.end());
  const double centre = median_of(scratch);
  for (std::size_t k = 0; k < values.size(); ++k) scratch[k] = std::abs(values[k] - centre);
  return {centre, median_of(scratch) / normal_median_deviation};
}

/// Location and scale with residuals cut at `truncation` scales.
Spread proposal_2(std::span<const double> values, Spread at) {
  const double moment = truncated_second_moment(truncation);
  for (int round = 0; round < most_rounds && at.scale > 0; ++round) {
    double shift = 0, square = 0, inside = 0;
    for (const double value : values) {
      const double z = (value - at.centre) / at.scale, cut = std::clamp(z, -truncation, truncation);
      shift += cut, square += cut * cut, inside += z == cut;
    }
    if (!(inside > 0)) break;
    const double move = shift / inside, growth = std::sqrt(square / (moment * static_cast<double>(values.size())));
    at.centre += move * at.scale;
    at.scale *= growth;
    if (std::abs(move) < settled && std::abs(growth - 1) < settled) break;
  }
  return at;
}

}  // namespace

const char* name(Robust robust) noexcept {
  for (const auto& [value, text] : robust_names)
    if (value == robust) return text;
  return "none";
}

std::optional<Robust> robust_named(std::string_view text) {
  for (const auto& [value, known] : robust_names)
    if (text == known) return value;
  return std::nullopt;
}

double loss_weight(Robust loss, double z) noexcept {
  const double size = std::abs(z);
  switch (loss) {
    case Robust::huber: return size <= huber_k ? 1 : huber_k / size;
    case Robust::cauchy: return 1 / (1 + (size / cauchy_k) * (size / cauchy_k));
    default: return 1;
  }
}

double outlier_limit(std::size_t n) noexcept {
  return normal_upper_quantile(false_alarm / (2 * static_cast<double>(std::max<std::size_t>(1, n))));
}

double outlier_limit(std::size_t n, double dof) noexcept {
  const double z = outlier_limit(n) * (8 * dof + 3) / (8 * dof + 1);
  return std::sqrt(dof * std::expm1(z * z / dof));
}

double median_of(std::span<double> values) noexcept {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

bool in_runs(std::span<const std::size_t> samples) noexcept {
  std::size_t beside = 0;
  for (std::size_t k = 0; k < samples.size(); ++k)
    beside += (k > 0 && samples[k] - samples[k - 1] == 1) || (k + 1 < samples.size() && samples[k + 1] - samples[k] == 1);
  return 2 * beside > samples.size();
}

CleanRange clean_range(std::span<double> some, std::size_t n) noexcept { return clean_range_within(some, outlier_limit(n)); }

CleanRange clean_range_within(std::span<double> some, double limit) noexcept {
  if (some.size() < fewest_values) return {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  const double centre = median_of(some);
  for (double& value : some) value = std::abs(value - centre);
  const double reach = judges_slack * limit * median_of(some) / normal_median_deviation;
  return {centre - reach, centre + reach};
}

RobustMean robust_mean(std::span<const double> values, Robust loss, std::vector<double>& scratch) {
  return robust_mean_within(values, loss, outlier_limit(values.size()), scratch);
}

RobustMean robust_mean_within(std::span<const double> values, Robust loss, double limit, std::vector<double>& scratch) {
  RobustMean out;
  Spread at{0, 0};
  if (loss != Robust::none && values.size() >= fewest_values) at = proposal_2(values, median_and_deviation(values, scratch));
  if (at.scale > 0)
    for (std::size_t k = 0; k < values.size(); ++k)
      if (std::abs(values[k] - at.centre) > limit * at.scale) out.outliers.push_back(k);
  const bool reject = loss == Robust::automatic && !in_runs(out.outliers);
  if (loss == Robust::automatic && !reject) out.outliers.clear();
  out.scale = at.scale;

  double weight = 0, sum = 0;
  const auto weight_of = [&](double value) {
    if (!(at.scale > 0)) return 1.0;
    const double z = (value - at.centre) / at.scale;
    return reject && std::abs(z) > limit ? 0.0 : loss_weight(loss, z);
  };
  for (const double value : values) {
    const double w = weight_of(value);
    weight += w, sum += w * (value - at.centre), out.count += w > 0;
  }
  if (!(weight > 0)) return out;
  out.mean = at.centre + sum / weight;
  double influence = 0, slope = 0;  // Σ ψ², Σ ψ': the variance of an M-estimate is their ratio Σψ²/(Σψ')² (Huber 1964)
  for (const double value : values) {
    const double w = weight_of(value), deviation = value - out.mean;
    influence += w * w * deviation * deviation;
    if (loss == Robust::huber)
      slope += w >= 1;
    else if (loss == Robust::cauchy)
      slope += w * (2 * w - 1);
    else
      slope += w;
  }
  const double n = static_cast<double>(out.count);
  if (n > 1 && slope > 0) out.within = influence * (n / slope) * (n / slope) * (n > 1 ? (n - 1) / n : 0);
  if (loss == Robust::automatic || loss == Robust::none) out.within = influence;
  return out;
}

}  // namespace gonio::fitting
