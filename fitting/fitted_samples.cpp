// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/fitted_samples.hpp"

#include <algorithm>
#include <span>

namespace gonio::fitting {
namespace {

constexpr std::size_t all_up_to = std::size_t{1} << 18;
constexpr std::size_t part_of_more = std::size_t{1} << 15;

}  // namespace

FittedSamples::FittedSamples(const Observations& observations, const ModelKernel& kernel, const std::vector<std::vector<double>>& values,
                             const std::vector<MeanRows>& means)
    : observations_(observations), kernel_(kernel), values_(values), means_(means), first_(observations.block_count() + 1, 0) {
  for (std::size_t b = 0; b + 1 < first_.size(); ++b) first_[b + 1] = first_[b] + observations.block(b).size;
  if (first_.back() > all_up_to) stride_ = (first_.back() + part_of_more - 1) / part_of_more;
}

FittedBlock FittedSamples::block(std::size_t index) const {
  const ObservationBlock block = observations_.block(index);
  FittedBlock out;
  out.first = first_[index];
  std::vector<std::size_t> valid;
  std::vector<LobeGeometry> geometry;
  for (std::size_t k = index % stride_; k < block.size; k += stride_)
    if (block.valid(k)) valid.push_back(k);
  observations_.geometry_of(index, valid, geometry);
  for (std::size_t j = 0; j < valid.size(); ++j)
    if (geometry[j].cos_i >= 0 && geometry[j].cos_o >= 0) out.sample.push_back(valid[j]), out.geometry.push_back(geometry[j]);

  const std::size_t rows = out.sample.size(), linear = kernel_.linear;
  std::vector<double> columns(linear * rows);
  for (std::size_t c = 0; c < values_.size(); ++c) {
    const auto theta = std::span(values_[c]).subspan(linear);
    if (c == 0 || !std::ranges::equal(theta, std::span(values_[c - 1]).subspan(linear)))
      kernel_.basis(out.geometry, theta.data(), columns.data(), rows);
    std::vector<double>& fitted = out.fitted.emplace_back(rows, 0.0);
    for (std::size_t k = 0; k < linear; ++k)
      for (std::size_t j = 0; j < rows; ++j) fitted[j] += values_[c][k] * columns[k * rows + j];
    put_means(c, out);
  }
  return out;
}

void FittedSamples::put_means(std::size_t channel, FittedBlock& out) const {
  if (means_.empty()) return;
  const MeanRows& all = means_[means_.size() == 1 ? 0 : channel];
  if (all.empty()) return;
  std::vector<std::size_t> numbers;
  for (const std::size_t k : out.sample) numbers.push_back(out.first + k);
  const MeanRows mean = all.of(numbers);
  const std::size_t nodes = mean.geometry.size();
  const std::vector<double>& values = values_[channel];
  std::vector<double> columns(kernel_.linear * nodes);
  kernel_.basis(mean.geometry, values.data() + kernel_.linear, columns.data(), nodes);
  for (std::size_t r = 0; r < mean.row.size(); ++r) {
    double sum = 0;
    for (std::size_t n = mean.first[r]; n < mean.first[r + 1]; ++n)
      for (std::size_t k = 0; k < kernel_.linear; ++k) sum += mean.weight[n] * values[k] * columns[k * nodes + n];
    out.fitted[channel][mean.row[r]] = sum;
  }
}

}  // namespace gonio::fitting
