// SPDX-License-Identifier: BSD-3-Clause
// The global minimum of one set of terms with the intervals of its parameters.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fitting/fit.hpp"
#include "fitting/global_search.hpp"
#include "fitting/linearisation.hpp"

namespace gonio::fitting {

/// What the data say about one parameter.
struct Estimate {
  double value = 0;
  std::optional<double> sigma, low, high;
  IntervalKind kind = IntervalKind::unidentified;
};

struct OtherSolution {
  std::vector<std::vector<double>> linear;
  std::vector<double> theta;
  double cost = 0;
};

/// The value of a lobe in its peak at normal incidence [1/sr] (determined.hpp).
struct Combination {
  std::size_t channel = 0, term = 0;
  Estimate estimate;
};

/// Channels that share the nonlinear parameters, fitted together.
struct Solution {
  bool converged = false;
  std::string reason;
  std::vector<std::vector<double>> linear;  ///< [channel][k]
  std::vector<double> theta;                ///< every nonlinear parameter
  double cost = 0, dof = 0;
  double free_parameters = 0;  ///< the variance of unweighted residuals included
  double log_likelihood = 0;
  /// χ² with its degrees of freedom where the weights do not come from the residuals. With weights from the scatter inside rows or among
  /// repeats (Terms::pure_error) what is constant inside rows is in neither.
  double chi2 = 0, chi2_dof = 0;
  double signal_to_noise2 = 0;  ///< Σ f²/σ²
  std::size_t count = 0;        ///< values used
  double budget = 0;            ///< rise of the cost that ends an interval
  std::vector<OtherSolution> others;
  std::vector<std::vector<Estimate>> linear_estimate;  ///< [channel][k]
  std::vector<Estimate> nonlinear_estimate;
  std::vector<Combination> determined;
  /// Of all parameters, the linear ones channel by channel, then the nonlinear ones; what samples share included. A parameter without
  /// a sigma has NaN there.
  Matrix covariance;
  double scan_s = 0, intervals_s = 0;  ///< StageTimes

  /// The block of one channel: its linear parameters, then the nonlinear ones.
  Matrix covariance_of(std::size_t channel) const;
};

struct SolveOptions {
  std::vector<LinearLimits> limits;  ///< one per channel
  std::vector<Wanted> nonlinear;
  std::vector<bool> alike;  ///< SearchSpace
  /// Nuisance parameters fitted beside these: those that take a degree of freedom, and those with a prior that gives it back.
  std::size_t nuisance = 0, nuisance_with_prior = 0;
  double confidence = 0.95;
  bool only_values = false;  ///< no intervals
  int threads = 1;
};

/// Scan, minima, polish, and three rounds of weights from the fitted values where the data allow them; then the intervals, if asked.
/// `changes`: by one standard uncertainty of everything that samples share, independent of each other. `known`: as for search_globally.
Solution solve(Terms& terms, const SolveOptions& options, const std::vector<Change>& changes, std::vector<Minimum> known = {});

/// Fills the estimates of a solution (numerics D.4, D.5): profile intervals in the cost, a sigma only where both ends exist. The interval
/// of a parameter is the hull of its values over all sets of parameters with a cost of at most the least cost plus
///   budget = q² where the data carry u (q of the normal distribution), q² · cost/dof of Student's t where not. With weights from the
///   scatter of the data themselves q², times χ²/dof if χ² says that the model misses more than that scatter (the ratio of Birge 1932).
/// Every one of the `changes` widens both ends and sigma in squares by its linearised effect on the parameter.
void estimate(Solution& solution, const Profile& profile, const SearchSpace& space, const Found& found, const SolveOptions& options,
              const std::vector<Change>& changes);

}  // namespace gonio::fitting
