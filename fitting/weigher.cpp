// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/weigher.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "fitting/row_weights.hpp"
#include "fitting/threads.hpp"

namespace gonio::fitting {
namespace {

constexpr int variance_rounds = 3;         // the weights have settled to 1e-6 by then (numerics C13)
constexpr int robust_rounds = 12;          // Cauchy weights
constexpr int global_robust_rounds = 2;    // the first weights are those of a fit that the outliers may have led astray
constexpr int fewest_robust_rounds = 3;    // a list of outliers that stands still sooner may still be that of the start
constexpr double truncation = 2;           // of the squares of a robust scale
constexpr int truncated_rounds = 20;       // one contracts an excess of outliers at least by half
constexpr double apart = 4;                // standard deviations of the mean of a channel's squares
constexpr double enough_repeats = 0.2;     // part of the samples that must be repeated
constexpr std::size_t fewest_values = 30;  // below it a variance, let alone an outlier, cannot be told
constexpr double median_of_normal = 0.6744897501960817, least_median = 0.75;  // part of it; below: the tails are heavy
constexpr double most_outliers = 0.25;                                        // a larger part of the data is no contamination
constexpr std::size_t many_rows = 4096;                                       // worth several threads
constexpr double rounding = 1e-12;  // of the largest value: exact data have at least this standard deviation

using Fitted = std::vector<std::vector<double>>;

class Weigher {
 public:
  Weigher(Terms& terms, const WeigherOptions& options, const Fitter& fitter) : terms_(terms), options_(options), fitter_(fitter) {
    for (const ChannelTerms& channel : terms.channel) {
      base_.push_back(channel.weight);
      kept_.emplace_back(channel.weight.size(), 1);
      count_ += channel.count;
      double largest = 0;
      for (const double value : channel.value) largest = std::max(largest, std::abs(value));
      floor_.push_back(rounding * rounding * largest * largest);
    }
    for (const LobeGeometry& geometry : terms.geometry) tan2_.push_back(tan_squared(geometry.cos_i));
    scale2_.assign(terms.channel.size(), 1);
  }

  Weighting run() {
    Weighting out;
    out.source = terms_.weighted ? WeightSource::uncertainty : WeightSource::none;
    const bool enough = count_ >= fewest_values + options_.free_parameters;
    estimated_ = options_.estimate_variance && !terms_.weighted && enough;
    if (options_.robust == Robust::none && !estimated_) return out;
    out.reason = "too few samples to tell an outlier";
    if (!enough) return out;

    auto fitted = fitter_(true);
    if (!fitted) return out;
    if (estimated_) {
      repeated_ = from_repeats();
      terms_.pure_error = repeated_;
      out.source = repeated_ ? WeightSource::repeats : WeightSource::residuals;
      if (!weigh_by_variance(*fitted)) return out;
    }
    if (options_.robust != Robust::none) robust(*fitted, out);
    if (estimated_) {
      out.variance = variance_;
      add_signal_to_noise(*fitted);
    }
    return out;
  }

 private:
  double deviation(std::size_t c, std::size_t row, double fitted) const { return terms_.channel[c].value[row] - fitted; }

  /// 1/σ² of the transformed reading, before any loss.
  double plain_weight(std::size_t c, std::size_t row, double fitted) const {
    if (!(base_[c][row] > 0)) return 0;
    if (!estimated_) return base_[c][row] / scale2_[c];
    const double variance = std::max(variance_[c](fitted, tan2_[row]), floor_[c]);
    const double slope = terms_.transform.slope(std::max(fitted, std::sqrt(floor_[c])), terms_.geometry[row].cos_i);
    const double weight = 1 / (variance * slope * slope);
    return std::isfinite(weight) ? weight : 0;
  }

  double standardised(std::size_t c, std::size_t row, double fitted) const {
    const double cos_i = terms_.geometry[row].cos_i;
    if (!terms_.transform.linear() && !terms_.transform.defined(fitted, cos_i)) return 0;
    return std::sqrt(plain_weight(c, row, fitted)) * (terms_.channel[c].target[row] - terms_.transform.value(fitted, cos_i));
  }

  void add_signal_to_noise(const Fitted& fitted) {
    for (std::size_t c = 0; c < base_.size(); ++c) {
      double& sum = terms_.channel[c].weighted_value2 = 0;
      for (std::size_t row = 0; row < base_[c].size(); ++row) {
        const double f = fitted[c][row];
        if (used(c, row)) sum += f * f / std::max(variance_[c](f, tan2_[row]), floor_[c]);
      }
    }
  }

  /// Calls `work(channel)` for every channel.
  template <class Work>
  void for_each_channel(Work&& work) const {
    for_each_index(base_.size(), terms_.rows() > many_rows ? options_.threads : 1, work);
  }

  void set_weights(const Fitted& fitted, Robust loss) {
    for_each_channel([&](std::size_t c) {
      for (std::size_t row = 0; row < base_[c].size(); ++row) {
        double weight = kept_[c][row] ? plain_weight(c, row, fitted[c][row]) : 0;
        if (weight > 0 && (loss == Robust::huber || loss == Robust::cauchy))
          weight *= loss_weight(loss, standardised(c, row, fitted[c][row]));
        terms_.channel[c].weight[row] = weight;
      }
    });
  }

  bool used(std::size_t c, std::size_t row) const { return base_[c][row] > 0 && kept_[c][row]; }

  /// Variance models of the residuals; with `robust`, squares count up to those of `truncation` standard deviations.
  void estimate_variance(const Fitted& fitted, bool robust) {
    if (!estimated_) return estimate_scale(fitted, robust);
    if (repeated_) return;
    const double degrees = static_cast<double>(count_) / static_cast<double>(count_ - options_.free_parameters);
    fill_cells(fitted, degrees, nullptr);
    choose_models();
    if (!robust) return;
    const double moment = truncated_second_moment(truncation);
    for (int round = 0; round < truncated_rounds; ++round) {
      const std::vector<VarianceModel> before = variance_;
      fill_cells(fitted, degrees / moment, &before);
      choose_models();
      double change = 0;
      for (std::size_t c = 0; c < before.size(); ++c) {
        const double f = fitted[c].empty() ? 1 : fitted[c][fitted[c].size() / 2];
        change = std::max(change, std::abs(variance_[c](f, 0) / before[c](f, 0) - 1));
      }
      if (change < 1e-4) break;
    }
  }

  void fill_cells(const Fitted& fitted, double factor, const std::vector<VarianceModel>* limit) {
    cells_.resize(base_.size());
    for_each_channel([&](std::size_t c) {
      cells_[c].clear();
      for (std::size_t row = 0; row < base_[c].size(); ++row) {
        if (!used(c, row)) continue;
        const double f = fitted[c][row], d = deviation(c, row, f);
        double square = d * d;
        if (limit) square = std::min(square, truncation * truncation * (*limit)[c](f, tan2_[row]));
        cells_[c].add(f, tan2_[row], factor * square);
      }
    });
  }

  /// One model for all channels, or, where their mean squares do not agree with it, one each if the information criterion says so.
  void choose_models() {
    DeviationCells all;
    for (const DeviationCells& cells : cells_) all.add(cells);
    const VarianceModel shared = variance_model(all);
    variance_.assign(cells_.size(), shared);
    const bool agree = std::all_of(cells_.begin(), cells_.end(), [&](const DeviationCells& cells) {
      return std::abs(cells.mean_ratio(shared) - 1) * std::sqrt(cells.dof() / 2) < apart;
    });
    if (agree || cells_.size() < 2) return;
    std::vector<VarianceModel> own;
    double criterion = 0;
    for (const DeviationCells& cells : cells_) {
      own.push_back(variance_model(cells));
      criterion += information_criterion(cells, own.back());
    }
    if (criterion < information_criterion(all, shared)) variance_ = std::move(own);
  }

  /// The scale of the residuals where the weights are those of the data: 1 for stated uncertainties that are too large.
  void estimate_scale(const Fitted& fitted, bool robust) {
    if (!robust || estimated_) return;
    const double moment = truncated_second_moment(truncation);
    for (std::size_t c = 0; c < base_.size(); ++c) {
      scale2_[c] = 1;
      std::vector<double> z2;
      for (std::size_t row = 0; row < base_[c].size(); ++row)
        if (used(c, row)) {
          const double z = standardised(c, row, fitted[c][row]);
          z2.push_back(z * z);
        }
      if (z2.empty()) continue;
      double scale2 = std::accumulate(z2.begin(), z2.end(), 0.0) / static_cast<double>(z2.size());
      for (int round = 0; round < truncated_rounds && scale2 > 0; ++round) {
        double sum = 0;
        for (const double square : z2) sum += std::min(square, truncation * truncation * scale2);
        scale2 = sum / (moment * static_cast<double>(z2.size()));
      }
      scale2_[c] = terms_.weighted ? std::max(1.0, scale2) : std::max(scale2, 1e-300);
    }
  }

  bool from_repeats() {
    if (options_.repeats.empty()) return false;
    std::vector<std::size_t> row_of;
    for (std::size_t row = 0; row < terms_.sample.size(); ++row) {
      if (terms_.sample[row] >= row_of.size()) row_of.resize(terms_.sample[row] + 1, terms_.rows());
      row_of[terms_.sample[row]] = row;
    }
    cells_.assign(base_.size(), {});
    std::size_t repeated = 0;
    std::vector<double> values;
    for (const RepeatedReadings& same : options_.repeats)
      for (std::size_t c = 0; c < base_.size(); ++c) {
        values.clear();
        double tan2 = 0;
        for (const std::size_t sample : same) {
          const std::size_t row = sample < row_of.size() ? row_of[sample] : terms_.rows();
          if (row >= terms_.rows() || !used(c, row)) continue;
          values.push_back(terms_.channel[c].value[row]);
          tan2 = tan2_[row];
        }
        if (values.size() < 2) continue;
        repeated += values.size();
        const double n = static_cast<double>(values.size());
        const double mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
        double square = 0;
        for (const double value : values) square += (value - mean) * (value - mean);
        cells_[c].add(mean, tan2, square / (n - 1), n - 1);
      }
    double dof = 0;
    for (const DeviationCells& cells : cells_) dof += cells.dof();
    if (static_cast<double>(repeated) < enough_repeats * static_cast<double>(count_) || dof < static_cast<double>(fewest_values))
      return false;
    choose_models();
    return true;
  }

  /// False if no solution is left.
  bool weigh_by_variance(Fitted& fitted) {
    for (int round = 0; round < variance_rounds; ++round) {
      estimate_variance(fitted, false);
      set_weights(fitted, Robust::none);
      if (round + 1 == variance_rounds) break;
      auto next = fitter_(round == 0);
      if (!next) return false;
      fitted = std::move(*next);
    }
    return true;
  }

  bool looks_clean(const Fitted& fitted) const {
    const double limit = outlier_limit(count_);
    std::vector<char> clean(base_.size(), 1);
    for_each_channel([&](std::size_t c) {
      std::vector<double> sizes;
      for (std::size_t row = 0; row < base_[c].size(); ++row)
        if (used(c, row)) sizes.push_back(std::abs(standardised(c, row, fitted[c][row])));
      if (sizes.empty()) return;
      clean[c] = *std::max_element(sizes.begin(), sizes.end()) <= limit;
      if (estimated_ && sizes.size() >= fewest_values && median_of(sizes) < least_median * median_of_normal) clean[c] = 0;
    });
    return std::all_of(clean.begin(), clean.end(), [](char one) { return one != 0; });
  }

  std::vector<std::pair<std::size_t, std::size_t>> far_rows(const Fitted& fitted) const {
    const double limit = outlier_limit(count_);
    std::vector<std::pair<std::size_t, std::size_t>> out;
    for (std::size_t c = 0; c < base_.size(); ++c)
      for (std::size_t row = 0; row < base_[c].size(); ++row)
        if (base_[c][row] > 0 && std::abs(standardised(c, row, fitted[c][row])) > limit) out.emplace_back(c, row);
    return out;
  }

  /// A model that does not fit, rather than wrong readings.
  bool structured(const std::vector<std::pair<std::size_t, std::size_t>>& far) const {
    std::vector<std::size_t> order;
    for (const auto& [c, row] : far) order.push_back(c * (terms_.rows() + 2) + row);
    return in_runs(order) || static_cast<double>(far.size()) > most_outliers * static_cast<double>(count_);
  }

  void list(const std::vector<std::pair<std::size_t, std::size_t>>& far, const Fitted& fitted, Weighting& out) const {
    std::vector<Outlier> outliers;
    for (const auto& [c, row] : far)
      outliers.push_back({terms_.sample.empty() ? row : terms_.sample[row], c, terms_.channel[c].value[row], fitted[c][row],
                          standardised(c, row, fitted[c][row])});
    out.add(std::move(outliers));
  }

  void robust(Fitted fitted, Weighting& out) {
    const bool automatic = options_.robust == Robust::automatic;
    estimate_scale(fitted, true);
    if (automatic && looks_clean(fitted)) {
      std::fill(scale2_.begin(), scale2_.end(), 1.0);
      out.reason = "the residuals hold no outlier";
      return;
    }
    const std::vector<VarianceModel> plain_variance = variance_;
    std::vector<std::vector<double>> plain_weights;
    for (const ChannelTerms& channel : terms_.channel) plain_weights.push_back(channel.weight);
    const auto restore = [&](std::string reason) {
      variance_ = plain_variance;
      for (std::size_t c = 0; c < plain_weights.size(); ++c) terms_.channel[c].weight = plain_weights[c];
      out.reason = std::move(reason);
    };

    std::vector<std::pair<std::size_t, std::size_t>> far;
    for (int round = 0; round < robust_rounds; ++round) {
      estimate_variance(fitted, true);
      set_weights(fitted, Robust::cauchy);
      auto next = fitter_(round < global_robust_rounds);
      if (!next) return restore("the robust start has no solution");
      fitted = std::move(*next);
      auto now = far_rows(fitted);
      const bool stands = now == far && round + 1 >= fewest_robust_rounds;
      far = std::move(now);
      if (stands || (automatic && round + 1 >= fewest_robust_rounds && structured(far))) break;
    }
    if (automatic && far.empty()) return restore("a robust start finds no outlier");
    if (automatic && structured(far))
      return restore(fmt::format("{} large residuals stand in runs: the model misses the data there, no reading is wrong", far.size()));
    if (!automatic) {
      estimate_variance(fitted, true);
      set_weights(fitted, options_.robust);
      out.robust = options_.robust;
      out.reason = fmt::format("as asked; {} values beyond {:.1f} standard deviations", far.size(), outlier_limit(count_));
      list(far, fitted, out);
      unscale();
      return;
    }
    for (int round = 0; round < variance_rounds; ++round) {
      for (auto& kept : kept_) std::fill(kept.begin(), kept.end(), 1);
      for (const auto& [c, row] : far) kept_[c][row] = 0;
      estimate_variance(fitted, !estimated_);
      set_weights(fitted, Robust::none);
      far = far_rows(fitted);
      auto next = fitter_(false);
      if (!next) return restore("no solution without the outliers");
      fitted = std::move(*next);
    }
    for (const auto& [c, row] : far) {
      if (kept_[c][row]) continue;
      --terms_.channel[c].count;
    }
    out.robust = Robust::automatic;
    out.reason =
        fmt::format("{} values beyond {:.1f} standard deviations stand alone and were left out", far.size(), outlier_limit(count_));
    list(far, fitted, out);
    unscale();
  }

  /// Weights of the data in their own units again: the scale of the residuals is found once more where intervals are formed.
  void unscale() {
    for (std::size_t c = 0; c < scale2_.size(); ++c)
      for (double& weight : terms_.channel[c].weight) weight *= scale2_[c];
  }

  Terms& terms_;
  const WeigherOptions& options_;
  const Fitter& fitter_;
  std::vector<std::vector<double>> base_;
  std::vector<std::vector<char>> kept_;
  std::vector<double> tan2_, floor_, scale2_;
  std::vector<VarianceModel> variance_;
  std::vector<DeviationCells> cells_;
  std::size_t count_ = 0;
  bool estimated_ = false, repeated_ = false;
};

}  // namespace

Weighting weigh(Terms& terms, const WeigherOptions& options, const Fitter& fitter) {
  if (!terms.collapsed) return Weigher(terms, options, fitter).run();
  Weighting out;
  out.source = terms.weighted ? WeightSource::uncertainty : WeightSource::none;
  if (options.estimate_variance && !terms.weighted) {
    out.variance = weigh_rows(terms);
    terms.pure_error = true;
    out.source = WeightSource::rows;
  }
  if (options.robust == Robust::none) return out;
  if (terms.weighted) {
    out.reason = "rows of samples with their own uncertainty are added up as they are";
    return out;
  }
  const bool any = !terms.outliers.empty();
  if (any || options.robust != Robust::automatic) out.robust = options.robust;
  out.add(std::exchange(terms.outliers, {}));
  out.reason = options.robust != Robust::automatic ? fmt::format("as asked, in every row; {} values far from their row", out.n_outliers)
               : any ? fmt::format("{} values far from the others of their row stand alone and were left out", out.n_outliers)
                     : "no row holds an outlier";
  return out;
}

}  // namespace gonio::fitting
