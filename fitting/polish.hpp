// SPDX-License-Identifier: BSD-3-Clause
// All parameters together by Levenberg-Marquardt, from a start the profile has found.
#pragma once

#include <string>
#include <vector>

#include "fitting/terms.hpp"

namespace gonio::fitting {

struct Polished {
  std::vector<std::vector<double>> linear;  ///< [channel][k]
  double s = 0;
  double cost = 0;
  bool converged = false;
  std::string reason;  ///< why not
};

/// Ceres with bounds (linear >= 0, the exponent's own), geometry in double and the slope in s by automatic differentiation, so that
/// samples at the horizon or without a lobe give finite derivatives (numerics C2). Never throws for a numerical outcome: where the
/// solver fails the start comes back with converged = false. `hold_s` keeps the exponent; NaN in `held` frees a linear parameter.
Polished polish(const Terms& terms, const std::vector<std::vector<double>>& start, double s, const std::vector<std::vector<double>>& held,
                bool hold_s, int threads, int most_iterations = 200);

/// Residuals √w (φ(f̂) - φ(f)) of rows [begin, end) of one channel and their derivatives, row by row: d/dx_k, then d/ds.
/// False where φ(f̂) does not exist. Either pointer to derivatives may be null.
bool residuals(const Terms& terms, std::size_t channel, std::size_t begin, std::size_t end, const double* linear, double s, double* out,
               double* by_linear, double* by_s);

}  // namespace gonio::fitting
