// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/collapse.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <span>

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

/// Least and largest value used in a channel, in units of the element, each in independent lanes.
struct ValueRange {
  std::array<double, lanes> least, most;

  ValueRange() {
    least.fill(std::numeric_limits<double>::infinity());
    most.fill(-std::numeric_limits<double>::infinity());
  }
  void add(const double* f, const double* valid, std::size_t size) noexcept {
    for (std::size_t k = 0; k < size; k += lanes)
      for (std::size_t l = 0; l < std::min(lanes, size - k); ++l) {
        const double low = valid[k + l] > 0 ? f[k + l] : least[l], high = valid[k + l] > 0 ? f[k + l] : most[l];
        least[l] = low < least[l] ? low : least[l];
        most[l] = high > most[l] ? high : most[l];
      }
  }
  bool within(CleanRange range) const noexcept {
    return *std::min_element(least.begin(), least.end()) >= range.low && *std::max_element(most.begin(), most.end()) <= range.high;
  }
};

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
/// `range`: one per channel, filled, or empty if nobody asks.
CollapsedBlock collapse_plain(const ObservationBlock& block, std::vector<ValueRange>& range) {
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
      if (!range.empty()) range[c].add(f.data(), valid.data(), size);
      merge(out.channel[c], plain_sums(f.data(), valid.data(), size, block.f[c].scale));
    }
    double used = 0, whole = 0;
    for (std::size_t k = 0; k < size; ++k) used += most[k], whole += least[k];
    out.used += static_cast<std::size_t>(used);
    out.masked += size - static_cast<std::size_t>(whole);
  }
  return out;
}

/// The values of a channel that count, transformed, with their numbers in the block.
struct UsedValues {
  std::vector<double> value;
  std::vector<std::size_t> number;
};

UsedValues used_values(const ObservationBlock& block, std::size_t channel, Transform transform) {
  UsedValues out;
  for (std::size_t k = 0; k < block.size; ++k) {
    const double f = block.f[channel][k];
    if (!block.valid(k) || !std::isfinite(f) || !transform.defined(f, 1)) continue;
    out.value.push_back(transform.value(f, 1));
    out.number.push_back(k);
  }
  return out;
}

/// The channel's sums with a robust mean instead of the plain one.
void replace_sums(const ObservationBlock& block, std::size_t channel, Transform transform, Robust robust, CollapsedBlock& out) {
  const UsedValues used = used_values(block, channel, transform);
  std::vector<double> scratch;
  const RobustMean mean = robust_mean(used.value, robust, scratch);
  if (robust == Robust::automatic && mean.outliers.empty()) return;
  const double count = static_cast<double>(mean.count);
  out.channel[channel] = {count, mean.mean, mean.within, out.channel[channel].weighted_value2, mean.count};
  for (const std::size_t k : mean.outliers)
    out.outliers.push_back({used.number[k], channel, transform.inverse(used.value[k], 1), transform.inverse(mean.mean, 1),
                            (used.value[k] - mean.mean) / mean.scale});
}

CleanRange clean_range_of(const ObservationBlock& block, std::size_t channel) {
  std::array<double, judges> some;
  std::size_t count = 0;
  const std::size_t stride = (block.size + judges - 1) / judges;
  for (std::size_t k = 0; k < block.size; k += stride) {
    const double f = block.f[channel][k];
    if (block.valid(k) && std::isfinite(f)) some[count++] = f;
  }
  return clean_range(std::span(some).first(count), block.size);
}

CollapsedBlock collapse_any(const Observations& observations, std::size_t index, const ObservationBlock& block, Transform transform,
                            bool weighted) {
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

}  // namespace

CollapsedBlock collapse(const Observations& observations, std::size_t index, Transform transform, bool weighted, Robust robust) {
  const ObservationBlock block = observations.block(index);
  const std::size_t channels = block.f.size();
  const bool look = robust != Robust::none && !weighted;
  if (transform.metric == Metric::linear && !weighted && plain(block)) {
    std::vector<ValueRange> range(look ? channels : 0);
    CollapsedBlock out = collapse_plain(block, range);
    for (std::size_t c = 0; c < range.size(); ++c) {
      CleanRange clean = clean_range_of(block, c);
      clean.low /= block.f[c].scale, clean.high /= block.f[c].scale;
      if (robust != Robust::automatic || !range[c].within(clean)) replace_sums(block, c, transform, robust, out);
    }
    return out;
  }
  CollapsedBlock out = collapse_any(observations, index, block, transform, weighted);
  for (std::size_t c = 0; look && c < channels; ++c) replace_sums(block, c, transform, robust, out);
  return out;
}

}  // namespace gonio::fitting
