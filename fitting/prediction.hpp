// SPDX-License-Identifier: BSD-3-Clause
// How well a model with given values predicts samples, under every metric at once.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "brdf/model_info.hpp"
#include "brdf/observations.hpp"
#include "fitting/fit.hpp"

namespace gonio::fitting {

inline constexpr std::array every_metric{Metric::linear, Metric::linear_cos, Metric::log, Metric::log1p, Metric::cbrt};

/// Measured samples side by side, copied once so that many models can be held against them.
struct Samples {
  std::vector<LobeGeometry> geometry;
  std::vector<std::vector<double>> f, u;  ///< [channel][sample] 1/sr, NaN where there is none; u empty where unknown throughout
  std::vector<std::uint8_t> group;        ///< whose prediction counts together, e.g. the fold of cross-validation
  std::vector<std::size_t> number;        ///< of the sample, through all blocks in order; ascending

  std::size_t size() const noexcept { return geometry.size(); }
};
/// The samples with keep[k] != 0 that are measurements above or on the horizon; `group` has one entry per sample too.
Samples gather(const Observations& observations, const std::vector<std::uint8_t>& keep, const std::vector<std::uint8_t>& group);

/// Sums over values (samples times channels) under each metric, in the order of `every_metric`.
struct PredictionSums {
  std::array<double, every_metric.size()> square{};     ///< Σ (φ(f̂) - φ(f))², times cos²θi under linear-cos
  std::array<double, every_metric.size()> reference{};  ///< Σ φ(f)² of the same values
  std::array<double, every_metric.size()> count{};
  std::array<bool, every_metric.size()> undefined{};  ///< φ(f̂) does not exist somewhere (f̂ = 0 under log): the metric has no answer

  PredictionSums& operator+=(const PredictionSums& other);
  /// Root mean square error; none without a value or where undefined.
  std::optional<double> error(Metric metric) const;
  /// The same over the root mean square of what was measured [1].
  std::optional<double> relative_error(Metric metric) const;
};
/// Values per channel in table order. Only samples of `group`, or all.
PredictionSums prediction_sums(const Samples& samples, const ModelInfo& model, const std::vector<std::vector<double>>& values,
                               std::optional<std::uint8_t> group);

/// -2 ln L of normal errors in the metric, up to a constant of the data: Σ (r/(u φ'))² where the data carry u, n ln(Σ r²/n) where not.
struct Likelihood {
  double minus_two_log = 0;
  std::size_t n = 0;      ///< values
  bool weighted = false;  ///< u was used
};
Likelihood likelihood(const Samples& samples, const ModelInfo& model, const std::vector<std::vector<double>>& values, Metric metric);

/// Noise of the samples over their root mean square under linear-cos and cbrt.
struct NoiseLevel {
  enum class Source { stated, repeats, unknown };
  Source source = Source::unknown;
  double linear_cos = 0, cbrt = 0;  ///< 0 where unknown
};
/// From u where at least half of the values have it, else from repeated readings of the observations the samples were gathered from (at
/// least ten repeats), else unknown.
NoiseLevel noise_level(const Observations& observations, const Samples& samples);

}  // namespace gonio::fitting
