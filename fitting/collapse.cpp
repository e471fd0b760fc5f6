// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/collapse.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>

#include "fitting/plane_sums.hpp"

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

bool plain(const ObservationBlock& block) {
  if (block.validity == ObservationBlock::Validity::mask) return false;
  for (const Column& column : block.f)
    if (column.type != Column::Type::f64 || column.stride != 1 || !(column.scale > 0)) return false;
  return true;
}

/// A plain block and, in units of the stored numbers, what its planes held.
struct PlainBlock {
  CollapsedBlock collapsed;
  std::vector<PlaneSums> planes;

  bool within(std::size_t channel, CleanRange range) const {
    return planes[channel].least >= range.low && planes[channel].most <= range.high;
  }
};

PlainBlock collapse_plain(const ObservationBlock& block) {
  std::vector<const std::byte*> planes;
  for (const Column& column : block.f) planes.push_back(static_cast<const std::byte*>(column.data));
  SummedPlanes sums = sum_planes(planes, block.size, block.validity == ObservationBlock::Validity::no_channel_negative);
  PlainBlock out;
  for (std::size_t c = 0; c < planes.size(); ++c) {
    const PlaneSums& plane = sums.plane[c];
    const double scale = block.f[c].scale;
    out.collapsed.channel.push_back(
        {plane.count, scale * plane.mean, scale * scale * plane.within, 0, static_cast<std::size_t>(plane.count)});
  }
  out.collapsed.used = sums.used;
  out.collapsed.not_fitted.add(Omission::marked, sums.negative);
  out.collapsed.not_fitted.add(Omission::no_value, sums.unknown);
  out.planes = std::move(sums.plane);
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
                            bool weighted, std::span<const double> weights) {
  const std::size_t channels = block.f.size();
  const bool cosine = transform.metric == Metric::linear_cos && !weighted;
  std::vector<LobeGeometry> geometry;
  if (cosine) observations.geometry(index, geometry);
  std::vector<CentredSum> sums(channels);
  std::vector<double> squares(channels);
  CollapsedBlock out;
  for (std::size_t k = 0; k < block.size; ++k) {
    const bool valid = block.valid(k);
    std::optional<Omission> left_out = valid ? std::nullopt : std::optional(Omission::marked);
    bool used = false;
    for (std::size_t c = 0; c < channels && valid; ++c) {
      const std::optional<Omission> why = omission(block, c, k, transform, 1, weighted);
      left_out = told(left_out, why);
      if (why) continue;
      used = true;
      const double f = block.f[c][k], u = weighted ? block.u[c][k] : 1;
      const double slope = weighted ? transform.slope(f, 1) : 1;
      const double cos_i = cosine ? geometry[k].cos_i : 1;
      const double weight = (weights.empty() ? 1 : weights[k]) * cos_i * cos_i / (u * u * slope * slope);
      if (weight > 0) sums[c].add(weight, transform.value(f, 1));
      squares[c] += f * f / (u * u);
    }
    out.used += used;
    if (left_out) out.not_fitted.add(*left_out);
  }
  for (std::size_t c = 0; c < channels; ++c) {
    out.channel.push_back(sums[c].sums());
    out.channel.back().weighted_value2 = squares[c];
  }
  return out;
}

}  // namespace

CollapsedBlock collapse(const Observations& observations, std::size_t index, Transform transform, bool weighted, Robust robust,
                        std::span<const double> weights) {
  const ObservationBlock block = observations.block(index);
  const std::size_t channels = block.f.size();
  const bool look = robust != Robust::none && !weighted && weights.empty();
  if (transform.metric == Metric::linear && !weighted && weights.empty() && plain(block)) {
    PlainBlock out = collapse_plain(block);
    for (std::size_t c = 0; look && c < channels; ++c) {
      CleanRange clean = clean_range_of(block, c);
      clean.low /= block.f[c].scale, clean.high /= block.f[c].scale;
      if (robust != Robust::automatic || !out.within(c, clean)) replace_sums(block, c, transform, robust, out.collapsed);
    }
    return std::move(out.collapsed);
  }
  CollapsedBlock out = collapse_any(observations, index, block, transform, weighted, weights);
  for (std::size_t c = 0; look && c < channels; ++c) replace_sums(block, c, transform, robust, out);
  return out;
}

}  // namespace gonio::fitting
