// SPDX-License-Identifier: BSD-3-Clause
// All parameters together by Levenberg-Marquardt, from a start the profile has found.
#pragma once

#include <string>
#include <vector>

#include "fitting/profile.hpp"
#include "fitting/search_space.hpp"

namespace gonio::fitting {

struct Polished {
  std::vector<std::vector<double>> linear;  ///< [channel][k]
  std::vector<double> theta;
  double cost = 0;
  bool converged = false;
  std::string reason;  ///< why not
};

/// Ceres with bounds (those of the limits and the ends of the search), geometry in double and the slopes in the nonlinear parameters by
/// automatic differentiation, so that samples at the horizon or without a lobe give finite derivatives (numerics C2). Never throws for a
/// numerical outcome: where the solver fails the start comes back with converged = false. Convergence is quadratic near the minimum, so
/// the tight default of `function_tolerance` costs one more step (numerics F4).
Polished polish(const Terms& terms, const SearchSpace& space, const std::vector<LinearLimits>& limits,
                const std::vector<std::vector<double>>& start, const std::vector<double>& theta, int threads, int most_iterations = 200,
                double function_tolerance = 1e-14);

/// Residuals √w (φ(f̂) - φ(f)) of rows [begin, end) of one channel and their derivatives, row by row: d/dx_k, and d/dtheta_j.
/// False where φ(f̂) does not exist. Either pointer to derivatives may be null.
bool residuals(const Terms& terms, std::size_t channel, std::size_t begin, std::size_t end, const double* linear, const double* theta,
               double* out, double* by_linear, double* by_theta);

}  // namespace gonio::fitting
