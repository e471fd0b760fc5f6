// SPDX-License-Identifier: BSD-3-Clause
// Parameters of a renderer's formula that come nearest to a BRDF, and how near that is.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "brdf/brdf.hpp"
#include "brdf/dataset.hpp"
#include "brdf/target_formula.hpp"

namespace gonio::fitting {

/// Added to f cos theta_o [1/sr] before its logarithm is taken, so that values too dark to be seen do not count.
inline constexpr double dark_floor = 1e-3;

/// A BRDF at the pairs of directions of a refit. Pairs where a channel is unknown are left out; negative values count as 0.
struct RefitData {
  std::size_t channel_count = 0;
  bool isotropic = true;
  bool at_samples = false;  ///< the pairs are the source's own samples, not the grid
  std::vector<Direction> wi, wo;
  std::vector<double> f;       ///< [pair · C + c] 1/sr
  std::vector<double> weight;  ///< cos theta_i cos theta_o dwi dwo of a cell of the grid, 1 of a sample

  /// One incidence of the albedo's quadrature, ∫ f cos theta_o dwo over half vectors.
  struct Incidence {
    Direction wi;
    std::vector<Direction> wo;
    std::vector<double> weight;  ///< cos theta_o dwo
    std::vector<double> albedo;  ///< of the source, per channel; NaN if it is not known nearly everywhere
  };
  std::vector<Incidence> incidences;  ///< none at samples

  std::size_t size() const noexcept { return wi.size(); }
};

/// On a fixed grid, fine near the highlight: midpoints in sqrt(theta_h), in theta_d and in phi_d (and in phi_h unless isotropic), with
/// dwi dwo = 4 cos theta_d dwh dwd, both zenith angles at most 80°. With `samples`, at their own directions (an even part of very many).
/// Error(input) if the source knows nothing there, or reflects nothing.
RefitData refit_data(const Brdf& source, const Dataset* samples = nullptr);

/// How far a formula is from the source.
struct RefitErrors {
  /// What a refit minimises: √(log_rms² + mean square of the logarithm of the ratio of albedos, at 0°, 30° and 60° as far as they are
  /// known). The second term keeps the brightness where a formula cannot follow the tails of a lobe.
  double misfit = 0;
  double log_rms = 0;  ///< of ln(f cos theta_o + dark_floor), every pair alike
  /// Mean of |f̂ - f| cos theta_o/(f cos theta_o + dark_floor) with the weights of the pairs.
  double mean_relative = 0;
  double rms_f_cos = 0;                     ///< of (f̂ - f) cos theta_o [1/sr], every pair alike
  std::optional<double> albedo_difference;  ///< f̂'s directional albedo minus the source's where it is largest, at the same incidences
};
RefitErrors refit_errors(const RefitData& data, const EvaluateFormula& formula);

struct Refit {
  ChannelValues naive, values;
  RefitErrors naive_errors, errors;
  std::vector<std::size_t> at_bound;  ///< parameters that the refit, and not the naive conversion, put at a bound for some channel
};

/// Least squares of `misfit` by a trust region within the bounds, from every start of the formula; the best end wins, so the result is
/// never farther than the naive conversion under that measure.
Refit refit(const RefitData& data, const TargetFormula& formula, const LobeSummary& summary);

/// Diffuse part and lobe of the source by a refit of `reference`, from starts taken from the data: for sources without such parameters.
/// `summarise` reads the parameters of the reference back.
LobeSummary fitted_summary(const RefitData& data, const TargetFormula& reference, LobeSummary (*summarise)(const ChannelValues&));

}  // namespace gonio::fitting
