// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/terms.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <optional>
#include <span>

#include <fmt/format.h>

#include "fitting/collapse.hpp"
#include "fitting/scrambled.hpp"
#include "fitting/solid_angles.hpp"
#include "fitting/threads.hpp"

namespace gonio::fitting {
namespace {

/// The data carry u if every channel has it for at least this part of its values.
constexpr double enough_known = 0.5;

bool known(double u) { return u > 0 && std::isfinite(u); }

bool carries_uncertainty(const Observations& observations) {
  std::vector<std::size_t> values(observations.channels().size()), with_u(values.size());
  for (std::size_t b = 0; b < observations.block_count(); ++b) {
    const ObservationBlock block = observations.block(b);
    if (block.u.size() != values.size()) return false;
    for (std::size_t k = 0; k < block.size; ++k) {
      if (!block.valid(k)) continue;
      for (std::size_t c = 0; c < values.size(); ++c) {
        if (!std::isfinite(block.f[c][k])) continue;
        ++values[c];
        with_u[c] += known(block.u[c][k]);
      }
    }
  }
  for (std::size_t c = 0; c < values.size(); ++c)
    if (with_u[c] == 0 || static_cast<double>(with_u[c]) < enough_known * static_cast<double>(values[c])) return false;
  return true;
}

/// Whether every block may become one row: θh constant (or of no interest), and nothing that differs from sample to sample needed later.
bool can_collapse(const Observations& observations, const ModelKernel& kernel, Metric metric) {
  if (metric == Metric::log1p) return false;
  if (kernel.info->depends_on != DependsOn::theta_h && kernel.info->depends_on != DependsOn::nothing) return false;
  for (const CorrelatedComponent& component : observations.correlated())
    if (!component.sensitivity.empty()) return false;
  for (std::size_t b = 0; b < observations.block_count(); ++b)
    if (observations.block(b).constant != ConstantOver::theta_h) return false;
  return observations.block_count() > 0;
}

void append(Terms& to, const Terms& part) {
  const auto extend = [](auto& all, const auto& more) { all.insert(all.end(), more.begin(), more.end()); };
  extend(to.geometry, part.geometry);
  extend(to.sample, part.sample);
  for (std::size_t c = 0; c < to.channel.size(); ++c) {
    ChannelTerms& all = to.channel[c];
    const ChannelTerms& more = part.channel[c];
    extend(all.target, more.target);
    extend(all.weight, more.weight);
    extend(all.value, more.value);
    extend(all.u2, more.u2);
    extend(all.read_variance, more.read_variance);
    extend(all.row_within, more.row_within);
    extend(all.row_count, more.row_count);
    all.within += more.within;
    all.weighted_value2 += more.weighted_value2;
    all.count += more.count;
  }
  extend(to.outliers, part.outliers);
  to.n_observations += part.n_observations;
  to.not_fitted += part.not_fitted;
}

Terms collapsed_block(const Observations& observations, std::size_t index, std::size_t first_sample, Transform transform, bool weighted,
                      Robust robust, std::span<const double> weights) {
  Terms out;
  CollapsedBlock sums = collapse(observations, index, transform, weighted, robust, weights);
  LobeGeometry geometry;
  geometry.log_cos_h = observations.block(index).log_cos_h;
  out.geometry.push_back(geometry);
  for (const BlockSums& sum : sums.channel) {
    ChannelTerms terms;
    terms.target = {sum.mean};
    terms.weight = {sum.weight};
    terms.within = sum.within;
    terms.row_within = {sum.within};
    terms.row_count = {sum.count};
    terms.weighted_value2 = sum.weighted_value2;
    terms.count = sum.count;
    out.channel.push_back(std::move(terms));
  }
  out.outliers = std::move(sums.outliers);
  for (Outlier& outlier : out.outliers) outlier.sample += first_sample;
  out.n_observations = sums.used;
  out.not_fitted = sums.not_fitted;
  return out;
}

/// Whether sample number `n` of a block counts, if one of every `one_of` does: at a pseudo-random place among them.
bool chosen(std::size_t block, std::size_t n, std::size_t one_of) {
  if (one_of == 1) return true;
  return n % one_of == scrambled(block * Observations::max_block + n / one_of) % one_of;
}

std::size_t valid_count(const Observations& observations, int threads) {
  std::vector<std::size_t> counts(observations.block_count());
  for_each_index(counts.size(), threads, [&](std::size_t b) {
    const ObservationBlock block = observations.block(b);
    for (std::size_t k = 0; k < block.size; ++k) counts[b] += block.valid(k);
  });
  return std::accumulate(counts.begin(), counts.end(), std::size_t{0});
}

Terms block_rows(const Observations& observations, std::size_t index, std::size_t first_sample, Transform transform, bool weighted,
                 std::span<const double> weights, std::size_t one_of) {
  Terms out;
  const ObservationBlock block = observations.block(index);
  const std::size_t channels = block.f.size();
  out.channel.resize(channels);
  std::vector<LobeGeometry> geometry;
  observations.geometry(index, geometry);
  const std::size_t most = block.size / one_of + 1;
  out.geometry.reserve(most), out.sample.reserve(most);
  for (ChannelTerms& terms : out.channel) terms.target.reserve(most), terms.weight.reserve(most), terms.value.reserve(most);
  std::size_t seen = 0;
  for (std::size_t k = 0; k < block.size; ++k) {
    const LobeGeometry& g = geometry[k];
    const std::optional<Omission> whole = omission(block, k, g.cos_i, g.cos_o);
    std::optional<Omission> left_out = whole;
    std::vector<char> use(channels);
    for (std::size_t c = 0; c < channels && !whole; ++c) {
      const std::optional<Omission> why = omission(block, c, k, transform, g.cos_i, weighted);
      use[c] = !why;
      left_out = told(left_out, why);
    }
    if (left_out) out.not_fitted.add(*left_out);
    if (std::count(use.begin(), use.end(), 1) == 0 || !chosen(index, seen++, one_of)) continue;
    ++out.n_observations;
    out.geometry.push_back(g);
    out.sample.push_back(first_sample + k);
    for (std::size_t c = 0; c < channels; ++c) {
      ChannelTerms& terms = out.channel[c];
      const double f = use[c] ? block.f[c][k] : 0;
      const double u = weighted && use[c] ? block.u[c][k] : 1;
      const double slope = weighted && use[c] ? transform.slope(f, g.cos_i) : 1;
      const double cosine = transform.metric == Metric::linear_cos && !weighted ? g.cos_i : 1;
      const double weight = use[c] ? (weights.empty() ? 1 : weights[k]) * cosine * cosine / (u * u * slope * slope) : 0;
      terms.target.push_back(use[c] ? transform.value(f, g.cos_i) : 0);
      terms.weight.push_back(std::isfinite(weight) ? weight : 0);
      terms.value.push_back(f);
      if (weighted) {
        terms.u2.push_back(u * u);
        terms.read_variance.push_back(block.read_variance.empty() ? std::nan("") : block.read_variance[c][k]);
        terms.weighted_value2 += use[c] ? f * f / (u * u) : 0;
      }
      terms.count += static_cast<std::size_t>(use[c]);
    }
  }
  return out;
}

/// Puts the means of the nodes of rows [begin, end) in their places; `evaluate(nodes, values, stride)` gives `count` values per node.
template <class Evaluate>
void put_means(const MeanRows& mean, std::size_t begin, std::size_t end, std::size_t count, double* columns, std::size_t stride,
               Evaluate&& evaluate) {
  const auto from = static_cast<std::size_t>(std::lower_bound(mean.row.begin(), mean.row.end(), begin) - mean.row.begin());
  const auto to = static_cast<std::size_t>(std::lower_bound(mean.row.begin(), mean.row.end(), end) - mean.row.begin());
  if (from == to) return;
  const std::size_t first = mean.first[from], nodes = mean.first[to] - first;
  std::vector<double> values(count * nodes);
  evaluate(std::span(mean.geometry).subspan(first, nodes), values.data(), nodes);
  for (std::size_t r = from; r < to; ++r)
    for (std::size_t k = 0; k < count; ++k) {
      double sum = 0;
      for (std::size_t n = mean.first[r]; n < mean.first[r + 1]; ++n) sum += mean.weight[n] * values[k * nodes + n - first];
      columns[k * stride + mean.row[r] - begin] = sum;
    }
}

/// `count` columns times the factors of rows [begin, end).
void multiply(const std::vector<double>& factor, std::size_t begin, std::size_t end, std::size_t count, double* columns,
              std::size_t stride) {
  if (factor.empty()) return;
  for (std::size_t k = 0; k < count; ++k)
    for (std::size_t row = begin; row < end; ++row) columns[k * stride + row - begin] *= factor[row];
}

}  // namespace

void Terms::basis(std::size_t begin, std::size_t end, const double* theta, double* columns, std::size_t stride) const {
  kernel.basis(std::span(geometry).subspan(begin, end - begin), theta, columns, stride);
  put_means(mean, begin, end, kernel.linear, columns, stride,
            [&](std::span<const LobeGeometry> nodes, double* values, std::size_t n) { kernel.basis(nodes, theta, values, n); });
  multiply(factor, begin, end, kernel.linear, columns, stride);
}

void Terms::basis_and_slopes(std::size_t begin, std::size_t end, const double* theta, double* columns, double* slopes,
                             std::size_t stride) const {
  kernel.basis_and_slopes(std::span(geometry).subspan(begin, end - begin), theta, columns, slopes, stride);
  const std::size_t linear = kernel.linear;
  put_means(mean, begin, end, linear, columns, stride,
            [&](std::span<const LobeGeometry> nodes, double* values, std::size_t n) { kernel.basis(nodes, theta, values, n); });
  put_means(mean, begin, end, linear * kernel.nonlinear, slopes, stride,
            [&](std::span<const LobeGeometry> nodes, double* values, std::size_t n) {
              std::vector<double> unused(linear * n);
              kernel.basis_and_slopes(nodes, theta, unused.data(), values, n);
            });
  multiply(factor, begin, end, linear, columns, stride);
  multiply(factor, begin, end, linear * kernel.nonlinear, slopes, stride);
}

Terms make_terms(const Observations& observations, const ModelKernel& kernel, Metric metric, int threads, Robust robust, Weights weights,
                 std::size_t most_samples) {
  const std::size_t blocks = observations.block_count();
  Terms terms;
  terms.kernel = kernel;
  terms.transform = {metric};
  terms.channel.resize(observations.channels().size());
  const bool by_measure = weights == Weights::solid_angle;
  const std::vector<double> measure = by_measure ? solid_angles(observations) : std::vector<double>{};
  terms.weighted = weights != Weights::none && !by_measure && carries_uncertainty(observations);
  terms.collapsed = can_collapse(observations, kernel, metric);
  if (terms.collapsed) terms.rows_of = RowsOf::table_rows;
  std::vector<std::size_t> first(blocks + 1, 0);
  for (std::size_t b = 0; b < blocks; ++b) first[b + 1] = first[b] + observations.block(b).size;
  std::size_t one_of = 1;
  if (const std::size_t samples = most_samples > 0 && !terms.collapsed ? valid_count(observations, threads) : 0; samples > most_samples) {
    one_of = (samples + most_samples - 1) / most_samples;
    terms.approximation = fmt::format(
        "of {} samples, too many to be fitted one by one in a moment, one of every {} was fitted: intervals are those of that part",
        samples, one_of);
  }
  std::vector<Terms> parts(blocks);
  for_each_index(blocks, threads, [&](std::size_t b) {
    const auto own = by_measure ? std::span(measure).subspan(first[b], first[b + 1] - first[b]) : std::span<const double>{};
    parts[b] = terms.collapsed ? collapsed_block(observations, b, first[b], terms.transform, terms.weighted, robust, own)
                               : block_rows(observations, b, first[b], terms.transform, terms.weighted, own, one_of);
  });
  for (const Terms& part : parts) append(terms, part);
  return terms;
}

Terms only_channel(const Terms& terms, std::size_t channel) {
  Terms one = terms;
  one.channel = {terms.channel[channel]};
  std::erase_if(one.outliers, [channel](const Outlier& outlier) { return outlier.channel != channel; });
  for (Outlier& outlier : one.outliers) outlier.channel = 0;
  return one;
}

bool reweight(Terms& terms, const std::vector<std::vector<double>>& linear, const std::vector<double>& theta) {
  if (!terms.weighted || terms.collapsed) return false;
  const std::size_t rows = terms.rows();
  std::vector<double> columns(terms.kernel.linear * rows);
  terms.basis(0, rows, theta.data(), columns.data(), rows);
  bool changed = false;
  for (std::size_t c = 0; c < terms.channel.size(); ++c) {
    ChannelTerms& channel = terms.channel[c];
    for (std::size_t row = 0; row < rows; ++row) {
      const double f = channel.value[row], read = channel.read_variance[row], shot = channel.u2[row] - read;
      double fitted = 0;
      for (std::size_t k = 0; k < terms.kernel.linear; ++k) fitted += linear[c][k] * columns[k * rows + row];
      // A reading at or below zero says nothing about its own gain; its variance stays as it came.
      if (!(channel.weight[row] > 0) || !(read > 0) || !(shot > 0) || !(f > 0) || !(fitted > 0)) continue;
      const double variance = read + shot * fitted / f;
      const double slope = terms.transform.slope(fitted, terms.geometry[row].cos_i);
      const double weight = 1 / (variance * slope * slope);
      if (std::isfinite(weight) && weight > 0) channel.weight[row] = weight, changed = true;
    }
  }
  return changed;
}

}  // namespace gonio::fitting
