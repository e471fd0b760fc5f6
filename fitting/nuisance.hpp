// SPDX-License-Identifier: BSD-3-Clause
// Nuisance parameters of a fit: estimated beside the model, and what their uncertainty does to it.
#pragma once

#include <functional>
#include <vector>

#include "fitting/fit.hpp"
#include "fitting/linearisation.hpp"
#include "fitting/solution.hpp"

namespace gonio::fitting {

struct NuisanceFit {
  Weighting weighting;
  std::vector<NuisanceParameter> parameters;
  /// By independent standard uncertainties of them, and of the components that were not estimated: what widens the intervals.
  std::vector<Change> changes;
  std::size_t free = 0, with_prior = 0;  ///< that the data determine; components
};

/// Sets the weights of the terms, and their means over apertures, for observations in the true frame.
using Weigh = std::function<Weighting(const Observations& seen)>;

/// Least cost over the nuisance parameters m together with the model's: Gauss-Newton on the cost in which the model's parameters are
/// eliminated (they follow from their last minimum), damped (Levenberg-Marquardt), in turn with the weights until m stands. Components
/// enter with the prior N(0, u²): f̂ is multiplied by exp(c · shift), c = d ln f / d name. Angles have none: a direction in m that would
/// have a standard uncertainty beyond the search bounds is not determined by the data; what has a part of more than 0.1 in it is held
/// at 0 and says so. Of the rest the covariance is scale · (reduced JᵀJ + prior)⁻¹.
/// Afterwards the terms stand at m: their profile is that of an aligned sample. All arguments must outlive the `changes`.
/// Trap: a model that does not fit can be bent towards the data by a tilt. Look at χ² per degree of freedom, and at a tilt of degrees.
NuisanceFit fit_nuisance(Terms& terms, const Observations& observations, const SolveOptions& how, const NuisanceOptions& asked,
                         const std::vector<CorrelatedComponent>& components, const Weigh& weigh);

/// Error(usage) for what never has nuisance parameters: channels fitted apart, sums (`observations` null). Error(input) where these
/// observations cannot have them: a half/difference table, whose samples have no directions of their own; no component that changes the
/// shape.
void require_nuisance_possible(const FitOptions& options, const Observations* observations, std::size_t channels, bool shape_components);

}  // namespace gonio::fitting
