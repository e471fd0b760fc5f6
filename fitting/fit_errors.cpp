// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/fit_errors.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <set>
#include <utility>

#include "fitting/fitted_samples.hpp"
#include "fitting/threads.hpp"
#include "fitting/transform.hpp"

namespace gonio::fitting {
namespace {

constexpr std::array metrics{Metric::linear, Metric::linear_cos, Metric::log, Metric::log1p, Metric::cbrt};

/// The residual of a metric, or NaN where it has none.
double residual(Metric metric, double f, double fitted, double cos_i) {
  const Transform transform{metric};
  if (!transform.defined(f, cos_i) || !transform.defined(fitted, cos_i)) return std::nan("");
  return (transform.value(f, cos_i) - transform.value(fitted, cos_i)) * (metric == Metric::linear_cos ? cos_i : 1);
}

struct BlockResiduals {
  std::array<double, metrics.size()> square{}, count{};
  std::vector<std::vector<CellResidual>> cell;  ///< [channel]
};

class Residuals {
 public:
  Residuals(const FitResult& result, const Observations& observations, const ModelKernel& kernel, const std::vector<MeanRows>& means)
      : result_(result), observations_(observations), samples_(observations, kernel, result.values, means) {
    for (const Outlier& outlier : result.weighting.outliers) left_out_.insert({outlier.sample, outlier.channel});
  }

  BlockResiduals block(std::size_t index) const {
    const ObservationBlock data = observations_.block(index);
    const FittedBlock of = samples_.block(index);
    BlockResiduals out;
    std::vector<std::uint16_t> cell;
    for (const LobeGeometry& geometry : of.geometry) cell.push_back(residual_cell(geometry));
    for (std::size_t c = 0; c < of.fitted.size(); ++c) {
      std::vector<CellResidual>& cells = out.cell.emplace_back();
      for (std::size_t j = 0; j < of.sample.size(); ++j) {
        const double f = data.f[c][of.sample[j]], fitted = of.fitted[c][j], cos_i = of.geometry[j].cos_i;
        if (!std::isfinite(f)) continue;
        for (std::size_t m = 0; m < metrics.size(); ++m) {
          const double r = residual(metrics[m], f, fitted, cos_i);
          if (!std::isnan(r)) out.square[m] += r * r, out.count[m] += 1;
        }
        const double z = standardised(data, c, of.sample[j], f, fitted, cos_i);
        if (!std::isfinite(z) || left_out_.contains({of.first + of.sample[j], c})) continue;
        cells.push_back({cell[j], static_cast<float>(z)});
      }
    }
    return out;
  }

  bool sigma_known() const { return from_uncertainty() || !result_.weighting.variance.empty(); }

 private:
  bool from_uncertainty() const { return result_.weighting.source == WeightSource::uncertainty; }

  double standardised(const ObservationBlock& data, std::size_t c, std::size_t k, double f, double fitted, double cos_i) const {
    if (from_uncertainty()) return (f - fitted) / data.u[c][k];
    if (result_.weighting.variance.empty()) return residual(result_.metric, f, fitted, cos_i);
    return (f - fitted) / std::sqrt(result_.weighting.variance[c](fitted, tan_squared(cos_i)));
  }

  const FitResult& result_;
  const Observations& observations_;
  FittedSamples samples_;
  std::set<std::pair<std::size_t, std::size_t>> left_out_;
};

/// Divides by the root mean square of all.
void scale(std::vector<CellResidual>& residuals) {
  double square = 0;
  for (const CellResidual& r : residuals) square += static_cast<double>(r.z) * static_cast<double>(r.z);
  if (!(square > 0)) return;
  const auto rms = static_cast<float>(std::sqrt(square / static_cast<double>(residuals.size())));
  for (CellResidual& r : residuals) r.z /= rms;
}

}  // namespace

void add_residuals(FitResult& result, const Observations& observations, const ModelKernel& kernel, const std::vector<MeanRows>& means,
                   int threads) {
  const Residuals residuals(result, observations, kernel, means);
  std::vector<BlockResiduals> parts(observations.block_count());
  for_each_index(parts.size(), threads, [&](std::size_t b) { parts[b] = residuals.block(b); });

  std::array<double, metrics.size()> rms{};
  for (std::size_t m = 0; m < metrics.size(); ++m) {
    double square = 0, count = 0;
    for (const BlockResiduals& part : parts) square += part.square[m], count += part.count[m];
    rms[m] = count > 0 ? std::sqrt(square / count) : 0.0;
  }
  result.errors = {rms[0], rms[1], rms[2], rms[3], rms[4], result.errors.chi2_per_dof};

  ResidualMap map;
  map.sigma_known = residuals.sigma_known();
  const bool unlisted = result.weighting.n_outliers > result.weighting.outliers.size();
  for (std::size_t c = 0; c < result.values.size(); ++c) {
    std::vector<CellResidual> all;
    for (const BlockResiduals& part : parts) all.insert(all.end(), part.cell[c].begin(), part.cell[c].end());
    if (!map.sigma_known) scale(all);
    map.channel.push_back(unlisted ? clean_residual_cells(all) : residual_cells(all));
    map.n_samples = std::max(map.n_samples, all.size());
  }
  result.residuals = std::move(map);
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
