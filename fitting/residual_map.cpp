// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/residual_map.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "fitting/model_kernel.hpp"
#include "fitting/threads.hpp"

namespace gonio::fitting {
namespace {

constexpr std::size_t exact_up_to = std::size_t{1} << 18;
constexpr std::size_t estimated_from = std::size_t{1} << 15;

struct Sums {
  double count = 0, sum = 0, square = 0;
};
using CellSums = std::vector<std::vector<Sums>>;  // [channel][cell]

std::size_t step_of(Angle theta) {
  const double step = std::abs(theta.degrees()) / ResidualMap::step_deg;
  return std::min(ResidualMap::steps - 1, static_cast<std::size_t>(step));
}

class BlockResiduals {
 public:
  BlockResiduals(const Observations& observations, const FitResult& result)
      : observations_(observations), result_(result), kernel_(model_kernel(result.model)) {
    for (const Outlier& outlier : result.weighting.outliers) left_out_.insert({outlier.sample, outlier.channel});
  }

  CellSums operator()(std::size_t index, std::size_t first_sample, std::size_t stride) const {
    const ObservationBlock block = observations_.block(index);
    std::vector<LobeGeometry> geometry;
    std::vector<GonioAngles> angles;
    std::vector<std::size_t> samples;
    for (std::size_t k = index % stride; k < block.size; k += stride)
      if (block.valid(k)) samples.push_back(k);
    observations_.geometry_of(index, samples, geometry);
    observations_.angles(index, angles);
    const std::size_t rows = samples.size(), linear = kernel_.linear;
    CellSums out(result_.values.size(), std::vector<Sums>(ResidualMap::steps * ResidualMap::steps));
    std::vector<double> columns(linear * rows);
    for (std::size_t c = 0; c < out.size(); ++c) {
      const std::vector<double>& values = result_.values[c];
      kernel_.basis(geometry, values.data() + linear, columns.data(), rows);
      for (std::size_t j = 0; j < rows; ++j) {
        const LobeGeometry& g = geometry[j];
        const double f = block.f[c][samples[j]];
        if (!std::isfinite(f) || g.cos_i < 0 || g.cos_o < 0 || left_out_.contains({first_sample + samples[j], c})) continue;
        double fitted = 0;
        for (std::size_t k = 0; k < linear; ++k) fitted += values[k] * columns[k * rows + j];
        const double sigma = deviation(block, c, samples[j], fitted, g.cos_i);
        if (!(sigma > 0) || !std::isfinite(sigma)) continue;
        const double z = (f - fitted) / sigma;
        Sums& cell = out[c][step_of(angles[samples[j]].theta_i) * ResidualMap::steps + step_of(angles[samples[j]].theta_o)];
        cell.count += 1, cell.sum += z, cell.square += z * z;
      }
    }
    return out;
  }

 private:
  /// 1 where nothing is known: the map is scaled afterwards.
  double deviation(const ObservationBlock& block, std::size_t c, std::size_t k, double fitted, double cos_i) const {
    if (result_.weighting.source == WeightSource::uncertainty) return block.u[c][k];
    if (result_.weighting.variance.empty()) return 1;
    return std::sqrt(result_.weighting.variance[c](fitted, tan_squared(cos_i)));
  }

  const Observations& observations_;
  const FitResult& result_;
  ModelKernel kernel_;
  std::set<std::pair<std::size_t, std::size_t>> left_out_;
};

}  // namespace

ResidualMap residual_map(const Observations& observations, const FitResult& result, int threads) {
  ResidualMap map;
  if (result.values.empty()) return map;
  const std::size_t blocks = observations.block_count();
  std::vector<std::size_t> first(blocks + 1, 0);
  for (std::size_t b = 0; b < blocks; ++b) first[b + 1] = first[b] + observations.block(b).size;
  const std::size_t samples = first.back(), stride = samples <= exact_up_to ? 1 : (samples + estimated_from - 1) / estimated_from;
  const BlockResiduals residuals(observations, result);
  std::vector<CellSums> parts(blocks);
  for_each_index(blocks, threads, [&](std::size_t b) { parts[b] = residuals(b, first[b], stride); });

  const bool scaled = result.weighting.source == WeightSource::uncertainty || !result.weighting.variance.empty();
  double looked_at = 0;
  for (std::size_t c = 0; c < result.values.size(); ++c) {
    std::vector<Sums> sums(ResidualMap::steps * ResidualMap::steps);
    Sums all;
    for (const CellSums& part : parts)
      for (std::size_t k = 0; k < sums.size(); ++k) {
        sums[k].count += part[c][k].count, sums[k].sum += part[c][k].sum, sums[k].square += part[c][k].square;
        all.count += part[c][k].count, all.square += part[c][k].square;
      }
    looked_at = std::max(looked_at, all.count);
    const double scale = scaled || !(all.square > 0) ? 1 : std::sqrt(all.square / all.count);
    std::vector<ResidualCell> cells;
    for (const Sums& cell : sums)
      cells.push_back(cell.count > 0 ? ResidualCell{static_cast<std::size_t>(cell.count), cell.sum / cell.count / scale,
                                                    std::sqrt(cell.square / cell.count) / scale}
                                     : ResidualCell{});
    map.channel.push_back(std::move(cells));
  }
  map.n_observations = static_cast<std::size_t>(looked_at);
  return map;
}

}  // namespace gonio::fitting
