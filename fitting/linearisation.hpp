// SPDX-License-Identifier: BSD-3-Clause
// The residuals to first order in all parameters together: steps, covariance and the effect of shared errors.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "fitting/profile.hpp"
#include "fitting/search_space.hpp"

namespace gonio::fitting {

/// How φ(f) of a row changes by an error that samples share, at the fitted value f̂ [1/sr]. Called from several threads.
using Change = std::function<double(std::size_t channel, std::size_t row, double fitted)>;

/// One triangle per channel with the columns (x…, θ…, y…): its linear parameters that are free to move, the free nonlinear ones (per unit
/// of the parameter, not of its axis) and the right-hand sides. Rows below the x… hold what the linear parameters cannot take up.
struct Linearisation {
  std::vector<std::vector<std::size_t>> columns;  ///< [channel]: which linear parameters stand in its triangle
  std::vector<Matrix> r;
  std::size_t free = 0;   ///< nonlinear columns
  std::size_t right = 1;  ///< right-hand sides

  /// The normal equations in the free nonlinear parameters, the linear ones eliminated: Gᵢⱼ, and gᵢ of the first y (half
  /// the gradient of the cost if that is the residual; Kaufman 1975).
  void reduced(std::vector<double>& normal, std::vector<double>& gradient) const;
};

/// The one y is the residual φ(f̂) - φ(f); or, if there are `changes`, each of them is one.
Linearisation linearise(const Terms& terms, const SearchSpace& space, const std::vector<LinearLimits>& limits,
                        const std::vector<std::vector<double>>& linear, std::span<const double> theta, std::span<const Change> changes,
                        int threads);

}  // namespace gonio::fitting
