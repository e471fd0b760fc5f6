// SPDX-License-Identifier: BSD-3-Clause
// The residuals to first order in all parameters together: steps, covariance and the effect of shared errors.
#pragma once

#include <span>
#include <vector>

#include "fitting/profile.hpp"
#include "fitting/search_space.hpp"

namespace gonio::fitting {

/// One triangle per channel with the columns (x…, θ…, y): its linear parameters that are free to move, the free nonlinear ones (per unit
/// of the parameter, not of its axis) and a right-hand side. Rows below the x… hold what the linear parameters cannot take up.
struct Linearisation {
  std::vector<std::vector<std::size_t>> columns;  ///< [channel]: which linear parameters stand in its triangle
  std::vector<Matrix> r;
  std::size_t free = 0;  ///< nonlinear columns

  /// The normal equations in the free nonlinear parameters, the linear ones eliminated: Gᵢⱼ, and gᵢ (half the gradient of the cost if y
  /// is the residual; Kaufman 1975).
  void reduced(std::vector<double>& normal, std::vector<double>& gradient) const;
};

/// y is the residual φ(f̂) - φ(f), or, if a component is given, the change of φ(f) by one standard uncertainty of it.
Linearisation linearise(const Terms& terms, const SearchSpace& space, const std::vector<LinearLimits>& limits,
                        const std::vector<std::vector<double>>& linear, std::span<const double> theta, const CorrelatedComponent* component,
                        int threads);

}  // namespace gonio::fitting
