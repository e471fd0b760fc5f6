// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/prediction.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fitting/repeats.hpp"
#include "fitting/transform.hpp"

namespace gonio::fitting {
namespace {

constexpr std::size_t least_repeats = 10;

bool known(double u) { return u > 0 && std::isfinite(u); }

double weight_of(Metric metric, double cos_i) { return metric == Metric::linear_cos ? cos_i : 1; }

/// f of every sample in one channel.
std::vector<double> predicted(const Samples& samples, const ModelInfo& model, const std::vector<double>& values) {
  std::vector<double> columns(model.linear_count * samples.size()), out(samples.size());
  model.basis(samples.geometry, values.data() + model.linear_count, columns.data(), samples.size());
  for (std::size_t k = 0; k < model.linear_count; ++k)
    for (std::size_t j = 0; j < out.size(); ++j) out[j] += values[k] * columns[k * out.size() + j];
  return out;
}

bool carries_uncertainty(const Samples& samples) {
  if (samples.u.empty()) return false;
  for (std::size_t c = 0; c < samples.f.size(); ++c) {
    std::size_t values = 0, with_u = 0;
    for (std::size_t k = 0; k < samples.size(); ++k) {
      if (!std::isfinite(samples.f[c][k])) continue;
      ++values;
      with_u += known(samples.u[c][k]);
    }
    if (with_u == 0 || 2 * with_u < values) return false;
  }
  return true;
}

NoiseLevel over_norm(NoiseLevel::Source source, double noise2_cos, double noise2_cbrt, double count, const Samples& samples) {
  double norm2_cos = 0, norm2_cbrt = 0, values = 0;
  for (const auto& column : samples.f)
    for (std::size_t k = 0; k < samples.size(); ++k) {
      if (!std::isfinite(column[k])) continue;
      norm2_cos += std::pow(column[k] * samples.geometry[k].cos_i, 2);
      norm2_cbrt += std::pow(std::cbrt(column[k]), 2);
      values += 1;
    }
  const auto relative = [&](double noise2, double norm2) { return norm2 > 0 ? std::sqrt(noise2 / count * values / norm2) : 0; };
  return {source, relative(noise2_cos, norm2_cos), relative(noise2_cbrt, norm2_cbrt)};
}

}  // namespace

Samples gather(const Observations& observations, const std::vector<std::uint8_t>& keep, const std::vector<std::uint8_t>& group) {
  Samples out;
  const std::size_t channels = observations.channels().size();
  out.f.resize(channels);
  bool has_u = true;
  for (std::size_t b = 0; b < observations.block_count(); ++b) has_u = has_u && observations.block(b).u.size() == channels;
  if (has_u) out.u.resize(channels);
  std::vector<LobeGeometry> geometry;
  std::vector<std::size_t> kept;
  std::size_t first = 0;
  for (std::size_t b = 0; b < observations.block_count(); ++b) {
    const ObservationBlock block = observations.block(b);
    kept.clear();
    for (std::size_t k = 0; k < block.size; ++k)
      if (keep[first + k] && block.valid(k)) kept.push_back(k);
    if (!kept.empty()) observations.geometry_of(b, kept, geometry);
    for (std::size_t j = 0; j < kept.size(); ++j) {
      const std::size_t k = kept[j];
      const bool measured = std::any_of(block.f.begin(), block.f.end(), [&](const Column& f) { return std::isfinite(f[k]); });
      if (!measured || geometry[j].cos_i < 0 || geometry[j].cos_o < 0) continue;
      out.geometry.push_back(geometry[j]);
      out.group.push_back(group[first + k]);
      out.number.push_back(first + k);
      for (std::size_t c = 0; c < channels; ++c) {
        out.f[c].push_back(block.f[c][k]);
        if (has_u) out.u[c].push_back(block.u[c][k]);
      }
    }
    first += block.size;
  }
  return out;
}

PredictionSums& PredictionSums::operator+=(const PredictionSums& other) {
  for (std::size_t m = 0; m < every_metric.size(); ++m) {
    square[m] += other.square[m];
    reference[m] += other.reference[m];
    count[m] += other.count[m];
    undefined[m] = undefined[m] || other.undefined[m];
  }
  return *this;
}

std::optional<double> PredictionSums::error(Metric metric) const {
  const auto m = static_cast<std::size_t>(std::find(every_metric.begin(), every_metric.end(), metric) - every_metric.begin());
  if (undefined[m] || !(count[m] > 0)) return std::nullopt;
  return std::sqrt(square[m] / count[m]);
}

std::optional<double> PredictionSums::relative_error(Metric metric) const {
  const auto m = static_cast<std::size_t>(std::find(every_metric.begin(), every_metric.end(), metric) - every_metric.begin());
  if (undefined[m] || !(reference[m] > 0)) return std::nullopt;
  return std::sqrt(square[m] / reference[m]);
}

PredictionSums prediction_sums(const Samples& samples, const ModelInfo& model, const std::vector<std::vector<double>>& values,
                               std::optional<std::uint8_t> group) {
  PredictionSums out;
  for (std::size_t c = 0; c < values.size(); ++c) {
    const std::vector<double> fitted = predicted(samples, model, values[c]);
    for (std::size_t k = 0; k < samples.size(); ++k) {
      const double f = samples.f[c][k], cos_i = samples.geometry[k].cos_i;
      if ((group && samples.group[k] != *group) || !std::isfinite(f)) continue;
      for (std::size_t m = 0; m < every_metric.size(); ++m) {
        const Transform transform{every_metric[m]};
        if (!transform.defined(f, cos_i)) continue;
        if (!std::isfinite(fitted[k]) || !transform.defined(fitted[k], cos_i)) {
          out.undefined[m] = true;
          continue;
        }
        const double weight = weight_of(every_metric[m], cos_i), target = transform.value(f, cos_i);
        out.square[m] += std::pow(weight * (transform.value(fitted[k], cos_i) - target), 2);
        out.reference[m] += std::pow(weight * target, 2);
        out.count[m] += 1;
      }
    }
  }
  return out;
}

Likelihood likelihood(const Samples& samples, const ModelInfo& model, const std::vector<std::vector<double>>& values, Metric metric) {
  const Transform transform{metric};
  Likelihood out;
  out.weighted = carries_uncertainty(samples);
  double squares = 0;
  for (std::size_t c = 0; c < values.size(); ++c) {
    const std::vector<double> fitted = predicted(samples, model, values[c]);
    for (std::size_t k = 0; k < samples.size(); ++k) {
      const double f = samples.f[c][k], cos_i = samples.geometry[k].cos_i;
      if (!std::isfinite(f) || !transform.defined(f, cos_i) || !transform.defined(fitted[k], cos_i)) continue;
      if (out.weighted && !known(samples.u[c][k])) continue;
      const double unit = out.weighted ? samples.u[c][k] * transform.slope(f, cos_i) : 1 / weight_of(metric, cos_i);
      const double r = (transform.value(fitted[k], cos_i) - transform.value(f, cos_i)) / unit;
      if (!std::isfinite(r)) continue;
      squares += r * r;
      ++out.n;
    }
  }
  const auto n = static_cast<double>(out.n);
  out.minus_two_log = out.weighted ? squares : n * std::log(std::max(squares / n, std::numeric_limits<double>::min()));
  return out;
}

NoiseLevel noise_level(const Observations& observations, const Samples& samples) {
  double noise2_cos = 0, noise2_cbrt = 0, count = 0;
  if (carries_uncertainty(samples)) {
    for (std::size_t c = 0; c < samples.f.size(); ++c)
      for (std::size_t k = 0; k < samples.size(); ++k) {
        const double f = samples.f[c][k], u = samples.u[c][k];
        if (!std::isfinite(f) || !known(u)) continue;
        noise2_cos += std::pow(u * samples.geometry[k].cos_i, 2);
        noise2_cbrt += std::pow((std::cbrt(f + u) - std::cbrt(f - u)) / 2, 2);
        count += 1;
      }
    return over_norm(NoiseLevel::Source::stated, noise2_cos, noise2_cbrt, count, samples);
  }
  // Centred squares inside groups of equal directions; a group of n has n - 1 degrees of freedom.
  for (const RepeatedReadings& numbers : repeated_readings(observations))
    for (const auto& column : samples.f) {
      double n = 0, mean_cos = 0, mean_cbrt = 0;
      const auto add = [&](double value, double& mean, double& squares) {
        const double from_old = value - mean;
        mean += from_old / n;
        squares += from_old * (value - mean);
      };
      for (const std::size_t number : numbers) {
        const auto found = std::lower_bound(samples.number.begin(), samples.number.end(), number);
        if (found == samples.number.end() || *found != number) continue;
        const auto k = static_cast<std::size_t>(found - samples.number.begin());
        if (!std::isfinite(column[k])) continue;
        n += 1;
        add(column[k] * samples.geometry[k].cos_i, mean_cos, noise2_cos);
        add(std::cbrt(column[k]), mean_cbrt, noise2_cbrt);
      }
      count += std::max(0.0, n - 1);
    }
  if (count < static_cast<double>(least_repeats)) return {};
  return over_norm(NoiseLevel::Source::repeats, noise2_cos, noise2_cbrt, count, samples);
}

}  // namespace gonio::fitting
