// SPDX-License-Identifier: BSD-3-Clause
// Observations as an aligned sample would have given them without the errors that a fit has estimated.
#pragma once

#include <memory>
#include <span>

#include "brdf/observations.hpp"
#include "fitting/fit.hpp"
#include "fitting/misalignment.hpp"

namespace gonio::fitting {

/// The misalignment among nuisance parameters.
Misalignment misalignment_of(std::span<const NuisanceParameter> nuisance);

/// Directions in the true frame of the sample, values and uncertainties divided by exp(Σ c_k · value_k) over the components estimated:
/// what the fitted model describes. Everything else as it was; `all` must outlive it.
std::unique_ptr<Observations> corrected(const Observations& all, std::span<const NuisanceParameter> nuisance);

}  // namespace gonio::fitting
