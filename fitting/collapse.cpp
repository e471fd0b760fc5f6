// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/collapse.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>

namespace gonio::fitting {
namespace {

/// A running weighted mean with its centred sum of squares (West 1979): no cancellation whatever the order of magnitude of the mean.
class CentredSum {
 public:
  void add(double w, double value) {
    weight_ += w;
    const double from_old = value - mean_;
    mean_ += from_old * (w / weight_);
    within_ += w * from_old * (value - mean_);
    ++count_;
  }
  BlockSums sums() const { return {weight_, mean_, within_, 0, count_}; }

 private:
  double weight_ = 0, mean_ = 0, within_ = 0;
  std::size_t count_ = 0;
};

constexpr std::size_t lanes = 8;

/// Two passes in `lanes` independent sums: the mean, then squares about the mean. `f` is 0 where `valid` is.
BlockSums plain_sums(const double* f, const double* valid, std::size_t size, double scale) {
  std::array<double, lanes> count{}, sum{}, square{}, rest{};
  const std::size_t whole = size / lanes * lanes;
  for (std::size_t k = 0; k < whole; k += lanes)
    for (std::size_t l = 0; l < lanes; ++l) {
      count[l] += valid[k + l];
      sum[l] += f[k + l];
    }
  for (std::size_t k = whole; k < size; ++k) {
    count[0] += valid[k];
    sum[0] += f[k];
  }
  double n = 0, total = 0;
  for (std::size_t l = 0; l < lanes; ++l) n += count[l], total += sum[l];
  if (!(n > 0)) return {};
  const double mean = total / n;
  const auto from_mean = [&](std::size_t k) { return (f[k] - mean) * valid[k]; };
  for (std::size_t k = 0; k < whole; k += lanes)
    for (std::size_t l = 0; l < lanes; ++l) {
      const double d = from_mean(k + l);
      square[l] += d * d;
      rest[l] += d;
    }
  for (std::size_t k = whole; k < size; ++k) {
    const double d = from_mean(k);
    square[0] += d * d;
    rest[0] += d;
  }
  double squares = 0, left = 0;
  for (std::size_t l = 0; l < lanes; ++l) squares += square[l], left += rest[l];
  return {n, scale * (mean + left / n), scale * scale * (squares - left * left / n), 0, static_cast<std::size_t>(n)};
}

bool plain(const ObservationBlock& block) {
  if (block.validity == ObservationBlock::Validity::mask) return false;
  for (const Column& column : block.f)
    if (column.type != Column::Type::f64 || column.stride != 1 || !(column.scale > 0)) return false;
  return true;
}

/// Two sums about their own means as one (Chan, Golub and LeVeque 1979).
void merge(BlockSums& all, const BlockSums& part) {
  if (part.count == 0) return;
  const double weight = all.weight + part.weight, apart = part.mean - all.mean;
  all.within += part.within + apart * apart * all.weight * part.weight / weight;
  all.mean += apart * part.weight / weight;
  all.weight = weight;
  all.count += part.count;
}

/// A stretch of the block at a time, which stays in the first-level cache; copied there, because a mapped file need not be aligned.
CollapsedBlock collapse_plain(const ObservationBlock& block) {
  constexpr std::size_t stretch = 512;
  const std::size_t channels = block.f.size();
  const bool drop_negative = block.validity == ObservationBlock::Validity::no_channel_negative;
  std::vector<std::array<double, stretch>> columns(channels);
  std::array<double, stretch> sample_valid, valid, most, least;
  CollapsedBlock out;
  out.channel.resize(channels);
  for (std::size_t begin = 0; begin < block.size; begin += stretch) {
    const std::size_t size = std::min(stretch, block.size - begin);
    sample_valid.fill(1);
    most.fill(0);
    least.fill(1);
    for (std::size_t c = 0; c < channels; ++c) {
      std::array<double, stretch>& f = columns[c];
      std::memcpy(f.data(), static_cast<const std::byte*>(block.f[c].data) + begin * sizeof(double), size * sizeof(double));
      if (drop_negative)
        for (std::size_t k = 0; k < size; ++k) sample_valid[k] = f[k] < 0 ? 0.0 : sample_valid[k];
    }
    for (std::size_t c = 0; c < channels; ++c) {
      std::array<double, stretch>& f = columns[c];
      // The comparison is false for NaN and for infinity, which are no measurements either.
      for (std::size_t k = 0; k < size; ++k) valid[k] = std::abs(f[k]) <= std::numeric_limits<double>::max() ? sample_valid[k] : 0.0;
      for (std::size_t k = 0; k < size; ++k) f[k] = valid[k] > 0 ? f[k] : 0.0;
      for (std::size_t k = 0; k < size; ++k) {
        most[k] = valid[k] > most[k] ? valid[k] : most[k];
        least[k] = valid[k] < least[k] ? valid[k] : least[k];
      }
      merge(out.channel[c], plain_sums(f.data(), valid.data(), size, block.f[c].scale));
    }
    double used = 0, whole = 0;
    for (std::size_t k = 0; k < size; ++k) used += most[k], whole += least[k];
    out.used += static_cast<std::size_t>(used);
    out.masked += size - static_cast<std::size_t>(whole);
  }
  return out;
}

}  // namespace

CollapsedBlock collapse(const Observations& observations, std::size_t index, Transform transform, bool weighted) {
  const ObservationBlock block = observations.block(index);
  if (transform.metric == Metric::linear && !weighted && plain(block)) return collapse_plain(block);

  const std::size_t channels = block.f.size();
  const bool cosine = transform.metric == Metric::linear_cos && !weighted;
  std::vector<LobeGeometry> geometry;
  if (cosine) observations.geometry(index, geometry);
  std::vector<CentredSum> sums(channels);
  std::vector<double> squares(channels);
  CollapsedBlock out;
  for (std::size_t k = 0; k < block.size; ++k) {
    const bool valid = block.valid(k);
    bool used = false, masked = false;
    for (std::size_t c = 0; c < channels; ++c) {
      const double f = block.f[c][k];
      const double u = weighted ? block.u[c][k] : 1;
      if (!valid || !std::isfinite(f) || !transform.defined(f, 1) || !(u > 0) || !std::isfinite(u)) {
        masked = true;
        continue;
      }
      used = true;
      const double slope = weighted ? transform.slope(f, 1) : 1;
      const double cos_i = cosine ? geometry[k].cos_i : 1;
      const double weight = cos_i * cos_i / (u * u * slope * slope);
      if (weight > 0) sums[c].add(weight, transform.value(f, 1));
      squares[c] += f * f / (u * u);
    }
    out.used += used, out.masked += masked;
  }
  for (std::size_t c = 0; c < channels; ++c) {
    out.channel.push_back(sums[c].sums());
    out.channel.back().weighted_value2 = squares[c];
  }
  return out;
}

}  // namespace gonio::fitting
