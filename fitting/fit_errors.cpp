// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/fit_errors.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "fitting/threads.hpp"
#include "fitting/transform.hpp"

namespace gonio::fitting {
namespace {

constexpr std::size_t exact_up_to = std::size_t{1} << 18;
constexpr std::size_t estimated_from = std::size_t{1} << 15;
constexpr std::array metrics{Metric::linear, Metric::linear_cos, Metric::log, Metric::log1p, Metric::cbrt};

struct Sums {
  std::array<double, metrics.size()> square{}, count{};
};

Sums block_sums(const Observations& observations, std::size_t index, std::size_t stride, const ModelKernel& kernel,
                const std::vector<std::vector<double>>& values) {
  const ObservationBlock block = observations.block(index);
  std::vector<LobeGeometry> geometry;
  std::vector<std::size_t> samples;
  for (std::size_t k = index % stride; k < block.size; k += stride)
    if (block.valid(k)) samples.push_back(k);
  observations.geometry_of(index, samples, geometry);
  std::vector<double> columns(kernel.linear * geometry.size());
  Sums sums;
  for (std::size_t c = 0; c < values.size(); ++c) {
    const auto nonlinear = std::span(values[c]).subspan(kernel.linear);
    if (c == 0 || !std::ranges::equal(nonlinear, std::span(values[c - 1]).subspan(kernel.linear)))
      kernel.basis(geometry, nonlinear.data(), columns.data(), geometry.size());
    for (std::size_t j = 0; j < samples.size(); ++j) {
      const double f = block.f[c][samples[j]], cos_i = geometry[j].cos_i;
      if (!std::isfinite(f) || cos_i < 0 || geometry[j].cos_o < 0) continue;
      double fitted = 0;
      for (std::size_t k = 0; k < kernel.linear; ++k) fitted += values[c][k] * columns[k * geometry.size() + j];
      for (std::size_t m = 0; m < metrics.size(); ++m) {
        const Transform transform{metrics[m]};
        if (!transform.defined(f, cos_i) || !transform.defined(fitted, cos_i)) continue;
        double residual = transform.value(fitted, cos_i) - transform.value(f, cos_i);
        if (metrics[m] == Metric::linear_cos) residual *= cos_i;
        sums.square[m] += residual * residual;
        sums.count[m] += 1;
      }
    }
  }
  return sums;
}

}  // namespace

FitErrors fit_errors(const Observations& observations, const ModelKernel& kernel, const std::vector<std::vector<double>>& values,
                     int threads) {
  const std::size_t blocks = observations.block_count();
  std::size_t samples = 0;
  for (std::size_t b = 0; b < blocks; ++b) samples += observations.block(b).size;
  const std::size_t stride = samples <= exact_up_to ? 1 : (samples + estimated_from - 1) / estimated_from;
  std::vector<Sums> parts(blocks);
  for_each_index(blocks, threads, [&](std::size_t b) { parts[b] = block_sums(observations, b, stride, kernel, values); });
  Sums total;
  for (const Sums& part : parts)
    for (std::size_t m = 0; m < metrics.size(); ++m) total.square[m] += part.square[m], total.count[m] += part.count[m];
  const auto rms = [&](std::size_t m) { return total.count[m] > 0 ? std::sqrt(total.square[m] / total.count[m]) : 0.0; };
  return {rms(0), rms(1), rms(2), rms(3), rms(4), std::nullopt};
}

double rms_of_rows(const Terms& terms, const std::vector<std::vector<double>>& values) {
  const std::size_t linear = terms.kernel.linear;
  double squares = 0, count = 0;
  std::vector<double> columns(linear * terms.rows());
  for (std::size_t c = 0; c < terms.channel.size(); ++c) {
    const ChannelTerms& data = terms.channel[c];
    terms.basis(0, terms.rows(), values[c].data() + linear, columns.data(), terms.rows());
    for (std::size_t row = 0; row < terms.rows(); ++row) {
      double fitted = 0;
      for (std::size_t k = 0; k < linear; ++k) fitted += values[c][k] * columns[k * terms.rows() + row];
      if (!(data.weight[row] > 0)) continue;
      const double residual = terms.transform.value(fitted, terms.geometry[row].cos_i) - data.target[row];
      squares += data.weight[row] * residual * residual;
    }
    squares += data.within;
    count += static_cast<double>(data.count);
  }
  return count > 0 ? std::sqrt(squares / count) : 0.0;
}

}  // namespace gonio::fitting
