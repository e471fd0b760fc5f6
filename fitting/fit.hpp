// SPDX-License-Identifier: BSD-3-Clause
// Parameters of an analytic model from observations, with intervals that say what the data cannot say.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "brdf/observations.hpp"
#include "fitting/checks/check.hpp"
#include "fitting/convolution.hpp"
#include "fitting/not_fitted.hpp"
#include "fitting/residual_map.hpp"
#include "fitting/stage_times.hpp"
#include "fitting/weighting.hpp"

namespace gonio::fitting {

/// What is minimised, Σ w r², w = 1/u² of the residual where the data carry u, else 1:
///   linear      r = f̂ - f
///   linear_cos  r = (f̂ - f) cos θi
///   log         r = ln f̂ - ln f               (f <= 0 left out and counted)
///   log1p       r = ln(1 + f̂ cos θi) - ln(1 + f cos θi)
///   cbrt        r = ∛f̂ - ∛f
enum class Metric { linear, linear_cos, log, log1p, cbrt };
const char* name(Metric metric) noexcept;  ///< as on the command line: `linear-cos`
std::optional<Metric> metric_named(std::string_view text);

enum class Status { converged, not_converged, no_usable_data, failed };
/// What an interval is: two-sided, one-sided, nothing at all (the data do not determine the parameter), or a value held fixed.
enum class IntervalKind { interval, lower_bound, upper_bound, unidentified, fixed };
const char* name(Status status) noexcept;
const char* name(IntervalKind kind) noexcept;

/// Ends of a search, included.
struct Bounds {
  double low, high;
};

/// What is estimated beside the model: properties of the measurement that shift what the readings are readings of.
struct NuisanceOptions {
  bool tilt = false;        ///< of the sample's normal: tilt_x, tilt_y, within 5°
  bool azimuth = false;     ///< of the sample about its normal, within 45°; only an anisotropic model sees it
  bool components = false;  ///< correlated components of the data that change the shape, each with its stated u as the prior

  bool any() const noexcept { return tilt || azimuth || components; }
};
/// From a list like `tilt,azimuth,components`; none if a name is not one of these or nothing is named.
std::optional<NuisanceOptions> nuisance_named(std::string_view list);
std::string name(const NuisanceOptions& nuisance);  ///< the list, in this order

struct FitOptions {
  std::string model = "blinn-phong";
  std::optional<Metric> metric;  ///< unset: linear
  Weights weights = Weights::automatic;
  std::optional<Robust> robust;          ///< unset: automatic where the weights are automatic and the metric is unset, else none
  bool ignore_apertures = false;         ///< compare with the model at the nominal directions whatever apertures the data state
  bool per_channel = false;              ///< nonlinear parameters per channel too
  std::map<std::string, double> fixed;   ///< parameters held at a value; those the model holds of itself, at another (Parameter::held)
  std::map<std::string, Bounds> bounds;  ///< narrower than the model's, for any parameter that is not fixed
  NuisanceOptions nuisance;              ///< of one fit of all channels to samples with directions
  double confidence = 0.95;              ///< of the profile intervals
  /// Of more samples that can be neither summed nor binned, one of every few is fitted (make_terms); 0: all of them. This many take a few
  /// seconds and determine a parameter to a thousandth of the spread of a reading.
  std::size_t most_samples = std::size_t{1} << 16;
  /// Values and how they were weighted, but no intervals, errors, residuals, likelihood or checks: `parameters` stays empty.
  bool only_values = false;
  int threads = 2;
};

struct FittedParameter {
  std::string name;
  std::optional<std::size_t> channel;  ///< nullopt: shared by all channels
  double value = 0;
  std::optional<double> sigma;      ///< standard uncertainty; none where it does not exist, never 0
  std::optional<double> low, high;  ///< ends of the interval that exist for `kind`
  IntervalKind kind = IntervalKind::unidentified;
  double lower = 0, upper = 0;  ///< bounds of the search
};

/// A nuisance parameter at its estimate. Intervals of the model's parameters hold what its uncertainty does to them.
struct NuisanceParameter {
  std::string name;                 ///< tilt_x, tilt_y, azimuth (Misalignment), or of a component
  std::string unit;                 ///< `deg`; `1` for a component, which is a shift of the quantity its u is stated for
  double value = 0;                 ///< 0 where the data do not determine it
  std::optional<double> sigma;      ///< after the data; none where they do not determine it, or where it lies at a bound
  std::optional<double> low, high;  ///< of its interval, from sigma
  IntervalKind kind = IntervalKind::unidentified;
  std::optional<double> prior;  ///< standard uncertainty before the data: u of the component; none for angles
  double bound = 0;             ///< searched from -bound to bound
};

/// Another local minimum of the profile over the nonlinear parameters.
struct OtherMinimum {
  std::optional<std::size_t> channel;       ///< of a fit channel by channel; nullopt: all channels together
  std::vector<double> nonlinear;            ///< in the order of the model
  std::vector<std::vector<double>> linear;  ///< [channel][k]
  double cost = 0, cost_ratio = 0;          ///< cost over the best cost
};

/// A combination of parameters that the data determine where they do not determine each of them.
struct Determined {
  std::string expression;  ///< in the names of the parameters: `rho_s (s+2)`; `lobe peak` where the model has no name for it
  std::string unit;        ///< `1` or `1/sr`
  std::size_t channel = 0;
  double value = 0;
  std::optional<double> sigma;
  double low = 0, high = 0;  ///< of its profile interval
};

/// What one row of the minimised sum is.
enum class RowsOf { samples, table_rows, directions, psi_bins, theta_h_bins };
const char* name(RowsOf rows) noexcept;

/// The rows a fit was made of.
struct FitRows {
  RowsOf of = RowsOf::samples;
  std::size_t count = 0;
  std::string reason;  ///< one sentence on what is not exact in them and why; empty: the rows lose nothing
};

/// How likely the data are under the fitted model, of normal residuals: for the choice of a model on the same data, metric and weights.
struct FitLikelihood {
  double log_likelihood = 0;
  std::size_t free_parameters = 0;  ///< k, nuisance parameters included; of unweighted residuals their variance is one
  std::size_t n = 0;                ///< values of all channels used

  /// Akaike's criterion with the correction for small samples (Hurvich and Tsai 1989); infinite without enough values.
  double aicc() const noexcept;
  /// Schwarz's criterion (1978).
  double bic() const noexcept;
};

/// Root mean squares of the residuals of every metric (unweighted), and chi² per degree of freedom where the data carry u.
struct FitErrors {
  double linear = 0, linear_cos = 0, log = 0, log1p = 0, cbrt = 0;
  std::optional<double> chi2_per_dof;
};

struct FitResult {
  Status status = Status::failed;
  std::string reason;  ///< one sentence when not converged
  std::string model;
  Metric metric = Metric::linear;
  double confidence = 0.95;  ///< of the intervals
  Channels channels;
  std::vector<FittedParameter> parameters;  ///< linear ones channel by channel, then nonlinear ones
  /// Relative standard uncertainty of the scale that all samples have in common (k = 1), of which no fit can know anything; none where
  /// the data state none. **Not in** the intervals and sigmas of `parameters` and `determined`: it moves every linear parameter by the
  /// same part of itself, and no other. Add in squares.
  std::optional<double> u_scale;
  /// Values per channel in table order, ready for AnalyticBrdf.
  std::vector<std::vector<double>> values;
  std::vector<NuisanceParameter> nuisance;
  FitErrors errors;  ///< of the readings as `corrected` gives them
  ResidualMap residuals;
  /// Of `parameters` in their order; NaN in the rows and columns of a parameter without a sigma.
  std::vector<std::vector<double>> correlation;
  std::vector<Determined> determined;
  FitLikelihood likelihood;
  ApertureEffect aperture;  ///< whether means over the apertures were taken, and why
  Weighting weighting;      ///< where the weights came from, and the outliers
  FitRows rows;
  std::size_t n_observations = 0;  ///< samples used
  NotFitted not_fitted;            ///< samples of the observations with a value left out, by reason
  std::vector<OtherMinimum> other_minima;
  std::vector<Check> checks;  ///< energy_bound, at_bound, adequacy, second_minimum, identifiability
  StageTimes stages;
  double fit_s = 0;  ///< all of it
};

/// Global in the nonlinear parameters: linear parameters are eliminated by bounded least squares, the profile over the others is scanned
/// where the model says (global_search.hpp), every local minimum refined, and the transformed metrics polished by Ceres from each of
/// them. Terms of the same model in a sum stand in order, the broad lobe first.
/// Never throws for numerical outcomes: see `status`. Error(usage) for an unknown model, for a fixed parameter or bounds it does not
/// have. Nuisance parameters that cannot be: require_nuisance_possible.
FitResult fit(const Observations& observations, const FitOptions& options);

}  // namespace gonio::fitting
