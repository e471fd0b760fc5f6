// SPDX-License-Identifier: BSD-3-Clause
// What a fit says about itself.
#pragma once

#include <vector>

#include "fitting/fit.hpp"
#include "fitting/solution.hpp"

namespace gonio::fitting {

/// energy_bound: Σ_k x_k · bound_k(s) <= 1, with the covariance of the fit and the common scale. The largest channel counts.
Check energy_bound(const FitResult& result, const ModelKernel& kernel, const std::vector<Matrix>& covariance, int threads);
/// at_bound: parameters at an end of their search range.
Check at_bound(const FitResult& result);
/// adequacy: χ² against its degrees of freedom. The effect is the relative misfit beyond the stated noise, the τ with
/// variance u² + (τ f)² that would explain χ²: τ² = (χ² - dof) / Σ (f/u)².
Check adequacy(double chi2, double dof, double signal_to_noise2, std::size_t n, bool has_uncertainty);
/// second_minimum: another local minimum of the profile that the data hardly tell from the best. The effect is its cost over the best.
Check second_minimum(const FitResult& result, const ModelInfo& model, double budget, double best_cost);

/// identifiability: parameters that the data do not limit on both sides, and what they determine instead. The effect is their number.
Check identifiability(const FitResult& result);

}  // namespace gonio::fitting
