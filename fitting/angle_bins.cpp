// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/angle_bins.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "fitting/threads.hpp"

namespace gonio::fitting {
namespace {

constexpr std::size_t no_lobe = angle_bins;    // the bin of all angles of 90° and more
constexpr std::size_t bins_of_piece = 256;     // of a piece of work
constexpr std::size_t fewest_to_judge = 16;    // samples of a bin; of fewer a spread is too uncertain to call one of them wrong
constexpr std::size_t farthest_neighbour = 8;  // bins away that may lend a bin their samples to judge its own

/// A sample that counts in some channel, as its bin needs it.
struct Entry {
  double sin2_half;  ///< sin² of half the angle
  std::uint32_t sample;
  float cos_i;
};

std::size_t bin_of(double sin2_half) {
  if (!(sin2_half < 0.5)) return no_lobe;
  return std::min(static_cast<std::size_t>(std::sqrt(std::sqrt(2 * sin2_half)) * static_cast<double>(angle_bins)), angle_bins - 1);
}

bool worth_it(const Observations& observations, const ModelKernel& kernel, Metric metric, bool ignore_apertures) {
  const DependsOn angle = kernel.info->depends_on;
  if ((angle != DependsOn::psi && angle != DependsOn::theta_h) || metric == Metric::log1p) return false;
  for (const CorrelatedComponent& component : observations.correlated())
    if (!component.sensitivity.empty()) return false;
  std::size_t samples = 0;
  bool constant = true;
  for (std::size_t b = 0; b < observations.block_count(); ++b) {
    const ObservationBlock block = observations.block(b);
    const Apertures open = observations.apertures(b);
    if (!block.u.empty()) return false;
    if (!ignore_apertures && (open.source_half_angle_deg.value_or(0) > 0 || open.receiver_half_angle_deg.value_or(0) > 0)) return false;
    constant = constant && block.constant == ConstantOver::theta_h;
    samples += block.size;
  }
  return samples >= fewest_binned && !(constant && angle == DependsOn::theta_h);
}

class Binned {
 public:
  Binned(const Observations& observations, const ModelKernel& kernel, Metric metric, int threads)
      : observations_(observations), transform_{metric}, psi_(kernel.info->depends_on == DependsOn::psi), threads_(threads) {
    for (std::size_t b = 0; b < observations.block_count(); ++b) {
      blocks_.push_back(observations.block(b));
      first_.push_back(samples_);
      samples_ += blocks_.back().size;
    }
    first_.push_back(samples_);
    sort_into_bins();
  }

  /// The rows of all bins that are not empty.
  void add_rows(Terms& terms, Robust robust) const {
    std::vector<std::size_t> bins;
    for (std::size_t bin = 0; bin <= no_lobe; ++bin)
      if (begin_[bin + 1] > begin_[bin]) bins.push_back(bin);
    const std::size_t channels = terms.channel.size(), pieces = (bins.size() + bins_of_piece - 1) / bins_of_piece;
    terms.geometry.resize(bins.size());
    for (ChannelTerms& channel : terms.channel) {
      for (auto* column : {&channel.target, &channel.weight, &channel.row_within}) column->assign(bins.size(), 0.0);
      channel.row_count.assign(bins.size(), 0);
    }
    std::vector<Tally> tallies(pieces);
    for_each_index(pieces, threads_, [&](std::size_t piece) {
      Tally& tally = tallies[piece];
      for (std::size_t row = piece * bins_of_piece; row < std::min(bins.size(), (piece + 1) * bins_of_piece); ++row) {
        terms.geometry[row] = geometry_of(bins[row]);
        const std::vector<Values> values = values_of(bins[row], channels, tally);
        for (std::size_t c = 0; c < channels; ++c) {
          const Sums sums = sums_of(values[c], bins[row], c, robust, tally);
          ChannelTerms& channel = terms.channel[c];
          channel.target[row] = sums.mean, channel.weight[row] = sums.weight;
          channel.row_within[row] = sums.within, channel.row_count[row] = sums.count;
        }
      }
    });
    for (const Tally& tally : tallies) {
      terms.n_observations += tally.used;
      terms.not_fitted += tally.not_fitted;
      terms.outliers.insert(terms.outliers.end(), tally.outliers.begin(), tally.outliers.end());
    }
    terms.not_fitted += not_fitted_;
    std::sort(terms.outliers.begin(), terms.outliers.end(),
              [](const Outlier& a, const Outlier& b) { return std::pair(a.sample, a.channel) < std::pair(b.sample, b.channel); });
    for (ChannelTerms& channel : terms.channel)
      for (std::size_t row = 0; row < bins.size(); ++row)
        channel.within += channel.row_within[row], channel.count += channel.row_count[row];
  }

 private:
  struct Sums {
    double weight = 0, mean = 0, within = 0;
    std::size_t count = 0;
  };
  /// Transformed values of a channel with the numbers of their samples, cos θi where it is a weight.
  struct Values {
    std::vector<double> value, cos_i;
    std::vector<std::uint32_t> sample;
  };
  struct Tally {
    std::size_t used = 0;
    NotFitted not_fitted;
    std::vector<Outlier> outliers;
    std::vector<double> scratch, some;
  };

  void sort_into_bins() {
    struct Part {
      std::vector<Entry> entries;
      std::vector<std::uint16_t> bins;
      NotFitted not_fitted;
    };
    std::vector<Part> parts(blocks_.size());
    for_each_index(parts.size(), threads_, [&](std::size_t b) {
      const ObservationBlock& block = blocks_[b];
      MirrorGeometry mirror;
      std::vector<LobeGeometry> geometry;
      if (psi_)
        observations_.mirror_geometry(b, mirror);
      else
        observations_.geometry(b, geometry);
      for (std::size_t k = 0; k < block.size; ++k) {
        const double cos_i = psi_ ? mirror.cos_i[k] : geometry[k].cos_i, cos_o = psi_ ? mirror.cos_o[k] : geometry[k].cos_o;
        if (const auto why = omission(block, k, cos_i, cos_o)) {
          parts[b].not_fitted.add(*why);
          continue;
        }
        const double sin2_half = psi_ ? mirror.sin2_half_psi[k] : -0.5 * std::expm1(geometry[k].log_cos_h);
        parts[b].entries.push_back({sin2_half, static_cast<std::uint32_t>(first_[b] + k), static_cast<float>(cos_i)});
        parts[b].bins.push_back(static_cast<std::uint16_t>(bin_of(sin2_half)));
      }
    });
    begin_.assign(no_lobe + 2, 0);
    for (const Part& part : parts)
      for (const std::uint16_t bin : part.bins) ++begin_[bin + 1u];
    for (std::size_t bin = 0; bin <= no_lobe; ++bin) begin_[bin + 1] += begin_[bin];
    entries_.resize(begin_.back());
    for (const Part& part : parts) not_fitted_ += part.not_fitted;
    std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
    for (Part& part : parts) {
      for (std::size_t j = 0; j < part.entries.size(); ++j) entries_[next[part.bins[j]]++] = part.entries[j];
      part = {};
    }
  }

  std::span<const Entry> entries_of(std::size_t bin) const {
    return std::span(entries_).subspan(begin_[bin], begin_[bin + 1] - begin_[bin]);
  }

  LobeGeometry geometry_of(std::size_t bin) const {
    double log_cosine = LobeGeometry::no_lobe;
    if (bin != no_lobe) {
      log_cosine = 0;
      for (const Entry& entry : entries_of(bin)) log_cosine += std::log1p(-2 * entry.sin2_half);
      log_cosine /= static_cast<double>(entries_of(bin).size());
    }
    LobeGeometry out;
    (psi_ ? out.log_cos_psi : out.log_cos_h) = log_cosine;
    return out;
  }

  /// Calls `take(entry, block, number in the block)` for every sample of a bin, in their order.
  template <class Take>
  void for_each_sample(std::size_t bin, Take&& take) const {
    std::size_t b = 0;
    for (const Entry& entry : entries_of(bin)) {
      while (entry.sample >= first_[b + 1]) ++b;
      take(entry, blocks_[b], entry.sample - first_[b]);
    }
  }

  std::vector<Values> values_of(std::size_t bin, std::size_t channels, Tally& tally) const {
    std::vector<Values> out(channels);
    for_each_sample(bin, [&](const Entry& entry, const ObservationBlock& block, std::size_t k) {
      std::size_t used = 0;
      std::optional<Omission> left_out;
      for (std::size_t c = 0; c < channels; ++c) {
        const std::optional<Omission> why = omission(block, c, k, transform_, entry.cos_i, false);
        left_out = told(left_out, why);
        if (why) continue;
        ++used;
        const double f = block.f[c][k];
        out[c].value.push_back(transform_.value(f, entry.cos_i));
        out[c].sample.push_back(entry.sample);
        if (transform_.metric == Metric::linear_cos) out[c].cos_i.push_back(entry.cos_i);
      }
      tally.used += used > 0;
      if (left_out) tally.not_fitted.add(*left_out);
    });
    return out;
  }

  /// Values of a channel in a bin and in those beside it, until there are enough to judge by.
  void gather_around(std::size_t bin, std::size_t channel, std::vector<double>& out) const {
    out.clear();
    const auto add = [&](std::size_t from) {
      for_each_sample(from, [&](const Entry& entry, const ObservationBlock& block, std::size_t k) {
        if (!omission(block, channel, k, transform_, entry.cos_i, false)) out.push_back(transform_.value(block.f[channel][k], entry.cos_i));
      });
    };
    add(bin);
    for (std::size_t away = 1; away <= farthest_neighbour && out.size() < fewest_to_judge; ++away) {
      if (bin >= away) add(bin - away);
      if (bin + away < no_lobe) add(bin + away);
    }
  }

  /// The values of a bin that are wrong; `mean` becomes a robust one where it is asked for.
  std::vector<std::size_t> wrong_ones(const Values& values, std::size_t bin, std::size_t channel, Robust robust, RobustMean& mean,
                                      Tally& tally) const {
    const std::size_t n = values.value.size();
    const double limit = outlier_limit(samples_, static_cast<double>(std::max(n, fewest_to_judge)) - 1);
    if (n >= fewest_to_judge) {
      if (robust == Robust::automatic) {
        tally.some.assign(values.value.begin(), values.value.end());
        const CleanRange clean = clean_range_within(tally.some, limit);
        const auto [low, high] = std::minmax_element(values.value.begin(), values.value.end());
        if (*low >= clean.low && *high <= clean.high) return {};
      }
      mean = robust_mean_within(values.value, robust, limit, tally.scratch);
      return mean.outliers;
    }
    gather_around(bin, channel, tally.some);
    if (tally.some.size() < fewest_to_judge) return {};
    const double centre = median_of(tally.some);
    const CleanRange clean = clean_range_within(tally.some, limit);
    mean.mean = centre, mean.scale = (clean.high - centre) / limit;
    std::vector<std::size_t> out;
    for (std::size_t k = 0; k < n; ++k)
      if (values.value[k] < clean.low || values.value[k] > clean.high) out.push_back(k);
    return out;
  }

  Sums sums_of(const Values& values, std::size_t bin, std::size_t channel, Robust robust, Tally& tally) const {
    const std::size_t n = values.value.size();
    RobustMean mean;
    const std::vector<std::size_t> wrong =
        robust == Robust::none || n == 0 ? std::vector<std::size_t>{} : wrong_ones(values, bin, channel, robust, mean, tally);
    for (const std::size_t k : wrong)
      tally.outliers.push_back({values.sample[k], channel, transform_.inverse(values.value[k], 1), transform_.inverse(mean.mean, 1),
                                (values.value[k] - mean.mean) / mean.scale});
    const auto weight = [&](std::size_t k) { return values.cos_i.empty() ? 1 : values.cos_i[k] * values.cos_i[k]; };
    Sums out;
    auto left_out = wrong.begin();
    const bool loss = (robust == Robust::huber || robust == Robust::cauchy) && n >= fewest_to_judge;
    double sum = 0;
    for (std::size_t k = 0; k < n; ++k) {
      if (!loss && left_out != wrong.end() && *left_out == k) {
        ++left_out;
        continue;
      }
      out.weight += weight(k), sum += weight(k) * values.value[k], ++out.count;
    }
    if (!(out.weight > 0)) return {};
    if (loss) {
      out.mean = mean.mean, out.within = mean.within * out.weight / static_cast<double>(out.count);
      return out;
    }
    out.mean = sum / out.weight;
    left_out = wrong.begin();
    for (std::size_t k = 0; k < n; ++k) {
      if (left_out != wrong.end() && *left_out == k)
        ++left_out;
      else
        out.within += weight(k) * (values.value[k] - out.mean) * (values.value[k] - out.mean);
    }
    return out;
  }

  const Observations& observations_;
  Transform transform_;
  bool psi_;
  int threads_;
  std::vector<ObservationBlock> blocks_;
  std::vector<std::size_t> first_;  ///< number of the first sample of every block, and of all
  std::size_t samples_ = 0;
  NotFitted not_fitted_;            ///< samples that are in no bin
  std::vector<Entry> entries_;      ///< by bin, in the order of the samples within one
  std::vector<std::size_t> begin_;  ///< of every bin in `entries_`, and the end
};

}  // namespace

std::optional<Terms> binned_terms(const Observations& observations, const ModelKernel& kernel, Metric metric, bool ignore_apertures,
                                  Robust robust, int threads) {
  if (!worth_it(observations, kernel, metric, ignore_apertures)) return std::nullopt;
  const Binned binned(observations, kernel, metric, threads);
  const auto made = [&](Robust loss) {
    Terms terms;
    terms.kernel = kernel;
    terms.transform = {metric};
    terms.channel.resize(observations.channels().size());
    terms.collapsed = true;
    const bool psi = kernel.info->depends_on == DependsOn::psi;
    terms.rows_of = psi ? RowsOf::psi_bins : RowsOf::theta_h_bins;
    terms.approximation = fmt::format(
        "the samples are many, so that their means over at most {} bins of {} were fitted, narrow where a lobe is steep: a parameter moves "
        "by less than a twentieth of its interval",
        angle_bins, psi ? "psi" : "theta_h");
    binned.add_rows(terms, loss);
    return terms;
  };
  Terms terms = made(robust);
  if (robust != Robust::automatic) return terms;
  // Beside each other in the order of the table they are what the model misses.
  for (std::size_t c = 0; c < terms.channel.size(); ++c) {
    std::vector<std::size_t> samples;
    for (const Outlier& outlier : terms.outliers)
      if (outlier.channel == c) samples.push_back(outlier.sample);
    if (in_runs(samples)) return made(Robust::none);
  }
  return terms;
}

}  // namespace gonio::fitting
