// SPDX-License-Identifier: BSD-3-Clause
// The global minimum of one set of terms with the intervals of its parameters.
#pragma once

#include <string>
#include <vector>

#include "fitting/fit.hpp"
#include "fitting/profile.hpp"

namespace gonio::fitting {

/// What the data say about one parameter.
struct Estimate {
  double value = 0;
  std::optional<double> sigma, low, high;
  IntervalKind kind = IntervalKind::unidentified;
};

struct OtherSolution {
  std::vector<std::vector<double>> linear;
  double s = 0, cost = 0;
};

/// Channels that share the exponent, fitted together.
struct Solution {
  bool converged = false;
  std::string reason;
  std::vector<std::vector<double>> linear;  ///< [channel][k]
  double s = 0;
  double cost = 0, dof = 0;
  double budget = 0;  ///< rise of the cost that ends an interval
  std::vector<OtherSolution> others;
  std::vector<std::vector<Estimate>> linear_estimate;  ///< [channel][k]
  std::optional<Estimate> s_estimate;
  /// Covariance of (x_0 … x_k, s) per channel, correlated components included; a parameter without a sigma has NaN there.
  std::vector<Matrix> covariance;
};

struct SolveOptions {
  std::vector<std::vector<double>> held;  ///< [channel][k], NaN where free
  double held_s = 0;                      ///< NaN where free
  double confidence = 0.95;
  int threads = 1;
};

/// Scan, minima, polish, and three rounds of weights from the fitted values where the data allow them; then the intervals.
Solution solve(Terms& terms, const SolveOptions& options, const std::vector<CorrelatedComponent>& correlated);

/// Fills the estimates of a solution (numerics D.4, D.5): profile intervals in the cost, a sigma only where both ends exist.
///   s      the set of exponents with P(s) <= P_min + budget, its hull;
///   x_k    the largest and smallest x_k over all s and all other x >= 0 within the same budget.
/// budget = q² where the data carry u (q of the normal distribution), q² · cost/dof of Student's t where not.
/// Correlated components widen both ends and sigma in squares by their linearised effect on the parameter.
void estimate(Solution& solution, const Terms& terms, const Profile& profile, const std::vector<ProfilePoint>& scan,
              const std::vector<Minimum>& minima, const SolveOptions& options, const std::vector<CorrelatedComponent>& correlated);

}  // namespace gonio::fitting
