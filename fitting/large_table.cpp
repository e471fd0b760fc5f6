// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/large_table.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "fitting/point_fit.hpp"
#include "fitting/threads.hpp"

namespace gonio::fitting {
namespace {

constexpr std::size_t many_samples = 200'000;  // fewer go through the rows in the time that the table takes to make
constexpr std::size_t rows_kept = 32'768;      // of the sample: its sigmas are good to half a percent
constexpr std::size_t rows_of_search = 32'768;
constexpr std::size_t rows_of_part = 2'048;  // a variance to two percent

std::size_t stride_for(std::size_t rows, std::size_t wanted) { return std::max<std::size_t>(1, (rows + wanted - 1) / wanted); }

bool plain(const Observations& observations) {
  if (!observations.correlated().empty()) return false;
  std::size_t samples = 0;
  for (std::size_t b = 0; b < observations.block_count(); ++b) {
    const ObservationBlock block = observations.block(b);
    if (!block.u.empty()) return false;
    samples += block.size;
  }
  return samples >= many_samples;
}

/// Some samples of the table as rows. With `for_all` they stand for all of it.
Terms rows_of(const Observations& observations, const ModelKernel& kernel, const FacetTable& table, const FacetTable& some, bool for_all,
              int threads) {
  Terms terms;
  terms.kernel = kernel;
  terms.transform = {Metric::linear};
  terms.channel.resize(table.channels());
  terms.n_observations = table.rows();
  terms.not_fitted = table.not_fitted();
  std::vector<std::vector<LobeGeometry>> geometry(observations.block_count());
  for_each_index(geometry.size(), threads, [&](std::size_t b) {
    const std::vector<std::size_t> samples(some.samples(b).begin(), some.samples(b).end());
    if (!samples.empty()) observations.geometry_of(b, samples, geometry[b]);
  });
  terms.geometry.reserve(some.rows());
  std::size_t first = 0;
  for (std::size_t b = 0; b < geometry.size(); ++b) {
    const std::vector<std::uint32_t>& samples = some.samples(b);
    terms.geometry.insert(terms.geometry.end(), geometry[b].begin(), geometry[b].end());
    for (const std::size_t sample : samples) terms.sample.push_back(first + sample);
    const double stands_for =
        for_all && !samples.empty() ? static_cast<double>(table.samples(b).size()) / static_cast<double>(samples.size()) : 1;
    if (for_all) terms.represents.insert(terms.represents.end(), samples.size(), stands_for);
    for (std::size_t c = 0; c < terms.channel.size(); ++c) {
      ChannelTerms& channel = terms.channel[c];
      for (const float f : some.values(b, c)) {
        channel.target.push_back(f);
        channel.value.push_back(f);
        channel.weight.push_back(stands_for);
      }
    }
    first += observations.block(b).size;
  }
  for (ChannelTerms& channel : terms.channel) channel.count = for_all ? table.rows() : terms.rows();
  return terms;
}

}  // namespace

std::vector<Matrix> FacetSums::triangles(double alpha, int threads) const { return triangles_of_sums(table_->sums(alpha, threads)); }

std::shared_ptr<RowSums> FacetSums::few(int threads) const {
  return std::make_shared<FacetSums>(
      std::make_shared<const FacetTable>(table_->every(stride_for(table_->rows(), rows_of_search), threads)));
}

void LargeTable::weigh(const std::vector<VarianceModel>& variance, const std::vector<std::vector<double>>& linear,
                       const std::vector<double>& theta, int threads) {
  table->weigh(variance, linear, theta.front(), threads);
  const auto fitted = fitted_values(terms, linear, theta);
  for (std::size_t c = 0; c < terms.channel.size(); ++c) {
    ChannelTerms& channel = terms.channel[c];
    for (std::size_t row = 0; row < terms.rows(); ++row) {
      const double sigma2 = variance[c](fitted[c][row], tan_squared(terms.geometry[row].cos_i));
      channel.weight[row] = sigma2 > 0 ? channel.weight[row] / sigma2 : 0;
    }
    channel.weighted_value2 =
        part.channel[c].weighted_value2 * static_cast<double>(channel.count) / static_cast<double>(part.channel[c].count);
  }
}

std::optional<LargeTable> large_table(const Observations& observations, const ModelKernel& kernel, Metric metric, int threads) {
  if (metric != Metric::linear || !plain(observations)) return std::nullopt;
  LargeTable out;
  out.table = FacetTable::of(observations, kernel, threads);
  if (!out.table || out.table->rows() < many_samples) return std::nullopt;
  const FacetTable& table = *out.table;
  out.terms = rows_of(observations, kernel, table, table.every(stride_for(table.rows(), rows_kept), threads), true, threads);
  out.part = rows_of(observations, kernel, table, table.every(stride_for(table.rows(), rows_of_part), threads), false, threads);
  out.terms.sums = std::make_shared<FacetSums>(out.table);
  return out;
}

}  // namespace gonio::fitting
